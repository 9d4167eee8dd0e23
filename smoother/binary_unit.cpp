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
  GeometryBuilder builder;
  for (std::int32_t loop = 0; loop < geometry.loop_count(); ++loop) {
    for (std::int32_t v = geometry.loop_start(loop); v < geometry.loop_start(loop + 1); ++v) {
      Curve curve = geometry.curve(v);
      for (Point& p : curve.inner) p = into(p);
      curve.spacing = std::ldexp(curve.spacing, -exponent_);
      builder.add(into(geometry.point(v)), geometry.boundary_of(v), curve, geometry.returns(v));
    }
    builder.end_loop(geometry.block_of(geometry.loop_start(loop)));
  }
  return std::move(builder).geometry(std::move(boundaries), geometry.block_names());
}

}  // namespace quadloop::smoother
