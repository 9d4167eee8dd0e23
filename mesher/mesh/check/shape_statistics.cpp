#include "mesher/mesh/check/shape_statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "mesher/base/parallel/exchange.hpp"
#include "mesher/mesh/check/corner_range.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/node_exchange.hpp"

namespace quadloop {

namespace {

constexpr double sharp_vertex_degrees = 60, sharp_corner_degrees = 30;

struct PointHash {
  std::size_t operator()(Point p) const {
    constexpr std::size_t odd = 0x9E3779B97F4A7C15;  // 2^64 over the golden ratio
    const std::hash<double> hash;
    return (hash(p.x) * odd) ^ hash(p.y);
  }
};

/// Calls `visit(from, to)` for all segments of non-zero length of all chains.
template <class Visit>
void for_each_segment(std::span<const Chain> geometry, const Visit& visit) {
  for (const Chain& chain : geometry) {
    const std::size_t count = chain.points.size();
    for (std::size_t i = 0; i + (chain.open ? 1 : 0) < count; ++i) {
      const Point from = chain.points[i], to = chain.points[(i + 1) % count];
      if (from != to) visit(from, to);
    }
  }
}

/// Returns the interior angle, 0 to 360, with the domain to the left of the path from `previous` over p to
/// `next`.
double interior_degrees(Point previous, Point p, Point next) {
  const double degrees = corner_degrees(previous, p, next);
  return degrees < 0 ? degrees + 360 : degrees;
}

/// The sharp vertices of the geometry. It passes each vertex once; where it continues from chain to chain,
/// their end points are identical.
std::unordered_set<Point, PointHash> sharp_vertices(std::span<const Chain> geometry) {
  std::unordered_map<Point, Point, PointHash> following;
  for_each_segment(geometry, [&](Point from, Point to) { following[from] = to; });
  std::unordered_set<Point, PointHash> sharp;
  for_each_segment(geometry, [&](Point from, Point to) {
    const auto next = following.find(to);
    if (next != following.end() && interior_degrees(from, to, next->second) < sharp_vertex_degrees)
      sharp.insert(to);
  });
  return sharp;
}

/// The order of the lists of places.
bool comes_before(const SharpPlace& a, const SharpPlace& b) {
  return a.place != b.place ? a.place < b.place : a.degrees < b.degrees;
}

/// Returns the places of all ranks in order. *Collective.*
std::vector<SharpPlace> all_places(const Communicator& comm, const std::vector<SharpPlace>& own) {
  std::vector<SharpPlace> all = comm.all_gather_values(std::span<const SharpPlace>(own));
  std::ranges::sort(all, comes_before);
  return all;
}

void count_corner(double degrees, ShapeStatistics& shape) {
  shape.corners_below_15 += degrees < 15 ? 1 : 0;
  shape.corners_below_25 += degrees < 25 ? 1 : 0;
  shape.corners_below_26 += degrees < 26 ? 1 : 0;
  shape.corners_above_150 += degrees > 150 ? 1 : 0;
}

/// Whether a corner is certainly between 30 and 150 degrees; only others are counted.
bool is_ordinary(const CellCorner& corner) {
  constexpr double tangent_of_30 = 0.57735, slightly_more = 1 + 1e-4;
  return corner.cross > tangent_of_30 * slightly_more * std::abs(corner.dot);
}

/// A cell at a narrow corner, with all nodes on the boundary; of a triangle the last node is invalid.
struct NarrowCell {
  SharpPlace corner;
  std::array<GlobalNodeId, 4> nodes;

  std::size_t width() const { return nodes[3].valid() ? 4 : 3; }
};

/// Counts the corners at this rank's nodes.
class CornerTally {
 public:
  /// *Collective.*
  CornerTally(const Communicator& comm, const Mesh& mesh, const HaloMesh& halo,
              const std::vector<OneSidedEdge>& one_sided, std::span<const Chain> geometry)
      : comm_{comm},
        mesh_{mesh},
        halo_{halo},
        has_geometry_{!geometry.empty()},
        sharp_{sharp_vertices(geometry)} {
    if (has_geometry_) find_boundary(one_sided);
    halo.for_each_cell([&](const auto& nodes) {
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (halo.owns(nodes[k])) add_corner(nodes, k);
      }
    });
  }

  /// *Collective.*
  void add_to(ShapeStatistics& shape) {
    count_passages();
    shape.corners = comm_.sum(own_.corners);
    shape.corners_below_15 = comm_.sum(own_.corners_below_15);
    shape.corners_below_25 = comm_.sum(own_.corners_below_25);
    shape.corners_below_26 = comm_.sum(own_.corners_below_26);
    shape.corners_above_150 = comm_.sum(own_.corners_above_150);
    shape.corners_of_outline = comm_.sum(own_.corners_of_outline);
    shape.corners_in_passages = comm_.sum(own_.corners_in_passages);
    const double smallest = comm_.minimum(range_.smallest()), largest = comm_.maximum(range_.largest());
    if (shape.corners > shape.corners_of_outline + shape.corners_in_passages)
      std::tie(shape.smallest_degrees, shape.largest_degrees) = std::tuple(smallest, largest);
    shape.passages = all_places(comm_, own_.passages);
    shape.sharp_places =
        all_places(comm_, own_.sharp_places);  // at each place the smallest angle comes first
    const auto again = std::ranges::unique(shape.sharp_places, {}, &SharpPlace::place);
    shape.sharp_places.erase(again.begin(), again.end());
  }

 private:
  using Edge = std::array<GlobalNodeId, 2>;

  /// *Collective.*
  void find_boundary(const std::vector<OneSidedEdge>& one_sided) {
    on_boundary_ = NodeFlags(halo_.points().size(), 0);
    for (const OneSidedEdge& edge : one_sided) {
      on_boundary_[edge.from] = on_boundary_[edge.to] = 1;
      boundary_.push_back({halo_.global(edge.from), halo_.global(edge.to)});
    }
    halo_.exchange().update(on_boundary_);
    std::ranges::sort(boundary_);
  }

  /// Whether a cell's edge at one of this rank's nodes is on the boundary.
  bool is_boundary(NodeId from, NodeId to) const {
    return std::ranges::binary_search(boundary_, Edge{halo_.global(from), halo_.global(to)});
  }

  template <class Nodes>
  void add_corner(const Nodes& nodes, std::size_t k) {
    const NodeId before = nodes[(k + nodes.size() - 1) % nodes.size()], node = nodes[k],
                 after = nodes[(k + 1) % nodes.size()];
    const Point p = halo_.point(node);
    const CellCorner corner(halo_.point(before), p, halo_.point(after));
    ++own_.corners;
    if (is_ordinary(corner)) return range_.include(corner);
    const double degrees = corner.degrees();
    const bool narrow = has_geometry_ && degrees > 0 && degrees < sharp_corner_degrees;
    const bool on_boundary = narrow && on_boundary_[node] != 0;
    if (narrow &&
        (sharp_.contains(p) || (on_boundary && is_boundary(before, node) && is_boundary(node, after)))) {
      ++own_.corners_of_outline;
      own_.sharp_places.push_back({p, degrees});
    } else if (on_boundary && all_on_boundary(nodes)) {
      NarrowCell& cell = narrow_.emplace_back(NarrowCell{{p, degrees}, {}});
      for (std::size_t i = 0; i < nodes.size(); ++i) cell.nodes[i] = halo_.global(nodes[i]);
      narrow_corners_.push_back(corner);
    } else {
      count_ordinary(corner, degrees);
    }
  }

  template <class Nodes>
  bool all_on_boundary(const Nodes& nodes) const {
    return std::ranges::all_of(nodes, [&](NodeId node) { return on_boundary_[node] != 0; });
  }

  void count_ordinary(const CellCorner& corner, double degrees) {
    count_corner(degrees, own_);
    range_.include(corner);
  }

  /// Narrow corners are in passages if no two boundary edges of their cells meet. The owners of the edges'
  /// first nodes know which edges are on the boundary. *Collective.*
  void count_passages() {
    const NodeOwners owners(comm_, mesh_.first_node);
    std::vector<Edge> edges;
    std::vector<int> ranks;
    for (const NarrowCell& cell : narrow_) {
      for (std::size_t k = 0; k < cell.width(); ++k) {
        edges.push_back({cell.nodes[k], cell.nodes[(k + 1) % cell.width()]});
        ranks.push_back(owners.rank_of(cell.nodes[k]));
      }
    }
    const Exchange questions(comm_, ranks);
    std::vector<char> answers;
    for (const Edge& edge : questions.deliver(edges))
      answers.push_back(std::ranges::binary_search(boundary_, edge) ? 1 : 0);
    answers = questions.answer(answers);
    auto answer = answers.cbegin();
    for (std::size_t i = 0; i < narrow_.size(); ++i) {
      const std::span<const char> on_boundary(answer, narrow_[i].width());
      answer += std::ssize(on_boundary);
      add_narrow(narrow_[i].corner, narrow_corners_[i], on_boundary);
    }
  }

  void add_narrow(const SharpPlace& place, const CellCorner& corner, std::span<const char> on_boundary) {
    bool meet = false;
    for (std::size_t k = 0; k < on_boundary.size(); ++k)
      meet = meet || (on_boundary[k] != 0 && on_boundary[(k + 1) % on_boundary.size()] != 0);
    if (meet) return count_ordinary(corner, place.degrees);
    ++own_.corners_in_passages;
    own_.passages.push_back(place);
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  const HaloMesh& halo_;
  bool has_geometry_;
  std::unordered_set<Point, PointHash> sharp_;
  NodeFlags on_boundary_;
  std::vector<Edge> boundary_;  ///< edges with a cell on their left only, at this rank's nodes, sorted
  std::vector<NarrowCell> narrow_;
  std::vector<CellCorner> narrow_corners_;
  ShapeStatistics own_;
  CornerRange range_;
};

}  // namespace

ShapeStatistics shape_statistics(const Communicator& comm, const Mesh& mesh, const HaloMesh& halo,
                                 const EdgeStatistics& edges, std::span<const Chain> geometry) {
  ShapeStatistics shape;
  const MeshCounts counts = count(comm, mesh);
  const auto cells = static_cast<double>(counts.triangles + counts.quads);
  if (cells == 0) return shape;
  shape.quad_share = static_cast<double>(counts.quads) / cells;
  CornerTally(comm, mesh, halo, edges.one_sided, geometry).add_to(shape);
  shape.area_ratio_max = edges.ratios.largest;
  shape.area_ratio_p99 = edges.ratios.of_99_percent;
  return shape;
}

}  // namespace quadloop
