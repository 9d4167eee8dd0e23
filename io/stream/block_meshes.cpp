#include "io/stream/block_meshes.hpp"

#include <mpi.h>

#include <algorithm>
#include <utility>

#include "io/model/clean_up.hpp"
#include "io/stream/held_faces.hpp"
#include "io/stream/stream_blocks.hpp"
#include "io/text/name_index.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/mesh/cells/block_part.hpp"
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

/// Cuts blocks out of a distributed plane or extruded mesh.
class PlaneBlockCutter {
 public:
  PlaneBlockCutter(const MeshStream& stream, const StreamBlocks& names)
      : stream_{stream},
        whole_{*stream.extruded()},
        names_{names.names()},
        cutter_(stream.communicator(), whole_.plane, *whole_.blocks) {}

  /// *Collective.*
  std::unique_ptr<BlockMesh> cut(std::int32_t block) const {
    auto cut = std::make_unique<BlockMesh>();
    BlockPart part = cutter_.cut(block);
    cut->name_ = names_[block];
    cut->numbers_.assign(whole_.plane.owned_nodes, -1);
    for (std::size_t i = 0; i < part.nodes.size(); ++i)
      cut->numbers_[part.nodes[i].value()] = part.mesh.first_node + static_cast<std::int64_t>(i);
    if (whole_.solution != nullptr) cut->solution_ = field_on(part, *whole_.solution);
    cut->plane_ = std::move(part.mesh);
    open(*cut);
    return cut;
  }

 private:
  void open(BlockMesh& cut) const {
    const Field* const solution = cut.solution_ ? &*cut.solution_ : nullptr;
    if (stream_.is_plane()) {
      cut.stream_.emplace(stream_.communicator(), cut.plane_, solution);
      return;
    }
    cut.levels_ = whole_.levels();
    cut.extruded_.emplace(
        ExtrudedMesh{cut.plane_, whole_.heights, whole_.axis, whole_.back, whole_.front, solution});
    cut.stream_.emplace(stream_.communicator(), *cut.extruded_);
  }

  const MeshStream& stream_;
  const ExtrudedMesh& whole_;
  const std::vector<std::string>& names_;
  BlockCutter cutter_;
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
  stream.held() != nullptr ? cut_all(HeldBlockCutter(stream, path))
                           : cut_all(PlaneBlockCutter(stream, blocks));
  return cuts;
}

LoadedMesh one_block(const LoadedMesh& whole, std::int32_t block) {
  LoadedMesh named = whole;
  name_interfaces(named);
  const Communicator alone(MPI_COMM_SELF);
  const PlaneBlocks blocks = plane_blocks(named);
  BlockPart part = BlockCutter(alone, named.mesh, blocks).cut(block);
  LoadedMesh result;
  if (named.solution) result.solution = field_on(part, *named.solution);
  result.mesh = std::move(part.mesh);
  result.block_names = {blocks.names[block]};
  result.triangle_to_block.assign(result.mesh.triangles.size(), 0);
  result.quad_to_block.assign(result.mesh.quads.size(), 0);
  result.warnings = whole.warnings;
  std::erase_if(result.mesh.boundaries, [](const BoundaryEdges& boundary) { return boundary.edges.empty(); });
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
