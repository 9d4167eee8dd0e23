#include "smoother/binary_unit.hpp"

#include <algorithm>
#include <cstdlib>

#include "mesher/mesh/box_over_ranks.hpp"

namespace quadloop::smoother {

BinaryUnit::BinaryUnit(const Communicator& comm, const Mesh& mesh) {
  const auto [low, high] = box_over_ranks(comm, mesh.points);
  const double half =
      std::max(high.x / 2 - low.x / 2, high.y / 2 - low.y / 2);  // halves: the whole extent may overflow
  if (!(half > 0) || !std::isfinite(half)) return;
  const int exponent = std::ilogb(half);
  if (std::abs(exponent) > largest_ordinary) exponent_ = exponent;
}

Geometry BinaryUnit::into(const Geometry& geometry) const {
  std::vector<Boundary> boundaries(geometry.boundaries().begin(), geometry.boundaries().end());
  for (Boundary& boundary : boundaries) boundary.spacing = std::ldexp(boundary.spacing, -exponent_);
  std::vector<Point> points;
  std::vector<BoundaryId> segment_boundary;
  for (std::int32_t v = 0; v < geometry.size(); ++v) {
    points.push_back(into(geometry.point(v)));
    segment_boundary.push_back(geometry.boundary_of(v));
  }
  std::vector<std::int32_t> loop_starts;
  for (std::int32_t loop = 0; loop <= geometry.loop_count(); ++loop)
    loop_starts.push_back(geometry.loop_start(loop));
  return {std::move(boundaries), std::move(points), std::move(loop_starts), std::move(segment_boundary)};
}

}  // namespace quadloop::smoother
