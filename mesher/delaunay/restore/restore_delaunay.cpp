#include "mesher/delaunay/restore/restore_delaunay.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/delaunay/restore/blunt_edges.hpp"
#include "mesher/delaunay/restore/region_triangulation.hpp"
#include "mesher/mesh/node_table.hpp"

namespace quadloop {

namespace {

/// Number of rings fetched at once; more are fetched where circumcircles reach farther.
constexpr int first_rings = 2;

using Known = StarHalo::Known;

/// The edges of inner lines on all ranks. *Collective.*
std::vector<StarHalo::GlobalEdge> edges_of_lines(const Communicator& comm, const Mesh& mesh) {
  std::vector<StarHalo::GlobalEdge> own;
  bool any = false;  // the same on all ranks
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    if (!boundary.inner_line) continue;
    any = true;
    for (const auto& [from, to] : boundary.edges) own.push_back({mesh.global(from), mesh.global(to)});
  }
  if (!any) return own;
  return comm.all_gather_values(std::span<const StarHalo::GlobalEdge>(own));
}

/// The triangles around core nodes. Their edges are not on the border of the region, except for boundary
/// edges of the mesh.
class Region {
 public:
  Region(const Communicator& comm, const Mesh& mesh, const Known& known)
      : comm_{comm},
        mesh_{mesh},
        known_{known},
        of_lines_{edges_of_lines(comm, mesh)},
        owners_(comm, mesh.first_node),
        exchange_(comm, owners_, mesh.owned_nodes, mesh.ghosts),
        core_(mesh.points.size(), 0) {}

  /// Adds core nodes; every rank may list any node. *Collective.*
  void add(const std::vector<GlobalNodeId>& nodes) {
    flag_at_owners(comm_, owners_, nodes, core_);
    exchange_.update(core_, [&](std::int32_t node) { return core_[NodeId{node}] != 0; });
  }

  /// The nodes of this rank's triangles with an edge that is wrong after moves, or may be wrong because the
  /// triangle across it is on another rank. *Collective.*
  std::vector<GlobalNodeId> nodes_at_doubtful_edges() const {
    const NodeFlags near = near_moved();
    BluntEdges blunt(mesh_, known_.moved, near);
    std::vector<GlobalNodeId> nodes;
    const auto add = [&](std::initializer_list<NodeId> some) {
      for (const NodeId node : some) nodes.push_back(mesh_.global(node));
    };
    blunt.for_each_pair([&](NodeId a, NodeId b, NodeId c, NodeId d) {
      if (any_flagged(known_.moved, std::array{a, b, c, d}) &&
          in_circle(mesh_.point(a), mesh_.point(b), mesh_.point(c), mesh_.point(d)) >= 0)
        add({a, b, c, d});
    });
    blunt.for_each_single([&](NodeId a, NodeId b, NodeId c) { add({a, b, c}); });
    return nodes;
  }

  /// *Collective.*
  RegionTriangulation triangulate(const std::function<TieRank(Point)>& rank_of) const {
    StarHalo halo(comm_, owners_, mesh_, core_, known_, of_lines_);
    for (int ring = 0; ring < first_rings; ++ring) halo.grow(true);
    std::optional<RegionTriangulation> triangulation(std::in_place, halo, rank_of);
    while (comm_.any(triangulation->uncertain())) {
      const bool again = triangulation->uncertain();
      halo.grow(again);
      if (again) triangulation.emplace(halo, rank_of);
    }
    return std::move(*triangulation);
  }

 private:
  /// Flags the nodes of triangles with a moved node, on any rank. *Collective.*
  NodeFlags near_moved() const {
    QUADLOOP_REQUIRE(known_.moved.size() == mesh_.points.size(), "a flag for each point", known_.moved.size(),
                     mesh_.points.size());
    NodeFlags near(mesh_.points.size(), 0);
    for (const auto& t : mesh_.triangles) {
      if (any_flagged(known_.moved, t)) flag_all(t, near);
    }
    std::vector<GlobalNodeId> of_others;
    for (const NodeId copy : ids_between(NodeId{mesh_.owned_nodes}, NodeId{size32(near)})) {
      if (near[copy] != 0) of_others.push_back(mesh_.global(copy));
    }
    flag_at_owners(comm_, owners_, of_others, near);
    exchange_.update(near);
    return near;
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  Known known_;
  std::vector<StarHalo::GlobalEdge> of_lines_;
  NodeOwners owners_;
  NodeExchange exchange_;
  NodeFlags core_;
};

/// Ranges of all ranks' rows in rank order. *Collective.*
template <class Row>
RankRanges ranges_of(const Communicator& comm, const std::vector<Row>& rows) {
  return {comm, comm.exclusive_sum(std::ssize(rows))};
}

/// Sends each row to the rank given by `rank_of`; returns the rows for this rank, in rank order.
/// *Collective.*
template <class Row, class RankOf>
std::vector<Row> deliver(const Communicator& comm, const std::vector<Row>& rows, const RankOf& rank_of) {
  std::vector<int> ranks;
  for (const Row& row : rows) ranks.push_back(rank_of(row));
  return Exchange(comm, ranks).deliver(rows);
}

/// Same, sorted; sorted by rank first, which is much faster than one sort of concatenated sorted ranges.
/// *Collective.*
template <class Row, class RankOf>
std::vector<Row> deliver_sorted(const Communicator& comm, const std::vector<Row>& rows,
                                const RankOf& rank_of) {
  std::vector<int> ranks;
  for (const Row& row : rows) ranks.push_back(rank_of(row));
  const Exchange exchange(comm, ranks);
  std::vector<Row> arrived = exchange.deliver(rows);
  const auto at = [&](std::size_t i) { return arrived.begin() + static_cast<std::ptrdiff_t>(i); };
  for (const Exchange::Source& source : exchange.sources()) {
    std::sort(at(source.begin), at(source.end));
    std::inplace_merge(arrived.begin(), at(source.begin), at(source.end));
  }
  return arrived;
}

template <class Row>
std::vector<Row> of_block(const std::vector<Row>& rows, std::int32_t block) {
  std::vector<Row> found;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(found),
               [&](const Row& row) { return row.block == block; });
  return found;
}

/// Assigns a block's new triangles to its free slots in a global order: slots by number, triangles by the
/// number of the nearest previous one. *Collective.*
void replace_triangles(const Communicator& comm, const std::vector<FreedTriangle>& freed,
                       std::vector<MadeTriangle> made, Mesh& mesh) {
  const auto size_of = [](const auto& rows) { return std::ssize(rows); };
  QUADLOOP_REQUIRE(comm.sum(size_of(freed)) == comm.sum(size_of(made)), "flips keep the number of triangles");
  const RankRanges triangles = ranges_of(comm, mesh.triangles);
  std::vector<FreedTriangle> slots =
      deliver_sorted(comm, freed, [&](const FreedTriangle& t) { return triangles.rank_of(t.number); });
  made = deliver_sorted(comm, made, [&](const MadeTriangle& t) { return triangles.rank_of(t.near); });
  const RankRanges free_slots = ranges_of(comm, slots);
  std::int64_t next = comm.exclusive_sum(size_of(made));
  made = deliver(comm, made, [&](const MadeTriangle&) { return free_slots.rank_of(next++); });
  NodeTable nodes(mesh);
  for (std::size_t i = 0; i < made.size(); ++i) {
    auto& triangle = mesh.triangles[slots[i].number - triangles.begin(comm.rank())];
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = nodes.local(made[i].nodes[k], made[i].points[k]);
  }
}

/// Puts new triangles in the places of the nearest removed ones. *Collective.*
std::vector<std::int32_t> insert_triangles(const Communicator& comm, std::vector<FreedTriangle> freed,
                                           std::vector<MadeTriangle> made, Mesh& mesh) {
  const RankRanges triangles = ranges_of(comm, mesh.triangles);
  const std::int64_t first = triangles.begin(comm.rank());
  freed = deliver_sorted(comm, freed, [&](const FreedTriangle& t) { return triangles.rank_of(t.number); });
  made = deliver_sorted(comm, made, [&](const MadeTriangle& t) { return triangles.rank_of(t.near); });
  std::vector<std::int32_t> standing(mesh.triangles.size(), 1);
  const auto before = std::exchange(mesh.triangles, {});
  mesh.triangles.reserve(before.size() + made.size() - freed.size());
  NodeTable nodes(mesh);
  auto next = made.begin();
  auto stays = before.begin();
  for (const FreedTriangle& gone : freed) {
    const std::int64_t slot = gone.number - first;
    mesh.triangles.insert(mesh.triangles.end(), stays, before.begin() + slot);
    stays = before.begin() + slot + 1;
    for (standing[slot] = 0; next != made.end() && next->near == gone.number; ++next, ++standing[slot]) {
      auto& triangle = mesh.triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) triangle[k] = nodes.local(next->nodes[k], next->points[k]);
    }
  }
  QUADLOOP_REQUIRE(next == made.end(), "new triangles are near to some that are gone");
  mesh.triangles.insert(mesh.triangles.end(), stays, before.end());
  return standing;
}

std::int32_t number_of_blocks(const Communicator& comm, const std::vector<std::int32_t>& triangle_to_block) {
  const auto last = std::max_element(triangle_to_block.begin(), triangle_to_block.end());
  return static_cast<std::int32_t>(comm.maximum(std::int64_t{last == triangle_to_block.end() ? 0 : *last})) +
         1;
}

void require_restorable(const Mesh& mesh, const std::vector<std::int32_t>& triangle_to_block) {
  QUADLOOP_REQUIRE(mesh.quads.empty(), "triangles alone");
  QUADLOOP_REQUIRE(triangle_to_block.empty() || triangle_to_block.size() == mesh.triangles.size(),
                   "a block for each triangle, or none");
}

/// The changes after moves; none if no edge may be wrong. *Collective.*
std::optional<RegionTriangulation> changed_region(const Communicator& comm, const Mesh& mesh,
                                                  const std::function<TieRank(Point)>& rank_of,
                                                  const Known& known) {
  require_restorable(mesh, known.triangle_to_block);
  std::optional<RegionTriangulation> triangulation;
  Region region(comm, mesh, known);
  std::vector<GlobalNodeId> nodes = region.nodes_at_doubtful_edges();
  while (comm.any(!nodes.empty())) {
    region.add(nodes);
    triangulation.emplace(region.triangulate(rank_of));
    nodes = triangulation->outgrown();
  }
  return triangulation;
}

/// Assigns new triangles to freed slots, block by block. *Collective.*
void put_in_slots(const Communicator& comm, const RegionTriangulation& changed,
                  const std::vector<std::int32_t>& triangle_to_block, Mesh& mesh) {
  const std::int32_t blocks = number_of_blocks(comm, triangle_to_block);
  for (std::int32_t block = 0; block < blocks; ++block) {
    replace_triangles(comm, of_block(changed.freed(), block), of_block(changed.made(), block), mesh);
  }
}

}  // namespace

void restore_delaunay_at(const Communicator& comm, Mesh& mesh, std::vector<GlobalNodeId> nodes,
                         const std::function<TieRank(Point)>& rank_of,
                         const std::vector<std::int32_t>& triangle_to_block) {
  require_restorable(mesh, triangle_to_block);
  const NodeFlags not_said;
  while (comm.any(!nodes.empty())) {  // rarely repeated
    Region region(comm, mesh, {triangle_to_block, not_said});
    region.add(nodes);
    const RegionTriangulation changed = region.triangulate(rank_of);
    put_in_slots(comm, changed, triangle_to_block, mesh);
    nodes = changed.outgrown();
  }
}

void restore_delaunay(const Communicator& comm, Mesh& mesh, const NodeFlags& moved,
                      const std::function<TieRank(Point)>& rank_of,
                      const std::vector<std::int32_t>& triangle_to_block) {
  const std::optional<RegionTriangulation> changed =
      changed_region(comm, mesh, rank_of, {triangle_to_block, moved});
  if (changed) put_in_slots(comm, *changed, triangle_to_block, mesh);
}

std::vector<std::int32_t> restore_delaunay_nearby(const Communicator& comm, Mesh& mesh,
                                                  const NodeFlags& moved,
                                                  const std::function<TieRank(Point)>& rank_of) {
  const std::optional<RegionTriangulation> changed = changed_region(comm, mesh, rank_of, {{}, moved});
  if (!changed) return std::vector<std::int32_t>(mesh.triangles.size(), 1);
  return insert_triangles(comm, changed->freed(), changed->made(), mesh);
}

}  // namespace quadloop
