#include "mesher/partition/part_sides.hpp"

#include <algorithm>
#include <span>
#include <string>

#include "mesher/base/error.hpp"
#include "mesher/base/parallel/exchange.hpp"
#include "mesher/mesh/node_exchange.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

namespace {

/// A side of a cell, or a boundary edge, sent to the owner of its lower node.
struct Side {
  GlobalNodeId low = {}, high = {};
  bool forward = true;         ///< directed from low to high, with the cell or the domain on the left
  std::int32_t part = -1;      ///< for the side of a cell
  std::int32_t boundary = -1;  ///< for a boundary edge
  std::int64_t place = -1;
};

class SideFinder {
 public:
  SideFinder(const Communicator& comm, const Mesh& mesh, const CellParts& cells)
      : comm_{comm}, mesh_{mesh}, cells_{cells}, owners_(comm, mesh.first_node) {}

  std::vector<PartSide> find() {
    add_boundary_edges();
    add_cell_sides(boundary_nodes());
    std::vector<Side> sides = out_.deliver(comm_);
    std::ranges::sort(sides, {}, [](const Side& s) { return std::array{s.low, s.high}; });
    Outbox<PartSide> found;
    comm_.together([&] {
      for (auto begin = sides.begin(); begin != sides.end();) {
        const auto end = std::find_if(
            begin, sides.end(), [&](const Side& s) { return s.low != begin->low || s.high != begin->high; });
        settle(std::span(begin, end), found);
        begin = end;
      }
    });
    return found.deliver(comm_);
  }

 private:
  void add(NodeId from, NodeId to, Side side) {
    const GlobalNodeId a = mesh_.global(from), b = mesh_.global(to);
    side.low = std::min(a, b);
    side.high = std::max(a, b);
    side.forward = a < b;
    out_.add(owners_.rank_of(side.low), side);
  }

  void add_boundary_edges() {
    for (std::int32_t b = 0; b < size32(mesh_.boundaries); ++b) {
      const auto& edges = mesh_.boundaries[b].edges;
      std::int64_t place = comm_.exclusive_sum(std::ssize(edges));
      for (const auto& [from, to] : edges) add(from, to, {.boundary = b, .place = place++});
    }
  }

  /// Flags the owned nodes and ghosts on boundary edges of any rank.
  NodeFlags boundary_nodes() const {
    std::vector<GlobalNodeId> nodes;
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      for (const auto& edge : boundary.edges) {
        for (const NodeId node : edge) nodes.push_back(mesh_.global(node));
      }
    }
    NodeFlags flags(mesh_.points.size(), 0);
    flag_at_owners(comm_, owners_, nodes, flags);
    NodeExchange(comm_, owners_, mesh_.owned_nodes, mesh_.ghosts).update(flags);
    return flags;
  }

  /// Skips sides inside a part, unless they may also be boundary edges, as between two blocks.
  void add_cell_sides(const NodeFlags& on_boundary) {
    const EdgeTable edges(mesh_);
    for_each_cell_edge(mesh_, [&](NodeId from, NodeId to, std::int32_t cell) {
      const std::int32_t twin = edges.cell_left_of(to, from);
      const bool inside = twin >= 0 && part_of(twin) == part_of(cell);
      if (!inside || (on_boundary[from] != 0 && on_boundary[to] != 0)) add(from, to, {.part = part_of(cell)});
    });
  }

  std::int32_t part_of(std::int32_t cell) const {
    const std::int32_t triangles = size32(cells_.triangles);
    return cell < triangles ? cells_.triangles[cell] : cells_.quads[cell - triangles];
  }

  /// Evaluates the entries of one edge.
  void settle(std::span<const Side> sides, Outbox<PartSide>& found) const {
    const auto on = [&](bool forward, bool is_cell) {
      const auto at = std::ranges::find_if(
          sides, [&](const Side& s) { return s.forward == forward && (s.part >= 0) == is_cell; });
      return at == sides.end() ? nullptr : &*at;
    };
    for (const bool forward : {true, false}) {
      const Side *const cell = on(forward, true), *const opposite = on(!forward, true),
                        *edge = on(forward, false);
      if (cell == nullptr && edge != nullptr) refuse(*edge);
      const bool between_parts = cell != nullptr && opposite != nullptr && cell->part != opposite->part;
      if (between_parts && edge != nullptr && mesh_.boundaries[edge->boundary].inner_line) edge = nullptr;
      if (cell == nullptr || (edge == nullptr && (opposite == nullptr || opposite->part == cell->part)))
        continue;
      PartSide side{.part = cell->part, .nodes = {cell->low, cell->high}};
      if (!forward) std::swap(side.nodes[0], side.nodes[1]);
      if (edge != nullptr) {
        side.boundary = edge->boundary;
        side.place = edge->place;
      } else {
        side.neighbour = opposite->part;
      }
      found.add(rank_of_part(comm_, side.part, cells_.parts), side);
    }
  }

  [[noreturn]] void refuse(const Side& edge) const {
    throw InputError("edge " + std::to_string(edge.place + 1) + " of boundary '" +
                     mesh_.boundaries[edge.boundary].name +
                     "' has no cell to its left: an invalid mesh cannot be partitioned");
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  const CellParts& cells_;
  NodeOwners owners_;
  Outbox<Side> out_;
};

}  // namespace

std::vector<PartSide> part_sides(const Communicator& comm, const Mesh& mesh, const CellParts& cells) {
  return SideFinder(comm, mesh, cells).find();
}

}  // namespace quadloop
