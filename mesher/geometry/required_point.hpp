#pragma once

#include <string>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A point of the domain, or a feature point of its outline, that must be a node of the mesh.
struct RequiredPoint {
  std::string name;
  Point position;
  std::string where;  ///< for messages

  friend bool operator==(const RequiredPoint&, const RequiredPoint&) = default;
};

/// "point 'NAME' at (X, Y)", for messages.
std::string text_of(const RequiredPoint& point);

}  // namespace quadloop
