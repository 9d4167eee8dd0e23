#include "mesher/mesh/check/require_sound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/base/mixed_bits.hpp"
#include "mesher/base/parallel/exchange.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"
#include "mesher/mesh/box_over_ranks.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/check/validate_rules.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

namespace {

[[noreturn]] void report_unsound(const std::string& what, Point place) {
  throw Fault(
      fmt::format("the generated mesh is not valid, and nothing is written: {} at ({}, {}); please report it "
                  "with the case",
                  what, place.x, place.y));
}

/// A random position of a node in the plane of 64-bit integers, with wrap-around arithmetic.
struct RandomPlace {
  std::uint64_t x, y;

  friend RandomPlace operator-(RandomPlace a, RandomPlace b) { return {a.x - b.x, a.y - b.y}; }
  friend std::uint64_t cross(RandomPlace a, RandomPlace b) { return a.x * b.y - a.y * b.x; }
};

std::vector<RandomPlace> random_places(const Mesh& mesh) {
  std::vector<RandomPlace> places;
  places.reserve(mesh.points.size());
  for (const NodeId node : ids_below(NodeId{size32(mesh.points)})) {
    const std::uint64_t twice = 2 * static_cast<std::uint64_t>(mesh.global(node).value());
    places.push_back({mixed_bits(golden_step * (twice + 1)), mixed_bits(golden_step * (twice + 2))});
  }
  return places;
}

/// Whether the corner at a certainly turns left, both exactly and in rounded arithmetic from any of its three
/// points: the products exceed any rounding error.
bool surely_turns_left(Point to_next, Point to_previous) {
  constexpr double rounding = 1e-13;
  const double reach =
      std::abs(to_next.x) + std::abs(to_next.y) + std::abs(to_previous.x) + std::abs(to_previous.y);
  return cross(to_next, to_previous) > rounding * reach * reach;
}

bool surely_positive(const std::array<Point, 3>& p) { return surely_turns_left(p[1] - p[0], p[2] - p[0]); }
bool surely_positive(const std::array<Point, 4>& p) {
  return surely_turns_left(p[1] - p[0], p[3] - p[0]) && surely_turns_left(p[2] - p[1], p[0] - p[1]) &&
         surely_turns_left(p[3] - p[2], p[1] - p[2]) && surely_turns_left(p[0] - p[3], p[2] - p[3]);
}

template <class Place>
auto twice_area(const std::array<Place, 3>& p) {
  return cross(p[1] - p[0], p[2] - p[0]);
}
template <class Place>
auto twice_area(const std::array<Place, 4>& p) {
  return cross(p[2] - p[0], p[3] - p[1]);
}

/// One pass over one rank's cells and boundary edges.
class Tally {
 public:
  /// `box` is the bounding box of all ranks' nodes, `count` the number of all cells and boundary edges.
  Tally(const Mesh& mesh, const Box& box, std::int64_t count)
      : mesh_{mesh},
        places_{random_places(mesh)},
        centre_{box.centre()},
        twice_areas_{2, (box.width() + box.height()) * (box.width() + box.height()), count} {
    add_cells(mesh.triangles);
    add_cells(mesh.quads);
    add_boundaries();
  }

  bool all_surely_positive() const { return surely_positive_; }
  /// The sum over all ranks is 0 if the edges of cells and boundary cancel; otherwise it is 0 with a
  /// probability of about 2^-60, as the area is a polynomial of the positions with a term for each edge.
  std::uint64_t random_area() const { return random_area_; }
  /// Twice the area of the cells and twice that enclosed by the boundary, over all ranks. *Collective.*
  std::vector<double> twice_areas(const Communicator& comm) const { return twice_areas_.over(comm); }

 private:
  template <std::size_t width>
  void add_cells(const std::vector<std::array<NodeId, width>>& cells) {
    for (const auto& nodes : cells) {
      std::array<Point, width> points;
      std::array<RandomPlace, width> places;
      for (std::size_t k = 0; k < width; ++k) {
        points[k] = mesh_.point(nodes[k]);
        places[k] = places_[nodes[k].value()];
      }
      surely_positive_ = surely_positive_ && surely_positive(points);
      twice_areas_.add(0, twice_area(points));
      random_area_ += twice_area(places);
    }
  }

  void add_boundaries() {
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      if (boundary.two_sided()) continue;  // the cells on the two sides cancel
      for (const auto& [from, to] : boundary.edges) {
        twice_areas_.add(1, cross(mesh_.point(from) - centre_, mesh_.point(to) - centre_));
        random_area_ -= cross(places_[from.value()], places_[to.value()]);
      }
    }
  }

  const Mesh& mesh_;
  std::vector<RandomPlace> places_;
  Point centre_;
  ReproducibleSums twice_areas_;
  std::uint64_t random_area_ = 0;
  bool surely_positive_ = true;
};

/// Whether the sum over all ranks is 0. *Collective.*
bool is_zero_over_ranks(const Communicator& comm, std::uint64_t random_area) {
  const std::vector<std::uint64_t> areas = comm.all_gather(random_area);
  return std::accumulate(areas.begin(), areas.end(), std::uint64_t{0}) == 0;
}

/// The lower number first.
using UndirectedEdge = std::pair<GlobalNodeId, GlobalNodeId>;

/// An edge whose uses do not cancel, with the position of an end.
struct UnmatchedEdge {
  GlobalNodeId low, high;
  int uses;
  Point place;
};

/// Reports the unmatched edges, of which there must be some. *Collective.*
[[noreturn]] void report_unmatched(const Communicator& comm, const Mesh& mesh) {
  std::map<UndirectedEdge, std::pair<int, Point>> uses;
  const auto add = [&](GlobalNodeId a, GlobalNodeId b, int way, Point place) {
    auto& [count, at] = uses[std::minmax(a, b)];
    count += a < b ? way : -way;
    at = place;
  };
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t) {
    add(mesh.global(from), mesh.global(to), 1, mesh.point(from));
  });
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& [from, to] : boundary.two_sided() ? decltype(boundary.edges){} : boundary.edges)
      add(mesh.global(from), mesh.global(to), -1, mesh.point(from));
  }
  std::vector<UnmatchedEdge> own;
  for (const auto& [edge, use] : uses) {
    if (use.first != 0) own.push_back({edge.first, edge.second, use.first, use.second});
  }
  uses.clear();
  for (const UnmatchedEdge& edge : comm.all_gather_values(std::span<const UnmatchedEdge>(own)))
    add(edge.low, edge.high, edge.uses, edge.place);
  for (const auto& [edge, use] : uses) {
    if (use.first != 0)
      report_unsound("an edge does not have a cell, or the boundary, on either side", use.second);
  }
  report_unsound("some edges do not have a cell, or the boundary, on either side", {});
}

/// A boundary edge with the lower node first.
struct PlacedEdge {
  GlobalNodeId low, high;
  Point place;
  UndirectedEdge nodes() const { return {low, high}; }
};

/// Returns boundary edges, sorted by their nodes: all with the same nodes are on one rank. *Collective.*
std::vector<PlacedEdge> meeting_boundary_edges(const Communicator& comm, const Mesh& mesh) {
  Outbox<PlacedEdge> out;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& [from, to] : boundary.edges) {
      const auto [low, high] = std::minmax({mesh.global(from), mesh.global(to)});
      const auto rank = mixed_bits(static_cast<std::uint64_t>(low.value())) % comm.size();
      out.add(static_cast<int>(rank), {low, high, mesh.point(from)});
    }
  }
  std::vector<PlacedEdge> edges = out.deliver(comm);
  std::ranges::sort(edges, {}, &PlacedEdge::nodes);
  return edges;
}

/// Checks that no two boundary edges have the same nodes: cells on both sides would pass all other rules.
/// *Collective.*
void require_single_boundary_edges(const Communicator& comm, const Mesh& mesh) {
  const std::vector<PlacedEdge> edges = meeting_boundary_edges(comm, mesh);
  const auto twice = std::ranges::adjacent_find(edges, {}, &PlacedEdge::nodes);
  comm.together([&] {
    if (twice != edges.end()) report_unsound("an edge of the boundary has cells on both sides", twice->place);
  });
}

/// Checks the corners of every cell exactly. *Collective.*
void require_positive(const Communicator& comm, const Mesh& mesh) {
  comm.together([&] {
    Faults faults;
    check_positive(mesh, faults);
    if (!faults.empty()) report_unsound(faults.front().what, faults.front().place);
  });
}

/// *Collective.*
bool has_single_boundary_edges(const Communicator& comm, const Mesh& mesh) {
  const std::vector<PlacedEdge> edges = meeting_boundary_edges(comm, mesh);
  return !comm.any(std::ranges::adjacent_find(edges, {}, &PlacedEdge::nodes) != edges.end());
}

/// *Collective.*
bool all_positive(const Communicator& comm, const Mesh& mesh) {
  Faults faults;
  check_positive(mesh, faults);
  return !comm.any(!faults.empty());
}

}  // namespace

bool is_sound(const Communicator& comm, const Mesh& mesh) {
  const MeshCounts counts = count(comm, mesh);
  const Tally tally(mesh, box_over_ranks(comm, mesh.points),
                    counts.triangles + counts.quads + counts.boundary_edges);
  if (comm.any(!tally.all_surely_positive()) && !all_positive(comm, mesh)) return false;
  if (!is_zero_over_ranks(comm, tally.random_area()) || !has_single_boundary_edges(comm, mesh)) return false;
  const std::vector<double> twice = tally.twice_areas(comm);
  return std::abs(twice[0] - twice[1]) <= area_tolerance * std::abs(twice[1]);
}

void require_sound(const Communicator& comm, const Mesh& mesh) {
  const Box box = box_over_ranks(comm, mesh.points);
  const MeshCounts counts = count(comm, mesh);
  const Tally tally(mesh, box, counts.triangles + counts.quads + counts.boundary_edges);
  if (comm.any(!tally.all_surely_positive())) require_positive(comm, mesh);
  if (!is_zero_over_ranks(comm, tally.random_area())) report_unmatched(comm, mesh);
  require_single_boundary_edges(comm, mesh);
  const std::vector<double> twice = tally.twice_areas(comm);
  if (std::abs(twice[0] - twice[1]) <= area_tolerance * std::abs(twice[1])) return;
  report_unsound(fmt::format("the cells cover {}, the boundary encloses {}", twice[0] / 2, twice[1] / 2),
                 box.centre());
}

}  // namespace quadloop
