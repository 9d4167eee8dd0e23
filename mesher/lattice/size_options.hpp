#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// Leaves that meet the shape are no larger than `spacing`.
struct SizeSource {
  struct Disc {
    Point centre;
    double radius = 0;
  };
  struct Line {
    Point from, to;
  };
  std::variant<Box, Disc, Line> shape;
  double spacing = 0;
  std::string where = {};  ///< for messages
};

/// Whether the closed shape and the closed box have a point in common.
bool meets(const SizeSource& source, const Box& box);

/// The root as the user may fix it: trees_x by trees_y square trees, the first one's lower left corner at
/// `corner`.
struct RootOptions {
  Point corner;
  double tree_edge = 0;
  int trees_x = 1, trees_y = 1;
  std::optional<Point> far_corner = {};  ///< the opposite one, where more than this tells it to the bit
};

/// How fine the leaves are. Lengths in the geometry's unit.
struct SizeOptions {
  double min = 0;                   ///< no leaf is cut smaller than this; > 0
  double max = 0;                   ///< no leaf stays larger than this; >= min
  double gradation = 1.5;           ///< 1 < g <= 2: h <= h' + (g-1)/2 d
  std::optional<double> curvature;  ///< degrees that a boundary may turn within one leaf
  std::optional<double> gap;        ///< leaves across the gap between two boundaries
  std::vector<SizeSource> sources;
  std::optional<RootOptions> root;
};

}  // namespace quadloop
