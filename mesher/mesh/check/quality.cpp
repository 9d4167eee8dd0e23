#include "mesher/mesh/check/quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesher/mesh/check/corner_range.hpp"

namespace quadloop {

namespace {

constexpr double fixed_point = 1 << 30;  // sums of 2^33 cells of quality 1 fit into 64 bits

double quality_of_triangle(Point a, Point b, Point c) {
  const double edges = dot(b - a, b - a) + dot(c - b, c - b) + dot(a - c, a - c);
  return edges > 0 ? 2 * std::numbers::sqrt3 * cross(b - a, c - a) / edges : 0;
}

double quality_of_corner(Point previous, Point p, Point next) {
  const double edges = dot(next - p, next - p) + dot(previous - p, previous - p);
  return edges > 0 ? 2 * cross(next - p, previous - p) / edges : 0;
}

/// As std::llround, without the function call; for values from 1 on adding 0.5 is exact enough.
std::int64_t nearest_whole(double value) {
  return value >= 1 ? static_cast<std::int64_t>(value + 0.5) : std::llround(value);
}

/// Quality sums of one rank.
struct QualityTally {
  CornerRange angles;
  double worst = std::numeric_limits<double>::infinity();
  std::int64_t sum = 0;

  template <class Cells>
  void add(const Mesh& mesh, const Cells& cells) {
    constexpr std::size_t width = std::tuple_size_v<typename Cells::value_type>;
    for (const auto& nodes : cells) {
      std::array<Point, width> cell;
      for (std::size_t k = 0; k < width; ++k) cell[k] = mesh.point(nodes[k]);
      for (std::size_t k = 0; k < width; ++k) {
        angles.include({cell[(k + width - 1) % width], cell[k], cell[(k + 1) % width]});
      }
      const double quality = quality_of(cell);
      worst = std::min(worst, quality);
      sum += nearest_whole(quality * fixed_point);
    }
  }
};

}  // namespace

double corner_degrees(Point previous, Point p, Point next) { return CellCorner(previous, p, next).degrees(); }

double quality_of(std::span<const Point> cell) {
  if (cell.size() == 3) return quality_of_triangle(cell[0], cell[1], cell[2]);
  double worst = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < cell.size(); ++k) {
    worst = std::min(worst, quality_of_corner(cell[(k + cell.size() - 1) % cell.size()], cell[k],
                                              cell[(k + 1) % cell.size()]));
  }
  return worst;
}

double skew_of(const std::array<Point, 4>& p) {
  return length(p[0] - p[1] + p[2] - p[3]) / std::sqrt(0.5 * cross(p[2] - p[0], p[3] - p[1]));
}

MeshCounts count(const Communicator& comm, const Mesh& mesh) {
  std::int64_t edges = 0;
  for (const BoundaryEdges& boundary : mesh.boundaries) edges += std::ssize(boundary.edges);
  return {comm.sum(mesh.owned_nodes), comm.sum(std::ssize(mesh.triangles)), comm.sum(std::ssize(mesh.quads)),
          comm.sum(edges)};
}

QualitySummary summarise_quality(const Communicator& comm, const Mesh& mesh) {
  QualityTally tally;
  tally.add(mesh, mesh.triangles);
  tally.add(mesh, mesh.quads);
  QualitySummary result;
  result.counts = count(comm, mesh);
  const std::int64_t cells = result.counts.triangles + result.counts.quads;
  const double smallest = comm.minimum(tally.angles.smallest()),
               largest = comm.maximum(tally.angles.largest()), worst = comm.minimum(tally.worst);
  const std::int64_t sum = comm.sum(tally.sum);
  if (cells == 0) return result;
  result.smallest_degrees = smallest;
  result.largest_degrees = largest;
  result.worst = worst;
  result.mean = static_cast<double>(sum) / fixed_point / static_cast<double>(cells);
  return result;
}

double area_ratio(double area, double other) {
  const double ratio = std::max(area, other) / std::min(area, other);
  return ratio >= 1 ? ratio : std::numeric_limits<double>::infinity();
}

std::vector<double> cell_areas(const Mesh& mesh) {
  std::vector<double> areas;
  areas.reserve(mesh.cell_count());
  const auto add = [&](Point u, Point v) { areas.push_back(cross(u, v) / 2); };
  for (const auto& t : mesh.triangles)
    add(mesh.point(t[1]) - mesh.point(t[0]), mesh.point(t[2]) - mesh.point(t[0]));
  for (const auto& q : mesh.quads)
    add(mesh.point(q[2]) - mesh.point(q[0]), mesh.point(q[3]) - mesh.point(q[1]));
  return areas;
}

double area_of(const Mesh& mesh) {
  long double area = 0;
  for (const auto& t : mesh.triangles)
    area += cross(mesh.point(t[1]) - mesh.point(t[0]), mesh.point(t[2]) - mesh.point(t[0])) / 2;
  for (const auto& q : mesh.quads)
    area += cross(mesh.point(q[2]) - mesh.point(q[0]), mesh.point(q[3]) - mesh.point(q[1])) / 2;
  return static_cast<double>(area);
}

}  // namespace quadloop
