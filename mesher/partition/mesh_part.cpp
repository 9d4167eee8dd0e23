#include "mesher/partition/mesh_part.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/base/parallel/exchange.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/node_exchange.hpp"
#include "mesher/partition/part_sides.hpp"
#include "mesher/partition/part_strips.hpp"

namespace quadloop {

namespace {

/// A cell with its numbers in the distributed mesh and in the whole mesh, where cells are numbered block by
/// block.
template <std::size_t width>
struct PartCell {
  std::int64_t distributed = 0, whole = 0;
  std::int32_t part = 0, block = 0;
  std::array<GlobalNodeId, width> nodes;
};

/// A node used by a part.
struct Use {
  GlobalNodeId node;
  std::int32_t part = 0;
  friend auto operator<=>(const Use&, const Use&) = default;
};

/// A node shared by two parts.
struct Sharing {
  std::int32_t part = 0, other = 0;
  GlobalNodeId node;
  friend auto operator<=>(const Sharing&, const Sharing&) = default;
};

/// Returns the numbers of this rank's cells of a kind if all ranks' cells are numbered block by block.
std::vector<std::int64_t> numbers_by_block(const Communicator& comm, std::size_t cells,
                                           const MeshBlocks& blocks,
                                           const std::vector<std::int32_t>& block_of) {
  std::vector<std::int64_t> numbers(cells);
  if (blocks.names.size() < 2) {
    std::iota(numbers.begin(), numbers.end(), comm.exclusive_sum(static_cast<std::int64_t>(cells)));
    return numbers;
  }
  std::int64_t first = 0;
  for (std::int32_t block = 0; block < std::ssize(blocks.names); ++block) {
    const std::int64_t own = std::ranges::count(block_of, block);
    std::int64_t next = first + comm.exclusive_sum(own);
    for (std::size_t i = 0; i < cells; ++i) {
      if (block_of[i] == block) numbers[i] = next++;
    }
    first += comm.sum(own);
  }
  return numbers;
}

class PartMaker {
 public:
  PartMaker(const Communicator& comm, const Mesh& mesh, const CellParts& cells, const Field* field)
      : comm_{comm}, mesh_{mesh}, cells_{cells}, field_{field}, owners_(comm, mesh.first_node) {}

  std::vector<MeshPart> make() {
    refuse_names();
    for (std::int32_t part = 0; part < cells_.parts; ++part) {
      if (rank_of(part) != comm_.rank()) continue;
      index_of_[part] = parts_.size();
      parts_.emplace_back().number = part;
    }
    stored_.resize(parts_.size());
    const auto triangles = deliver_cells(mesh_.triangles, cells_.triangles, mesh_.blocks.of_triangles);
    const auto quads = deliver_cells(mesh_.quads, cells_.quads, mesh_.blocks.of_quads);
    collect_nodes(triangles, quads);
    put_cells(triangles, &Mesh::triangles, &MeshPart::triangles, &MeshBlocks::of_triangles);
    put_cells(quads, &Mesh::quads, &MeshPart::quads, &MeshBlocks::of_quads);
    fetch_nodes();
    fetch_cell_values();
    put_sharings();
    put_sides();
    for (MeshPart& part : parts_) put_lines_last(part);
    for (MeshPart& part : parts_) part.mesh.strips = strips_in_part(mesh_.strips, part.nodes);
    return std::move(parts_);
  }

 private:
  int rank_of(std::int32_t part) const { return rank_of_part(comm_, part, cells_.parts); }
  MeshPart& part(std::int32_t number) { return parts_[index_of_.at(number)]; }

  /// Rejects boundaries with the name of a part interface.
  void refuse_names() const {
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      if (is_part_name(boundary.name))
        throw InputError("boundary '" + boundary.name +
                         "' has the name of the edges between two partitions; give it another name");
    }
  }

  /// Returns the cells of this rank's parts in the order of their numbers in the whole mesh.
  template <std::size_t width>
  std::vector<PartCell<width>> deliver_cells(const std::vector<std::array<NodeId, width>>& cells,
                                             const std::vector<std::int32_t>& parts,
                                             const std::vector<std::int32_t>& blocks) const {
    Outbox<PartCell<width>> out;
    const std::int64_t first = comm_.exclusive_sum(std::ssize(cells));
    const std::vector<std::int64_t> numbers = numbers_by_block(comm_, cells.size(), mesh_.blocks, blocks);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      PartCell<width> cell{
          first + static_cast<std::int64_t>(i), numbers[i], parts[i], blocks.empty() ? 0 : blocks[i], {}};
      for (std::size_t k = 0; k < width; ++k) cell.nodes[k] = mesh_.global(cells[i][k]);
      out.add(rank_of(cell.part), cell);
    }
    std::vector<PartCell<width>> found = out.deliver(comm_);
    std::ranges::sort(found, {}, &PartCell<width>::whole);
    return found;
  }

  /// Collects the nodes of each part.
  void collect_nodes(const auto& triangles, const auto& quads) {
    const auto collect = [&](const auto& cells) {
      for (const auto& cell : cells) {
        for (const GlobalNodeId node : cell.nodes) part(cell.part).nodes.push_back(node.value());
      }
    };
    collect(triangles);
    collect(quads);
    for (MeshPart& part : parts_) {
      std::ranges::sort(part.nodes);
      const auto rest = std::ranges::unique(part.nodes);
      part.nodes.erase(rest.begin(), rest.end());
      part.mesh.owned_nodes = size32(part.nodes);
      part.owners.assign(part.nodes.size(), part.number);
      part.mesh.blocks.names = mesh_.blocks.names;
    }
  }

  static NodeId local(const MeshPart& part, GlobalNodeId node) {
    const auto at = std::ranges::lower_bound(part.nodes, node.value());
    return NodeId{static_cast<std::int32_t>(at - part.nodes.begin())};
  }
  template <std::size_t width>
  static std::array<NodeId, width> local(const MeshPart& part, const std::array<GlobalNodeId, width>& nodes) {
    std::array<NodeId, width> here;
    for (std::size_t k = 0; k < width; ++k) here[k] = local(part, nodes[k]);
    return here;
  }

  template <std::size_t width>
  void put_cells(const std::vector<PartCell<width>>& cells,
                 std::vector<std::array<NodeId, width>> Mesh::*rows,
                 std::vector<std::int64_t> MeshPart::*numbers,
                 std::vector<std::int32_t> MeshBlocks::*blocks) {
    const std::int64_t first = width == 3 ? 0 : comm_.sum(std::ssize(mesh_.triangles));
    for (const PartCell<width>& cell : cells) {
      MeshPart& to = part(cell.part);
      (to.mesh.*rows).push_back(local(to, cell.nodes));
      (to.*numbers).push_back(cell.whole);
      if (!mesh_.blocks.names.empty()) (to.mesh.blocks.*blocks).push_back(cell.block);
      stored_[index_of_.at(cell.part)].push_back(first + cell.distributed);
    }
  }

  /// Fetches positions and values from the owners of the nodes.
  void fetch_nodes() {
    std::vector<int> ranks;
    std::vector<GlobalNodeId> wanted;
    for (const MeshPart& part : parts_) {
      for (const std::int64_t node : part.nodes) wanted.emplace_back(node);
    }
    for (const GlobalNodeId node : wanted) ranks.push_back(owners_.rank_of(node));
    const Exchange questions(comm_, ranks);
    const std::vector<GlobalNodeId> asked = questions.deliver(wanted);
    const std::size_t width = field_ == nullptr ? 0 : field_->width();
    std::vector<Point> points;
    std::vector<double> rows;
    for (const GlobalNodeId node : asked) {
      const NodeId here = owners_.local(node);
      points.push_back(mesh_.point(here));
      if (width == 0) continue;
      const auto row = field_->row(here);
      rows.insert(rows.end(), row.begin(), row.end());
    }
    points = questions.answer(points);
    if (width > 0) rows = questions.answer(rows, width);
    std::size_t at = 0;
    for (MeshPart& part : parts_) {
      const std::size_t end = at + part.nodes.size();
      part.mesh.points.assign(points.begin() + at, points.begin() + end);
      if (field_ != nullptr)
        part.field =
            Field{field_->names, {rows.begin() + at * width, rows.begin() + end * width}, field_->constants};
      at = end;
    }
  }

  /// Fetches rows of triangles, then of quads, from the owners of the cells.
  void fetch_cell_values() {
    if (field_ == nullptr || field_->cells.width() == 0) return;
    const CellOwners owners(comm_, mesh_);
    std::vector<std::int64_t> wanted;
    for (const std::vector<std::int64_t>& of_part : stored_)
      wanted.insert(wanted.end(), of_part.begin(), of_part.end());
    const CellValues& whole = field_->cells;
    const std::vector<double> rows =
        rows_of_cells(comm_, owners, std::span<const std::int64_t>(wanted), whole.values, whole.width());
    auto at = rows.begin();
    for (MeshPart& part : parts_) {
      const auto end = at + std::ssize(whole.names) * (std::ssize(part.triangles) + std::ssize(part.quads));
      part.field->cells = {whole.names, {at, end}};
      at = end;
    }
  }

  /// Determines shared nodes on their owners, which receive all uses.
  void put_sharings() {
    Outbox<Use> uses;
    for (const MeshPart& part : parts_) {
      for (const std::int64_t node : part.nodes) {
        const GlobalNodeId global{node};
        uses.add(owners_.rank_of(global), {global, part.number});
      }
    }
    std::vector<Use> used = uses.deliver(comm_);
    std::ranges::sort(used);
    std::int64_t nodes = 0;
    Outbox<Sharing> sharings;
    for (auto begin = used.begin(); begin != used.end(); ++nodes) {
      const auto end =
          std::find_if(begin, used.end(), [&](const Use& use) { return use.node != begin->node; });
      for (auto a = begin; a != end; ++a) {
        for (auto b = begin; b != end; ++b) {
          if (a != b) sharings.add(rank_of(a->part), {a->part, b->part, a->node});
        }
      }
      begin = end;
    }
    if (comm_.any(nodes != mesh_.owned_nodes))
      throw InputError(
          "the mesh has nodes without cells, which belong to no partition; `quadloop check` lists them");
    std::vector<Sharing> shared = sharings.deliver(comm_);
    std::ranges::sort(shared);
    for (const Sharing& sharing : shared) {
      MeshPart& here = part(sharing.part);
      if (here.neighbours.empty() || here.neighbours.back().part != sharing.other)
        here.neighbours.push_back({sharing.other, {}});
      const NodeId node = local(here, sharing.node);
      here.neighbours.back().nodes.push_back(node);
      std::int32_t& owner = here.owners[node.value()];
      owner = std::min(owner, sharing.other);
    }
  }

  void put_sides() {
    std::vector<PartSide> sides = part_sides(comm_, mesh_, cells_);
    const auto undirected = [](const PartSide& side) { return std::ranges::minmax(side.nodes); };
    std::ranges::sort(sides, [&](const PartSide& a, const PartSide& b) {
      const auto [a_low, a_high] = undirected(a);
      const auto [b_low, b_high] = undirected(b);
      return std::tuple(a.neighbour, a.boundary, a.place, a_low, a_high) <
             std::tuple(b.neighbour, b.boundary, b.place, b_low, b_high);
    });
    for (MeshPart& part : parts_) {
      for (const BoundaryEdges& boundary : mesh_.boundaries)
        part.mesh.boundaries.push_back({boundary.name,
                                        boundary.condition,
                                        {},
                                        boundary.layers,
                                        boundary.between_blocks,
                                        boundary.inner_line});
      part.edges.resize(mesh_.boundaries.size());
    }
    for (const PartSide& side : sides) put_side(side, part(side.part));
  }

  /// Edges between parts come after all others, neighbour by neighbour.
  static void put_side(const PartSide& side, MeshPart& to) {
    auto& boundaries = to.mesh.boundaries;
    if (side.boundary >= 0) {
      boundaries[side.boundary].edges.push_back(local(to, side.nodes));
      to.edges[side.boundary].push_back(side.place);
      return;
    }
    const std::string name = part_name(side.neighbour);
    if (boundaries.size() == to.edges.size() || boundaries.back().name != name)
      boundaries.push_back({name, BoundaryCondition::interface, {}, {}});
    boundaries.back().edges.push_back(local(to, side.nodes));
  }

  /// Moves inner lines behind the boundaries and drops those without edges in the part.
  void put_lines_last(MeshPart& part) const {
    std::vector<BoundaryEdges> lines, others;
    std::vector<std::vector<std::int64_t>> edges;
    for (std::size_t b = 0; b < part.mesh.boundaries.size(); ++b) {
      BoundaryEdges& boundary = part.mesh.boundaries[b];
      if (b < part.edges.size() && !boundary.inner_line) edges.push_back(std::move(part.edges[b]));
      if (!boundary.inner_line)
        others.push_back(std::move(boundary));
      else if (!boundary.edges.empty())
        lines.push_back(std::move(boundary));
    }
    part.edges = std::move(edges);
    part.mesh.boundaries = std::move(others);
    std::ranges::move(lines, std::back_inserter(part.mesh.boundaries));
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  const CellParts& cells_;
  const Field* field_;
  NodeOwners owners_;
  std::vector<MeshPart> parts_;
  /// For each part the numbers of its cells in the distributed mesh, quads after all triangles.
  std::vector<std::vector<std::int64_t>> stored_;
  std::map<std::int32_t, std::size_t> index_of_;
};

}  // namespace

std::vector<MeshPart> make_parts(const Communicator& comm, const Mesh& mesh, const CellParts& cells,
                                 const Field* field) {
  return PartMaker(comm, mesh, cells, field).make();
}

PartStatistics part_statistics(const Communicator& comm, std::span<const MeshPart> parts) {
  PartStatistics statistics;
  std::int64_t cut = 0, weight = 0, heaviest = 0, shared = 0, neighbours = 0, most = 0;
  std::int64_t fewest = std::numeric_limits<std::int64_t>::max();
  for (const MeshPart& part : parts) {
    for (std::size_t b = part.edges.size(); b < part.mesh.boundaries.size(); ++b)
      cut += part.mesh.boundaries[b].inner_line ? 0 : std::ssize(part.mesh.boundaries[b].edges);
    const std::int64_t triangles = std::ssize(part.triangles), quads = std::ssize(part.quads),
                       weighs = 3 * triangles + 4 * quads;
    weight += weighs;
    heaviest = std::max(heaviest, weighs);
    fewest = std::min(fewest, triangles + quads);
    most = std::max(most, triangles + quads);
    neighbours = std::max<std::int64_t>(neighbours, std::ssize(part.neighbours));
    std::vector<char> is_shared(part.nodes.size(), 0);
    for (const MeshPart::Neighbour& neighbour : part.neighbours) {
      for (const NodeId node : neighbour.nodes) is_shared[node.value()] = 1;
    }
    for (std::size_t i = 0; i < part.nodes.size(); ++i)
      shared += is_shared[i] != 0 && part.owners[i] == part.number ? 1 : 0;
  }
  statistics.parts = comm.sum(std::ssize(parts));
  statistics.edge_cut = comm.sum(cut) / 2;
  statistics.balance = static_cast<double>(comm.maximum(heaviest)) * static_cast<double>(statistics.parts) /
                       static_cast<double>(comm.sum(weight));
  statistics.fewest_cells = comm.minimum(fewest);
  statistics.most_cells = comm.maximum(most);
  statistics.shared_nodes = comm.sum(shared);
  statistics.most_neighbours = comm.maximum(neighbours);
  return statistics;
}

}  // namespace quadloop
