#include "mesher/delaunay/restore/restore_delaunay.hpp"

#include <algorithm>
#include <limits>
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

/// A side of a removed or new triangle.
struct ChangedSide {
  std::array<GlobalNodeId, 2> ends;  ///< smaller first
  bool backward;                     ///< the triangle turns from the second end to the first
  bool made;
  std::int64_t triangle;
  friend auto operator<=>(const ChangedSide&, const ChangedSide&) = default;
};

/// Pairs of removed or new triangles that overlap or are beside each other in one cavity: on one side of an
/// edge that stays, or on both sides of one that is removed or new. Each triangle's rank has its pairs.
/// `numbers` are those by which ChangedSide names the triangles. *Collective.*
std::vector<std::array<std::int64_t, 2>> pairs_in_cavities(const Communicator& comm,
                                                           std::vector<ChangedSide> sides,
                                                           const RankRanges& numbers) {
  std::ranges::sort(sides);
  Outbox<std::array<std::int64_t, 2>> pairs;
  for (auto at = sides.begin(); at != sides.end();) {
    const auto end =
        std::find_if(at, sides.end(), [&](const ChangedSide& side) { return side.ends != at->ends; });
    const bool stays = std::any_of(at, end, [&](const ChangedSide& side) { return side.made != at->made; });
    for (auto a = at; a != end; ++a) {
      for (auto b = at; b != end; ++b) {
        if (a != b && (!stays || a->backward == b->backward))
          pairs.add(numbers.rank_of(a->triangle), {a->triangle, b->triangle});
      }
    }
    at = end;
  }
  return pairs.deliver(comm);
}

/// Returns the cavity of each removed, then of each new triangle of this rank: the lowest number of a removed
/// triangle in it. Cavities are the smallest regions with removed and new triangles, equally many of each.
/// *Collective.*
std::vector<std::int64_t> cavities(const Communicator& comm, const Mesh& mesh,
                                   const std::vector<FreedTriangle>& freed,
                                   const std::vector<MadeTriangle>& made, std::int64_t first_triangle) {
  const NodeOwners owners(comm, mesh.first_node);
  std::int64_t next = comm.exclusive_sum(std::ssize(freed) + std::ssize(made));
  const std::int64_t first = next;
  const RankRanges numbers(comm, first);
  Outbox<ChangedSide> sides;
  const auto add = [&](const std::array<GlobalNodeId, 3>& nodes, bool is_made) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(nodes[k], nodes[(k + 1) % 3]);
      sides.add(owners.rank_of(low), {{low, high}, low != nodes[k], is_made, next});
    }
    ++next;
  };
  std::vector<std::int64_t> found;
  for (const FreedTriangle& t : freed) {
    const auto& [a, b, c] = mesh.triangles[t.number - first_triangle];
    add({mesh.global(a), mesh.global(b), mesh.global(c)}, false);
    found.push_back(t.number);
  }
  for (const MadeTriangle& t : made) add(t.nodes, true);
  found.resize(freed.size() + made.size(), std::numeric_limits<std::int64_t>::max());

  const auto pairs = pairs_in_cavities(comm, sides.deliver(comm), numbers);
  std::vector<int> ranks;
  std::vector<std::int64_t> others;
  for (const auto& [own, other] : pairs) {
    ranks.push_back(numbers.rank_of(other));
    others.push_back(other);
  }
  const Exchange questions(comm, ranks);
  const std::vector<std::int64_t> asked = questions.deliver(others);
  for (bool any_changed = true; any_changed;) {
    std::vector<std::int64_t> answers;
    for (const std::int64_t triangle : asked) answers.push_back(found[triangle - first]);
    answers = questions.answer(answers);
    const auto before = found;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      std::int64_t& own = found[pairs[i][0] - first];
      own = std::min(own, answers[i]);
    }
    any_changed = comm.any(found != before);
  }
  return found;
}

/// A removed or new triangle with the number of its cavity or slot.
template <class Triangle>
struct Numbered {
  std::int64_t number = 0;
  Triangle triangle;
  friend auto operator<=>(const Numbered&, const Numbered&) = default;
};

/// Assigns new triangles to the slots of removed ones in the same cavity, which are near. *Collective.*
void put_in_slots(const Communicator& comm, const RegionTriangulation& changed, Mesh& mesh) {
  const RankRanges triangles = ranges_of(comm, mesh.triangles);
  const std::int64_t first = triangles.begin(comm.rank());
  const auto freed =
      deliver(comm, changed.freed(), [&](const FreedTriangle& t) { return triangles.rank_of(t.number); });
  const auto made =
      deliver(comm, changed.made(), [&](const MadeTriangle& t) { return triangles.rank_of(t.near); });
  const std::vector<std::int64_t> found = cavities(comm, mesh, freed, made, first);
  Outbox<Numbered<FreedTriangle>> slots_out;
  Outbox<Numbered<MadeTriangle>> made_out;
  for (std::size_t i = 0; i < freed.size(); ++i)
    slots_out.add(triangles.rank_of(found[i]), {found[i], freed[i]});
  for (std::size_t i = 0; i < made.size(); ++i) {
    const std::int64_t cavity = found[freed.size() + i];
    made_out.add(triangles.rank_of(cavity), {cavity, made[i]});
  }
  auto slots = slots_out.deliver(comm);
  auto fillings = made_out.deliver(comm);
  std::ranges::sort(slots);
  std::ranges::sort(fillings);
  QUADLOOP_REQUIRE(slots.size() == fillings.size(), "flips keep the number of triangles");
  Outbox<Numbered<MadeTriangle>> filled;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    QUADLOOP_REQUIRE(slots[i].number == fillings[i].number, "a cavity keeps the number of its triangles");
    const std::int64_t slot = slots[i].triangle.number;
    filled.add(triangles.rank_of(slot), {slot, fillings[i].triangle});
  }
  NodeTable nodes(mesh);
  for (const auto& [slot, triangle] : filled.deliver(comm)) {
    for (std::size_t k = 0; k < 3; ++k)
      mesh.triangles[slot - first][k] = nodes.local(triangle.nodes[k], triangle.points[k]);
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
    put_in_slots(comm, changed, mesh);
    nodes = changed.outgrown();
  }
}

void restore_delaunay(const Communicator& comm, Mesh& mesh, const NodeFlags& moved,
                      const std::function<TieRank(Point)>& rank_of,
                      const std::vector<std::int32_t>& triangle_to_block) {
  const std::optional<RegionTriangulation> changed =
      changed_region(comm, mesh, rank_of, {triangle_to_block, moved});
  if (changed) put_in_slots(comm, *changed, mesh);
}

std::vector<std::int32_t> restore_delaunay_nearby(const Communicator& comm, Mesh& mesh,
                                                  const NodeFlags& moved,
                                                  const std::function<TieRank(Point)>& rank_of) {
  const std::optional<RegionTriangulation> changed = changed_region(comm, mesh, rank_of, {{}, moved});
  if (!changed) return std::vector<std::int32_t>(mesh.triangles.size(), 1);
  return insert_triangles(comm, changed->freed(), changed->made(), mesh);
}

}  // namespace quadloop
