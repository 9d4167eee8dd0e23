#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop::io {

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
  /// The drawing as GDAL is to read it; empty where that is the file itself. GDAL compares names of layers
  /// and blocks with their case: here each has the case of its definition, else of its first use. It has
  /// nothing but the entities where the file begins with a section that GDAL does not expect there.
  const std::string& corrected() const { return corrected_; }
  /// The layers that are defined.
  const std::vector<std::string>& layers() const { return layers_; }
  /// For each reference to a block whose content is not in the file: the block, and the reference's layer.
  const std::vector<std::pair<std::string, std::string>>& missing_blocks() const { return missing_blocks_; }
  /// The unit that the drawing declares, a name of length_units.hpp; empty where it declares none.
  const std::string& unit() const { return unit_; }

 private:
  /// Writes names of layers and blocks as they are defined; returns whether the text has changed.
  bool correct_names(std::string& text);

  std::map<std::string, DxfEntity> entities_;  ///< by handle
  std::string corrected_, unit_;
  std::vector<std::string> layers_;
  std::vector<std::pair<std::string, std::string>> missing_blocks_;
};

}  // namespace quadloop::io
