#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A B-spline, rational where it has weights.
struct DxfSpline {
  int degree = 3;
  std::vector<double> knots, weights;
  std::vector<Point> controls;
};

/// Points of the curve: all its knots, and so many segments between two of them that it looks smooth. Empty
/// where the numbers are none of a spline. De Boor's algorithm (C. de Boor, A Practical Guide to Splines,
/// 1978).
std::vector<Point> points_of(const DxfSpline& spline);

/// One entity of a drawing's section ENTITIES.
struct DxfEntity {
  std::string type;  ///< LINE, DIMENSION, ...
  std::string layer;
  std::optional<DxfSpline> spline;
};

/// What GDAL does not tell of a drawing.
class DxfDrawing {
 public:
  /// Reads the file. Throws InputError for a binary drawing, and for a spline that is given by fit points
  /// alone.
  explicit DxfDrawing(const std::string& path);

  /// Null where there is none with this handle.
  const DxfEntity* find(const std::string& handle) const;
  /// The drawing with nothing but its entities, where it begins with a section that GDAL does not expect
  /// there.
  const std::string& entities_alone() const { return entities_alone_; }
  /// The unit that the drawing declares, a name of length_units.hpp; empty where it declares none.
  const std::string& unit() const { return unit_; }

 private:
  std::map<std::string, DxfEntity> entities_;  ///< by handle
  std::string entities_alone_, unit_;
};

}  // namespace quadloop
