#include "io/stream/block_meshes.hpp"

#include <mpi.h>

#include <algorithm>
#include <span>
#include <unordered_map>
#include <utility>

#include "io/model/clean_up.hpp"
#include "io/stream/held_faces.hpp"
#include "io/stream/stream_blocks.hpp"
#include "io/stream/stream_faces.hpp"
#include "io/text/name_index.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"
#include "mesher/mesh/node_exchange.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop::io {

namespace {

std::string interface_name(const std::vector<std::string>& blocks, std::int32_t first, std::int32_t second) {
  return blocks[first] + "__" + blocks[second];
}

/// Appends the rows at these places.
template <class Places>
void append_rows(const std::vector<double>& values, std::size_t width, const Places& places,
                 std::vector<double>& rows) {
  for (const auto place : places) {
    const auto row = values.begin() + static_cast<std::ptrdiff_t>(place * width);
    rows.insert(rows.end(), row, row + static_cast<std::ptrdiff_t>(width));
  }
}

/// Returns a solution without values, with the names of another.
Field like(const Field& solution) {
  Field result;
  result.names = solution.names;
  result.constants = solution.constants;
  result.cells.names = solution.cells.names;
  return result;
}

}  // namespace

/// Cuts blocks out of a distributed plane mesh.
class BlockCutter {
 public:
  BlockCutter(const MeshStream& stream, const StreamBlocks& names)
      : comm_{stream.communicator()},
        stream_{stream},
        mesh_{stream.extruded()->plane},
        blocks_{*stream.extruded()->blocks},
        names_{names.names()},
        owners_(comm_, mesh_.first_node),
        ghosts_(comm_, owners_, mesh_.owned_nodes, mesh_.ghosts),
        left_{blocks_of(edge_cells(comm_, mesh_).of_boundary)},
        right_{blocks_of(cells_right_of_boundaries(comm_, mesh_))} {
    if (comm_.size() > 1) find_elsewhere();
  }

  std::unique_ptr<BlockMesh> cut(std::int32_t block) const {
    auto cut = std::make_unique<BlockMesh>();
    cut->name_ = names_[block];
    NodeFlags used = number_nodes(block, cut->numbers_);
    take_boundaries(block, cut->plane_, used);
    const IdVector<NodeId, NodeId> local = take_points(cut->numbers_, used, cut->plane_);
    take_cells(block, local, cut->plane_);
    for (BoundaryEdges& boundary : cut->plane_.boundaries) {
      for (auto& edge : boundary.edges) edge = {local[edge[0]], local[edge[1]]};
    }
    take_solution(block, *cut);
    cut->numbers_.resize(mesh_.owned_nodes);
    open(*cut);
    return cut;
  }

 private:
  /// Returns the block of each cell; -1 for no cell.
  std::vector<std::int32_t> blocks_of(const std::vector<std::int64_t>& cells) const {
    std::vector<std::int32_t> own = blocks_.of_triangles;
    own.insert(own.end(), blocks_.of_quads.begin(), blocks_.of_quads.end());
    std::vector<std::int64_t> wanted;
    for (const std::int64_t cell : cells) {
      if (cell != EdgeCells::none) wanted.push_back(cell);
    }
    const std::vector<std::int32_t> found =
        rows_of_cells(comm_, CellOwners(comm_, mesh_), std::span<const std::int64_t>(wanted), own);
    std::vector<std::int32_t> all;
    auto next = found.begin();
    for (const std::int64_t cell : cells) all.push_back(cell == EdgeCells::none ? -1 : *next++);
    return all;
  }

  /// An edge without a block on one side, and the rank that stores it.
  struct OpenEdge {
    std::int64_t from, to;
    std::int32_t rank, index;
  };
  struct Beside {
    std::int32_t index, left, right;
  };

  /// Asks all ranks for the blocks beside an edge: it may be stored on a rank that has neither of its two
  /// cells, when edge_cells() does not find them.
  void find_elsewhere() {
    std::vector<OpenEdge> open;
    std::int32_t index = 0;
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      for (const auto& [from, to] : boundary.edges) {
        if (left_[index] < 0 || right_[index] < 0)
          open.push_back({mesh_.global(from).value(), mesh_.global(to).value(), comm_.rank(), index});
        ++index;
      }
    }
    const EdgeTable table(mesh_);
    std::unordered_map<std::int64_t, NodeId> local;
    for (std::int32_t node = 0; node < size32(mesh_.points); ++node)
      local.emplace(mesh_.global(NodeId{node}).value(), NodeId{node});
    Outbox<Beside> answers;
    for (const OpenEdge& edge : comm_.all_gather_values(std::span<const OpenEdge>(open))) {
      const auto from = local.find(edge.from), to = local.find(edge.to);
      if (from == local.end() || to == local.end()) continue;
      const std::int32_t left = block_of_own(table.cell_left_of(from->second, to->second)),
                         right = block_of_own(table.cell_left_of(to->second, from->second));
      if (left >= 0 || right >= 0) answers.add(edge.rank, {edge.index, left, right});
    }
    for (const Beside& beside : answers.deliver(comm_)) {
      if (beside.left >= 0) left_[beside.index] = beside.left;
      if (beside.right >= 0) right_[beside.index] = beside.right;
    }
  }

  std::int32_t block_of_own(std::int32_t cell) const {
    if (cell < 0) return -1;
    const auto triangles = size32(blocks_.of_triangles);
    return cell < triangles ? blocks_.of_triangles[cell] : blocks_.of_quads[cell - triangles];
  }

  /// Numbers the block's nodes among all nodes of this rank, -1 for others. Returns the flags of the nodes of
  /// this rank's cells in the block.
  NodeFlags number_nodes(std::int32_t block, std::vector<std::int64_t>& numbers) const {
    NodeFlags used(mesh_.points.size(), 0);
    for (const auto& nodes : cells_of_block(mesh_.triangles, blocks_.of_triangles, block))
      flag_all(nodes, used);
    for (const auto& nodes : cells_of_block(mesh_.quads, blocks_.of_quads, block)) flag_all(nodes, used);
    std::vector<GlobalNodeId> elsewhere;
    for (const NodeId node : used.ids()) {
      if (used[node] != 0 && !mesh_.owns(node)) elsewhere.push_back(mesh_.global(node));
    }
    flag_at_owners(comm_, owners_, elsewhere, used);
    const std::int64_t own =
        std::count_if(used.data(), used.data() + mesh_.owned_nodes, [](char flag) { return flag != 0; });
    std::int64_t next = comm_.exclusive_sum(own);
    numbers.assign(mesh_.points.size(), -1);
    for (std::int32_t node = 0; node < mesh_.owned_nodes; ++node) {
      if (used[NodeId{node}] != 0) numbers[node] = next++;
    }
    ghosts_.update(numbers);
    return used;
  }

  /// Takes the block's edges, still with the nodes of the whole mesh, and flags their nodes.
  void take_boundaries(std::int32_t block, Mesh& plane, NodeFlags& used) const {
    std::size_t at = 0;
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      BoundaryEdges& own = plane.boundaries.emplace_back(boundary);
      own.edges.clear();
      for (const auto& [from, to] : boundary.edges) {
        if (left_[at] == block)
          own.edges.push_back({from, to});
        else if (right_[at] == block)
          own.edges.push_back({to, from});
        ++at;
      }
      for (const auto& edge : own.edges) flag_all(edge, used);
    }
  }

  /// Takes the owned nodes of the block, and the ghosts that are flagged. Returns the new number of each
  /// node.
  IdVector<NodeId, NodeId> take_points(const std::vector<std::int64_t>& numbers, const NodeFlags& used,
                                       Mesh& plane) const {
    IdVector<NodeId, NodeId> local(mesh_.points.size(), NodeId{});
    for (const NodeId node : local.ids()) {
      const bool owned = mesh_.owns(node);
      if (owned ? numbers[node.value()] < 0 : used[node] == 0) continue;
      local[node] = NodeId{size32(plane.points)};
      plane.points.push_back(mesh_.point(node));
      if (owned)
        ++plane.owned_nodes;
      else
        plane.ghosts.push_back(GlobalNodeId{numbers[node.value()]});
    }
    plane.first_node = comm_.exclusive_sum(std::int64_t{plane.owned_nodes});
    return local;
  }

  void take_cells(std::int32_t block, const IdVector<NodeId, NodeId>& local, Mesh& plane) const {
    plane.triangles = cells_of_block(mesh_.triangles, blocks_.of_triangles, block);
    plane.quads = cells_of_block(mesh_.quads, blocks_.of_quads, block);
    plane.for_each_cell([&](auto& nodes) {
      for (NodeId& node : nodes) node = local[node];
    });
  }

  void take_solution(std::int32_t block, BlockMesh& cut) const {
    const Field* const whole = stream_.extruded()->solution;
    if (whole == nullptr) return;
    Field& own = cut.solution_.emplace(like(*whole));
    std::vector<std::int32_t> nodes, cells;
    for (std::int32_t node = 0; node < mesh_.owned_nodes; ++node) {
      if (cut.numbers_[node] >= 0) nodes.push_back(node);
    }
    std::int32_t cell = 0;
    for (const auto* of_cells : {&blocks_.of_triangles, &blocks_.of_quads}) {
      for (const std::int32_t of_cell : *of_cells) {
        if (of_cell == block) cells.push_back(cell);
        ++cell;
      }
    }
    append_rows(whole->values, whole->width(), nodes, own.values);
    append_rows(whole->cells.values, whole->cells.width(), cells, own.cells.values);
  }

  void open(BlockMesh& cut) const {
    const Field* const solution = cut.solution_ ? &*cut.solution_ : nullptr;
    if (stream_.is_plane()) {
      cut.stream_.emplace(comm_, cut.plane_, solution);
      return;
    }
    const ExtrudedMesh& whole = *stream_.extruded();
    cut.levels_ = whole.levels();
    cut.extruded_.emplace(
        ExtrudedMesh{cut.plane_, whole.heights, whole.axis, whole.back, whole.front, solution});
    cut.stream_.emplace(comm_, *cut.extruded_);
  }

  const Communicator& comm_;
  const MeshStream& stream_;
  const Mesh& mesh_;
  const PlaneBlocks& blocks_;
  const std::vector<std::string>& names_;
  NodeOwners owners_;
  NodeExchange ghosts_;
  std::vector<std::int32_t> left_, right_;  ///< blocks beside each boundary edge; -1: none
};

/// Cuts blocks out of a stored 3D mesh.
class HeldBlockCutter {
 public:
  HeldBlockCutter(const MeshStream& stream, const std::string& path)
      : comm_{stream.communicator()},
        mesh_{*stream.held()},
        faces_(mesh_, path),
        block_of_{blocks_of_cells(mesh_)},
        boundaries_{mesh_.boundaries} {
    for (FileBoundary& boundary : boundaries_) boundary.faces.clear();
    for (const HeldFaces::Inner& face : faces_.internal()) {
      const auto [first, second] = std::minmax(block_of_[face.owner], block_of_[face.neighbour]);
      if (first != second) boundary_between(first, second);
    }
  }

  std::unique_ptr<BlockMesh> cut(std::int32_t block) const {
    auto cut = std::make_unique<BlockMesh>();
    cut->name_ = mesh_.block_names[block];
    FileMesh& own = cut->held_;
    own.block_named(cut->name_);
    number_nodes(block, cut->numbers_);
    for (std::size_t node = 0; node < mesh_.points.size(); ++node) {
      if (cut->numbers_[node] >= 0) own.points.push_back(mesh_.points[node]);
    }
    for_each_kind([&]<CellKind kind>() {
      const auto& blocks = mesh_.cell_to_block[static_cast<std::size_t>(kind)];
      for (auto nodes : cells_of_block(cells_of<kind>(mesh_), blocks, block)) {
        for (std::int32_t& node : nodes) node = number_of(*cut, node);
        add_cell<kind>(own, nodes, 0);
      }
    });
    take_faces(block, *cut);
    take_solution(block, *cut);
    cut->stream_.emplace(comm_, own);
    return cut;
  }

 private:
  static std::int32_t number_of(const BlockMesh& cut, std::int32_t node) {
    return node == FileBoundary::no_node ? node : static_cast<std::int32_t>(cut.numbers_[node]);
  }

  /// Returns the index of the boundary between two blocks, which is added if necessary.
  std::int32_t boundary_between(std::int32_t first, std::int32_t second) {
    const auto [at, is_new] = interfaces_.entry_of(interface_name(mesh_.block_names, first, second));
    if (is_new) boundaries_.push_back({interface_name(mesh_.block_names, first, second), {}, {}});
    return static_cast<std::int32_t>(std::ssize(mesh_.boundaries)) + at;
  }
  std::int32_t interface_of(std::int32_t first, std::int32_t second) const {
    const auto found =
        std::ranges::find(boundaries_.begin() + std::ssize(mesh_.boundaries), boundaries_.end(),
                          interface_name(mesh_.block_names, first, second), &FileBoundary::name);
    return static_cast<std::int32_t>(found - boundaries_.begin());
  }

  void number_nodes(std::int32_t block, std::vector<std::int64_t>& numbers) const {
    numbers.assign(mesh_.points.size(), -1);
    for_each_kind([&]<CellKind kind>() {
      const auto& blocks = mesh_.cell_to_block[static_cast<std::size_t>(kind)];
      for (const auto& nodes : cells_of_block(cells_of<kind>(mesh_), blocks, block)) {
        for (const std::int32_t node : nodes) numbers[node] = 0;
      }
    });
    std::int64_t next = 0;
    for (std::int64_t& number : numbers) {
      if (number >= 0) number = next++;
    }
  }

  void take_faces(std::int32_t block, BlockMesh& cut) const {
    std::vector<FileBoundary>& own = cut.held_.boundaries;
    own = boundaries_;
    const auto add = [&](std::size_t patch, FileBoundary::Face face) {
      for (std::int32_t& node : face) node = number_of(cut, node);
      own[patch].faces.push_back(face);
    };
    for (std::size_t patch = 0; patch < mesh_.boundaries.size(); ++patch) {
      const std::vector<std::int32_t>& cells = faces_.cells_at(patch);
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (block_of_[cells[i]] == block) add(patch, faces_.patch_nodes(patch, i));
      }
    }
    for (const HeldFaces::Inner& face : faces_.internal()) {
      const std::int32_t of_owner = block_of_[face.owner], of_neighbour = block_of_[face.neighbour];
      if (of_owner == of_neighbour || (of_owner != block && of_neighbour != block)) continue;
      FileBoundary::Face nodes = faces_.nodes(face);
      if (of_neighbour == block) std::reverse(nodes.begin(), nodes.begin() + (nodes[3] < 0 ? 3 : 4));
      const auto [first, second] = std::minmax(of_owner, of_neighbour);
      add(interface_of(first, second), nodes);
    }
  }

  void take_solution(std::int32_t block, BlockMesh& cut) const {
    if (!mesh_.solution) return;
    Field& own = cut.held_.solution.emplace(like(*mesh_.solution));
    std::vector<std::size_t> nodes, cells;
    for (std::size_t node = 0; node < cut.numbers_.size(); ++node) {
      if (cut.numbers_[node] >= 0) nodes.push_back(node);
    }
    for (std::size_t cell = 0; cell < block_of_.size(); ++cell) {
      if (block_of_[cell] == block) cells.push_back(cell);
    }
    append_rows(mesh_.solution->values, mesh_.solution->width(), nodes, own.values);
    append_rows(mesh_.solution->cells.values, mesh_.solution->cells.width(), cells, own.cells.values);
  }

  const Communicator& comm_;
  const FileMesh& mesh_;
  HeldFaces faces_;
  std::vector<std::int32_t> block_of_;
  std::vector<FileBoundary> boundaries_;  ///< without faces, then those between blocks
  NameIndex interfaces_;
};

std::vector<std::unique_ptr<BlockMesh>> block_meshes(const MeshStream& stream, const std::string& path) {
  const StreamBlocks blocks(stream);
  QUADLOOP_REQUIRE(blocks.several(), "a mesh without blocks has none to be cut out");
  std::vector<std::unique_ptr<BlockMesh>> cuts;
  const auto cut_all = [&](const auto& cutter) {
    for (std::int32_t block = 0; block < blocks.count(); ++block) cuts.push_back(cutter.cut(block));
  };
  stream.held() != nullptr ? cut_all(HeldBlockCutter(stream, path)) : cut_all(BlockCutter(stream, blocks));
  return cuts;
}

LoadedMesh one_block(const LoadedMesh& whole, std::int32_t block) {
  LoadedMesh named = whole;
  name_interfaces(named);
  const Communicator alone(MPI_COMM_SELF);
  const MeshStream stream(alone, named);
  const std::unique_ptr<BlockMesh> cut = BlockCutter(stream, StreamBlocks(stream)).cut(block);
  LoadedMesh result;
  result.mesh = std::move(cut->plane_);
  result.solution = std::move(cut->solution_);
  result.block_names = {cut->name_};
  result.triangle_to_block.assign(result.mesh.triangles.size(), 0);
  result.quad_to_block.assign(result.mesh.quads.size(), 0);
  result.warnings = whole.warnings;
  std::vector<BoundaryEdges>& boundaries = result.mesh.boundaries;
  std::erase_if(boundaries, [](const BoundaryEdges& boundary) { return boundary.edges.empty(); });
  for (BoundaryEdges& boundary : boundaries) boundary.between_blocks = false;
  return result;
}

void name_interfaces(LoadedMesh& whole) {
  if (whole.blocks < 2) return;
  Mesh& mesh = whole.mesh;
  const EdgeTable table(mesh);
  std::vector<std::array<NodeId, 2>> named;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (auto edge : boundary.edges) {
      std::ranges::sort(edge);
      named.push_back(edge);
    }
  }
  std::ranges::sort(named);
  const std::vector<std::string> blocks = plane_blocks(whole).names;
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t cell) {
    const std::int32_t other = table.cell_left_of(to, from);
    if (other < 0) return;
    const std::int32_t left = block_of_cell(whole, cell), right = block_of_cell(whole, other);
    if (left >= right ||
        std::ranges::binary_search(named, std::array{std::min(from, to), std::max(from, to)}))
      return;
    const std::string name = interface_name(blocks, left, right);
    auto boundary = std::ranges::find(mesh.boundaries, name, &BoundaryEdges::name);
    if (boundary == mesh.boundaries.end())
      boundary = mesh.boundaries.insert(boundary, BoundaryEdges{name, {}, {}, {}, true});
    boundary->edges.push_back({from, to});
  });
}

}  // namespace quadloop::io
