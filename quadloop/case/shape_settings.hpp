#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/assemble/naca_airfoil.hpp"
#include "mesher/geometry/assemble/transform.hpp"
#include "quadloop/case/key_table.hpp"
#include "quadloop/case/settings.hpp"

namespace quadloop {

/// Settings of a table [[shape]].
struct ShapeKeys {
  enum class Kind { naca, circle, rectangle, polygon, curve };
  std::string name;
  Kind kind = Kind::naca;
  NacaAirfoil naca;
  Point centre;
  double radius = 0;
  std::vector<double> box;
  std::vector<Point> points;
  bool spline = false;
  Transform placement;
};

const KeyTable<ShapeKeys>& shape_keys();

/// Reads a table [[shape]]. Throws InputError that names key and line.
Shape read_shape(const io::CaseTable& table);

}  // namespace quadloop
