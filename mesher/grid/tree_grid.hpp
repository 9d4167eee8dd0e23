#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "mesher/geometry/geometry.hpp"
#include "mesher/grid/size_options.hpp"
#include "mesher/grid/square.hpp"

namespace quadloop {

/// A grid vertex: the intersection of two grid lines, in grid units from the root's lower left corner.
struct GridPoint {
  std::int64_t x = 0, y = 0;
  friend constexpr auto operator<=>(const GridPoint&, const GridPoint&) = default;
};

/// Order of grid vertices along the space-filling curve (Morton order): decided by the coordinate with the
/// highest differing bit (Chan 2002).
constexpr bool comes_earlier(GridPoint a, GridPoint b) {
  const std::int64_t in_x = a.x ^ b.x, in_y = a.y ^ b.y;
  const bool by_x = in_y < in_x && in_y < (in_x ^ in_y);
  return by_x ? a.x < b.x : a.y < b.y;
}

/// A square of the forest by its position. x and y count grid units from the root's lower left corner; a
/// tree's edge is 2^30 units.
struct Quadrant {
  static constexpr int unit_level = 30;

  std::int64_t x = 0, y = 0;
  int level = 0;

  constexpr std::int64_t size() const { return std::int64_t{1} << (unit_level - level); }
  constexpr Quadrant child(Corner quarter) const {
    const Halves from = halves_of(site_of(quarter));
    return {x + from.x * size() / 4, y + from.y * size() / 4, level + 1};
  }
  /// The grid vertex at a corner or the middle of a side.
  constexpr GridPoint at(Site site) const {
    const std::int64_t half = size() / 2;
    return {x + halves_of(site).x * half, y + halves_of(site).y * half};
  }
  /// The grid line of a side: a column for a vertical side, else a row.
  constexpr std::int64_t line(Side side) const {
    const std::int64_t low = is_vertical(side) ? x : y;
    return side == Side::right || side == Side::top ? low + size() : low;
  }
  constexpr bool contains(const Quadrant& q) const {
    return level <= q.level && ((x ^ q.x) | (y ^ q.y)) >> (unit_level - level) == 0;
  }
  friend constexpr bool operator==(const Quadrant&, const Quadrant&) = default;
};

/// The quarter that contains the unit square with lower left vertex (x, y), in the quadrant of this level
/// around it.
constexpr Corner quarter_at(std::int64_t x, std::int64_t y, int level) {
  const int shift = Quadrant::unit_level - 1 - level;
  return corner_at((x >> shift & 1) != 0, (y >> shift & 1) != 0);
}

/// The larger of the two distances along the axes between the closed squares; 0 if they touch.
constexpr std::int64_t chebyshev_gap(const Quadrant& a, const Quadrant& b) {
  const std::int64_t in_x = std::max(a.x - (b.x + b.size()), b.x - (a.x + a.size())),
                     in_y = std::max(a.y - (b.y + b.size()), b.y - (a.y + a.size()));
  return std::max(std::max(in_x, in_y), std::int64_t{0});
}

/// The background grid of the quadtrees: coordinates of the grid lines. Every coordinate is one double,
/// computed in the same way everywhere; mirrored roots have mirrored coordinates, bit for bit.
class TreeGrid {
 public:
  /// `box` is divided into trees_x by trees_y square trees (square up to rounding).
  TreeGrid(const Box& box, int trees_x, int trees_y);

  int trees_x() const { return trees_x_; }
  int trees_y() const { return trees_y_; }
  const Box& box() const { return box_; }
  double tree_edge() const { return tree_edge_; }
  double edge(int level) const { return tree_edge_ / static_cast<double>(std::int64_t{1} << level); }
  /// Whether leaves of this level are larger than requested. Rounding errors of the root do not count.
  bool is_larger(int level, double size) const { return edge(level) > size * (1 + rounding); }

  double x(std::int64_t i) const { return x_.at(i); }
  double y(std::int64_t j) const { return y_.at(j); }
  Point corner(std::int64_t i, std::int64_t j) const { return {x(i), y(j)}; }
  Point corner(GridPoint p) const { return corner(p.x, p.y); }
  /// The last grid line at or before a coordinate inside the root (excluding the root's last side); the unit
  /// square to its right (above it) contains the coordinate.
  std::int64_t column_at(double x) const { return x_.line_before(x); }
  std::int64_t row_at(double y) const { return y_.line_before(y); }
  /// The grid line of this level at exactly this coordinate, if any. Lines of levels allowed by
  /// finest_level() have different doubles; lines of finer levels may coincide.
  std::optional<std::int64_t> column_on(double x, int level) const { return x_.line_on(x, level); }
  std::optional<std::int64_t> row_on(double y, int level) const { return y_.line_on(y, level); }
  Box box_of(const Quadrant& q) const { return {corner(q.x, q.y), corner(q.x + q.size(), q.y + q.size())}; }

  /// The finest level whose leaves are not smaller than `min`, except for rounding. Throws InputError, naming
  /// the setting, if that is deeper than the forest or than double precision allows.
  int finest_level(double min, const char* setting = "spacing.min") const;

  static constexpr double rounding = 1e-12;  ///< relative error of edges that does not count

 private:
  struct Axis {
    double low = 0, high = 0;
    std::int64_t count = 0;
    double unit = 0, unit_rest = 0;  ///< (high - low) / count as a sum of two doubles
    bool exact = false;              ///< every i * unit is a double
    double at(std::int64_t i) const {
      if (i == count) return high;
      return exact ? low + static_cast<double>(i) * unit : rounded_at(i);
    }
    double rounded_at(std::int64_t i) const;
    std::int64_t line_before(double coordinate) const;
    std::optional<std::int64_t> line_on(double coordinate, int level) const;
  };
  static Axis make_axis(double low, double high, int trees);

  Box box_;
  int trees_x_, trees_y_;
  double tree_edge_;
  Axis x_, y_;
};

/// The root for a geometry: as specified by the user; the geometry's bounding box if all four of its sides
/// are boundaries and square trees tile it such that leaves have nearly the size to meet (within a tenth);
/// else one in which the first possible of the `periods` is a number of whole trees, with leaves as near to
/// that size; else a larger one, with leaves of exactly that size. Throws InputError if the geometry exceeds
/// the user's root.
TreeGrid choose_root(const Geometry& geometry, const SizeOptions& sizes);

}  // namespace quadloop
