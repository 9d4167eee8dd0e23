#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "mesher/geometry/outline_region.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A size source: leaves that meet the shape are at most `spacing` large.
struct SizeSource {
  struct Disc {
    Point centre;
    double radius = 0;

    friend bool operator==(const Disc&, const Disc&) = default;
  };
  struct Line {
    Point from, to;

    friend bool operator==(const Line&, const Line&) = default;
  };
  /// A block of the geometry.
  struct Block {
    std::string name;
    std::shared_ptr<const OutlineRegion> region;

    friend bool operator==(const Block& a, const Block& b) { return a.name == b.name; }
  };
  std::variant<Box, Disc, Line, Block> shape;
  double spacing = 0;
  std::string where = {};  ///< for messages
};

/// Whether the closed shape and the closed box have a point in common.
bool meets(const SizeSource& source, const Box& box);
/// The bounding box of the shape.
Box box_of(const SizeSource& source);

/// A root specified by the user: trees_x by trees_y square trees, with the lower left corner at `corner`.
struct RootOptions {
  Point corner;
  double tree_edge = 0;
  int trees_x = 1, trees_y = 1;
  std::optional<Point> far_corner = {};  ///< the opposite corner, where it must be exact to the bit

  friend bool operator==(const RootOptions&, const RootOptions&) = default;
};

/// Options of the size field. Lengths in the geometry's unit.
struct SizeOptions {
  double min = 0;  ///< lower limit of leaf sizes, positive
  double max = 0;  ///< upper limit of leaf sizes, at least min
  /// The size that the root is chosen to meet, from min to max; without it, max.
  std::optional<double> aim = {};
  double gradation = 1.5;           ///< growth limit 1 < g <= 2: h <= h' + (g-1)/2 d
  std::optional<double> curvature;  ///< maximum turning angle of a boundary per leaf, degrees
  std::optional<double> gap;        ///< number of leaves across the gap between two boundaries
  std::vector<SizeSource> sources;
  std::optional<RootOptions> root;
  /// Translations of the periodic pairs. The root is chosen such that one of them along an axis shifts the
  /// grid by whole trees.
  std::vector<Point> periods = {};
};

}  // namespace quadloop
