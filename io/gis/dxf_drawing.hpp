#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A B-spline, rational if it has weights.
struct DxfSpline {
  int degree = 3;
  std::vector<double> knots, weights;
  std::vector<Point> controls;
};

/// Returns points of the curve: all its knots, with enough segments between them for a smooth appearance.
/// Empty if the spline is invalid. De Boor's algorithm (C. de Boor, A Practical Guide to Splines, 1978).
std::vector<Point> points_of(const DxfSpline& spline);

/// An entity in a drawing's section ENTITIES.
struct DxfEntity {
  std::string type;  ///< LINE, DIMENSION, ...
  std::string layer;
  std::optional<DxfSpline> spline;
};

/// Data of a drawing that GDAL does not provide.
class DxfDrawing {
 public:
  /// Reads the file. Throws InputError for a binary drawing, and for a spline given by fit points only.
  explicit DxfDrawing(const std::string& path);

  /// Returns the entity with this handle; null if there is none.
  const DxfEntity* find(const std::string& handle) const;
  /// The drawing reduced to its entities, if it begins with a section that GDAL does not expect.
  const std::string& entities_alone() const { return entities_alone_; }
  /// The unit declared in the drawing, a name of length_units.hpp; empty if there is none.
  const std::string& unit() const { return unit_; }

 private:
  std::map<std::string, DxfEntity> entities_;  ///< by handle
  std::string entities_alone_, unit_;
};

}  // namespace quadloop
