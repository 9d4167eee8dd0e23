#pragma once

#include <cmath>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// A unit of length, a power of two, in which products of four lengths of a mesh neither vanish nor overflow:
/// 1 for all ordinary meshes, else near the mesh's extent. Into it and out of it no bit of a coordinate
/// changes, but for those below 1e-300 of the extent.
class BinaryUnit {
 public:
  /// *Collective.*
  BinaryUnit(const Communicator& comm, const Mesh& mesh);

  bool is_one() const { return exponent_ == 0; }
  Point into(Point p) const { return {std::ldexp(p.x, -exponent_), std::ldexp(p.y, -exponent_)}; }
  Point out_of(Point p) const { return {std::ldexp(p.x, exponent_), std::ldexp(p.y, exponent_)}; }
  Geometry into(const Geometry& geometry) const;

 private:
  static constexpr int largest_ordinary = 200;  ///< exponents of extents, up to about 1e60 and down to 1e-60
  int exponent_ = 0;
};

}  // namespace quadloop
