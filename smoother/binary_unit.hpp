#pragma once

#include <cmath>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::smoother {

/// A power of two used as the unit of length, so that products of four lengths of the mesh neither underflow
/// nor overflow. It is 1 for ordinary meshes, else near the mesh's extent. Conversion in both directions is
/// exact, except for coordinates below 1e-300 of the extent.
class BinaryUnit {
 public:
  /// *Collective.*
  BinaryUnit(const Communicator& comm, const Mesh& mesh);

  bool is_one() const { return exponent_ == 0; }
  Point into(Point p) const { return {std::ldexp(p.x, -exponent_), std::ldexp(p.y, -exponent_)}; }
  Point out_of(Point p) const { return {std::ldexp(p.x, exponent_), std::ldexp(p.y, exponent_)}; }
  Geometry into(const Geometry& geometry) const;

 private:
  static constexpr int largest_ordinary = 200;  ///< largest |exponent| of an ordinary extent: 1e-60 to 1e60
  int exponent_ = 0;
};

}  // namespace quadloop::smoother
