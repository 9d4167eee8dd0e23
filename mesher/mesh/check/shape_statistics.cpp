#include "mesher/mesh/check/shape_statistics.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <unordered_map>

#include "mesher/mesh/check/cell_pairs.hpp"
#include "mesher/mesh/check/corner_range.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
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

/// The sharp vertices of the geometry, and the smallest exempt cell angle at each.
class SharpVertices {
 public:
  /// The geometry passes each vertex once; where it continues from chain to chain, their end points are
  /// identical.
  explicit SharpVertices(std::span<const Chain> geometry) {
    std::unordered_map<Point, Point, PointHash> following;
    for_each_segment(geometry, [&](Point from, Point to) { following[from] = to; });
    for_each_segment(geometry, [&](Point from, Point to) {
      const auto next = following.find(to);
      if (next != following.end() && interior_degrees(from, to, next->second) < sharp_vertex_degrees)
        smallest_.emplace(to, infinity);
    });
  }

  /// Whether the cell corner at p is exempt. `own`: it lies between two boundary edges, i.e. is the
  /// boundary's own angle.
  bool excepts(Point p, double degrees, bool own) {
    if (!(degrees > 0 && degrees < sharp_corner_degrees)) return false;
    auto vertex = smallest_.find(p);
    if (vertex == smallest_.end() && own) vertex = smallest_.emplace(p, infinity).first;
    if (vertex == smallest_.end()) return false;
    vertex->second = std::min(vertex->second, degrees);
    return true;
  }

  std::vector<SharpPlace> places() const {
    std::vector<SharpPlace> places;
    for (const auto& [place, degrees] : smallest_) {
      if (degrees < infinity) places.push_back({place, degrees});
    }
    std::sort(places.begin(), places.end(),
              [](const SharpPlace& a, const SharpPlace& b) { return a.place < b.place; });
    return places;
  }

 private:
  std::unordered_map<Point, double, PointHash> smallest_;
};

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

/// Finds the cells that span a passage.
class PassageTest {
 public:
  PassageTest(const Mesh& mesh, const MeshTopology& topology)
      : table_{topology.table()}, on_boundary_(mesh.points.size(), 0) {
    for (const auto& [from, to] : topology.outer_edges()) on_boundary_[from] = on_boundary_[to] = 1;
  }

  bool is_boundary(NodeId from, NodeId to) const { return !is_inner(from, to); }

  /// Whether all nodes of a cell are on the boundary, and no two of its boundary edges meet.
  template <std::size_t width>
  bool fills(const std::array<NodeId, width>& cell) const {
    for (const NodeId node : cell) {
      if (on_boundary_[node] == 0) return false;
    }
    for (std::size_t k = 0; k < width; ++k) {
      const NodeId a = cell[k], b = cell[(k + 1) % width], c = cell[(k + 2) % width];
      if (!is_inner(a, b) && !is_inner(b, c)) return false;
    }
    return true;
  }

 private:
  bool is_inner(NodeId from, NodeId to) const { return table_.cell_left_of(to, from) >= 0; }

  const EdgeTable& table_;
  NodeFlags on_boundary_;
};

template <class Cells>
void add_corners(const Mesh& mesh, const Cells& cells, SharpVertices& sharp, const PassageTest* passages,
                 ShapeStatistics& shape, CornerRange& range) {
  for (const auto& nodes : cells) {
    const std::size_t width = nodes.size();
    for (std::size_t k = 0; k < width; ++k) {
      const Point p = mesh.point(nodes[k]);
      const CellCorner corner(mesh.point(nodes[(k + width - 1) % width]), p,
                              mesh.point(nodes[(k + 1) % width]));
      ++shape.corners;
      if (is_ordinary(corner)) {
        range.include(corner);
        continue;
      }
      const double degrees = corner.degrees();
      const bool own = passages != nullptr &&
                       passages->is_boundary(nodes[(k + width - 1) % width], nodes[k]) &&
                       passages->is_boundary(nodes[k], nodes[(k + 1) % width]);
      if (sharp.excepts(p, degrees, own)) {
        ++shape.corners_of_outline;
      } else if (passages != nullptr && degrees > 0 && degrees < sharp_corner_degrees &&
                 passages->fills(nodes)) {
        ++shape.corners_in_passages;
        shape.passages.push_back({p, degrees});
      } else {
        count_corner(degrees, shape);
        range.include(corner);
      }
    }
  }
}

void add_all_corners(const Mesh& mesh, const MeshTopology& topology, std::span<const Chain> geometry,
                     ShapeStatistics& shape) {
  SharpVertices sharp(geometry);
  std::optional<PassageTest> test;
  if (!geometry.empty()) test.emplace(mesh, topology);
  const PassageTest* passages = test ? &*test : nullptr;
  CornerRange range;
  add_corners(mesh, mesh.triangles, sharp, passages, shape, range);
  add_corners(mesh, mesh.quads, sharp, passages, shape, range);
  shape.smallest_degrees = range.smallest();
  shape.largest_degrees = range.largest();
  if (shape.corners == shape.corners_of_outline + shape.corners_in_passages)
    shape.smallest_degrees = shape.largest_degrees = 0;
  shape.sharp_places = sharp.places();
  std::sort(shape.passages.begin(), shape.passages.end(), [](const SharpPlace& a, const SharpPlace& b) {
    return a.place != b.place ? a.place < b.place : a.degrees < b.degrees;
  });
}

/// Returns one ratio for each inner edge.
std::vector<double> ratios_at_edges(const Mesh& mesh, const MeshTopology& topology) {
  const std::vector<double> areas = cell_areas(mesh);
  const auto area = [&](std::int32_t cell) { return areas[cell]; };
  std::vector<double> ratios;
  auto beyond = topology.beyond().begin();
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t cell) {
    const std::int32_t other = *beyond++;
    if (to < from) return;  // counted by the cell on the other side
    if (other >= 0) ratios.push_back(area_ratio(area(cell), area(other)));
  });
  return ratios;
}

double area_of_cell(const std::array<Point, 3>& p) { return cross(p[1] - p[0], p[2] - p[0]) / 2; }
double area_of_cell(const std::array<Point, 4>& p) { return cross(p[2] - p[0], p[3] - p[1]) / 2; }

/// Returns one ratio for each inner edge of which this rank owns the node with the lower number.
/// *Collective.*
std::vector<double> ratios_at_edges(const HaloMesh& halo) {
  std::vector<double> ratios;
  CellPairs<double> pairs(halo, [](NodeId) { return true; });
  pairs.for_each([&](const auto& nodes, std::int32_t) { return area_of_cell(corners_of(halo, nodes)); },
                 [&](NodeId from, NodeId to, double area, double other) {
                   if (halo.owns(to) || halo.global(from) < halo.global(to))
                     ratios.push_back(area_ratio(area, other));
                 });
  return ratios;
}

/// The 99th percentile is the smallest value that 99 % do not exceed: its rank, from 1, among `count` values.
std::int64_t rank_of_99_percent(std::int64_t count) { return (count * 99 + 99) / 100; }

/// Returns the k-th smallest value of all ranks, which are sorted on each and not negative. *Collective.*
double kth_smallest(const Communicator& comm, const std::vector<double>& values, std::int64_t k) {
  std::uint64_t low = 0, high = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());
  while (low < high) {  // such numbers are ordered as their bits
    const std::uint64_t middle = low + (high - low) / 2;
    const auto end = std::ranges::upper_bound(values, std::bit_cast<double>(middle));
    if (comm.sum(end - values.begin()) >= k)
      high = middle;
    else
      low = middle + 1;
  }
  return std::bit_cast<double>(low);
}

/// Returns the 99th percentile of a non-empty list. Reorders the values.
double percentile_99(std::vector<double>& values) {
  const auto at = values.begin() + rank_of_99_percent(std::ssize(values)) - 1;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

AreaRatios area_ratios(const Mesh& mesh, const MeshTopology& topology) {
  std::vector<double> ratios = ratios_at_edges(mesh, topology);
  if (ratios.empty()) return {};
  return {*std::max_element(ratios.begin(), ratios.end()), percentile_99(ratios)};
}

}  // namespace

AreaRatios area_ratios(const Communicator& comm, const Mesh& mesh) {
  std::vector<double> ratios = ratios_at_edges(HaloMesh(comm, mesh));
  const std::int64_t count = comm.sum(std::ssize(ratios));
  if (count == 0) return {};
  std::ranges::sort(ratios);
  return {comm.maximum(ratios.empty() ? 0 : ratios.back()),
          kth_smallest(comm, ratios, rank_of_99_percent(count))};
}

ShapeStatistics shape_statistics(const Mesh& whole_mesh, const MeshTopology& topology,
                                 std::span<const Chain> geometry) {
  ShapeStatistics shape;
  const double triangles = size32(whole_mesh.triangles), quads = size32(whole_mesh.quads);
  if (triangles + quads == 0) return shape;
  shape.quad_share = quads / (triangles + quads);
  add_all_corners(whole_mesh, topology, geometry, shape);
  const AreaRatios ratios = area_ratios(whole_mesh, topology);
  shape.area_ratio_max = ratios.largest;
  shape.area_ratio_p99 = ratios.of_99_percent;
  return shape;
}

}  // namespace quadloop
