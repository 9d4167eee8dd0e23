#include "mesher/grid/tree_grid.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

constexpr int most_trees = 16;     ///< along one side of the root
constexpr int deepest_level = 29;  ///< p4est's limit
/// Mantissa bits of a padded root's tree edge, so that grid coordinates are exact.
constexpr int root_mantissa_bits = 16;

std::string text(Point p) {
  std::ostringstream out;
  out.precision(17);
  out << "(" << p.x << ", " << p.y << ")";
  return out.str();
}

/// Whether segments of the geometry cover a whole side of its bounding box; `along` and `across` select the
/// coordinates.
template <class Along, class Across>
bool side_is_boundary(const Geometry& g, double at, double low, double high, Along along, Across across) {
  std::vector<std::pair<double, double>> covered;
  for (std::int32_t v = 0; v < g.size(); ++v) {
    const Point a = g.point(v), b = g.point(g.next(v));
    if (across(a) == at && across(b) == at)
      covered.emplace_back(std::min(along(a), along(b)), std::max(along(a), along(b)));
  }
  std::sort(covered.begin(), covered.end());
  double reached = low;
  for (const auto& [from, to] : covered) {
    if (from > reached) return false;
    reached = std::max(reached, to);
  }
  return reached >= high;
}

bool is_own_root(const Geometry& g) {
  const Box& box = g.box();
  const auto x = [](Point p) { return p.x; };
  const auto y = [](Point p) { return p.y; };
  return side_is_boundary(g, box.low.y, box.low.x, box.high.x, x, y) &&
         side_is_boundary(g, box.high.y, box.low.x, box.high.x, x, y) &&
         side_is_boundary(g, box.low.x, box.low.y, box.high.y, y, x) &&
         side_is_boundary(g, box.high.x, box.low.y, box.high.y, y, x);
}

/// The smallest number of square trees that tile the box, if any.
std::optional<std::pair<int, int>> tiling(const Box& box) {
  for (int longer = 1; longer <= most_trees; ++longer) {
    for (int shorter = 1; shorter <= longer; ++shorter) {
      const int nx = box.width() >= box.height() ? longer : shorter,
                ny = box.width() >= box.height() ? shorter : longer;
      if (std::abs(box.width() / nx - box.height() / ny) <= 1e-12 * box.width() / nx)
        return std::pair{nx, ny};
    }
  }
  return std::nullopt;
}

double round_up_mantissa(double value) {
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  return std::ldexp(std::ceil(std::ldexp(fraction, root_mantissa_bits)), exponent - root_mantissa_bits);
}

TreeGrid padded_root(const Box& box) {
  const double longer = std::max(box.width(), box.height()), shorter = std::min(box.width(), box.height());
  const double pad = longer / 64;
  int along = 1, across = 1;
  for (along = 1; along <= most_trees; ++along) {
    const double edge = (longer + 2 * pad) / along;
    across = std::max(1, static_cast<int>(std::ceil((shorter + 2 * pad) / edge)));
    if (across * edge - (shorter + 2 * pad) < (shorter + 2 * pad) / 8) break;
  }
  along = std::min(along, most_trees);
  const double edge = round_up_mantissa((longer + 2 * pad) / along);
  const double grain = edge / 256;
  const Point centre{grain * std::nearbyint(box.centre().x / grain),
                     grain * std::nearbyint(box.centre().y / grain)};
  const int nx = box.width() >= box.height() ? along : across,
            ny = box.width() >= box.height() ? across : along;
  const Point half{0.5 * nx * edge, 0.5 * ny * edge};
  return {{centre - half, centre + half}, nx, ny};
}

TreeGrid users_root(const Geometry& g, const RootOptions& root) {
  const Point across{root.trees_x * root.tree_edge, root.trees_y * root.tree_edge};
  const Box box{root.corner, root.far_corner.value_or(root.corner + across)};
  for (std::int32_t v = 0; v < g.size(); ++v) {
    if (box.contains(g.point(v))) continue;
    throw InputError("boundary " + g.boundary(g.boundary_of(v)).name + ": the point " + text(g.point(v)) +
                     " lies outside [mesh] root; make the root larger");
  }
  return {box, root.trees_x, root.trees_y};
}

}  // namespace

TreeGrid::Axis TreeGrid::make_axis(double low, double high, int trees) {
  using Wide = __float128;
  Axis axis;
  axis.low = low;
  axis.high = high;
  axis.count = std::int64_t{trees} << Quadrant::unit_level;
  const Wide unit = (Wide(high) - low) / axis.count;
  axis.unit = static_cast<double>(unit);
  axis.unit_rest = static_cast<double>(unit - axis.unit);
  int exponent = 0;
  const double spare = std::ldexp(std::frexp(axis.unit, &exponent), 53 - 35);  // a count has at most 35 bits
  axis.exact = axis.unit_rest == 0 && spare == std::floor(spare);
  return axis;
}

/// The coordinate of an interior line if the unit is not exactly a double.
double TreeGrid::Axis::rounded_at(std::int64_t i) const {
  const double n = static_cast<double>(i);
  const double product = n * unit, product_rest = std::fma(n, unit, -product) + n * unit_rest;
  const double sum = low + product, back = sum - low;
  const double sum_rest = (low - (sum - back)) + (product - back);
  return sum + (sum_rest + product_rest);
}

std::int64_t TreeGrid::Axis::line_before(double coordinate) const {
  std::int64_t i = std::clamp(static_cast<std::int64_t>((coordinate - low) / unit), std::int64_t{0}, count);
  while (i > 0 && at(i) > coordinate) --i;
  while (i < count && at(i + 1) <= coordinate) ++i;
  return i;
}

std::optional<std::int64_t> TreeGrid::Axis::line_on(double coordinate, int level) const {
  const std::int64_t step = std::int64_t{1} << (Quadrant::unit_level - level);
  const double steps = (coordinate - low) / (static_cast<double>(step) * unit);
  if (!(steps > -1 && steps < static_cast<double>(count / step + 1))) return std::nullopt;
  const std::int64_t nearest =
      std::clamp(step * static_cast<std::int64_t>(std::round(steps)), std::int64_t{0}, count);
  return at(nearest) == coordinate ? std::optional(nearest) : std::nullopt;
}

TreeGrid::TreeGrid(const Box& box, int trees_x, int trees_y)
    : box_{box},
      trees_x_{trees_x},
      trees_y_{trees_y},
      tree_edge_{box.width() / trees_x},
      x_{make_axis(box.low.x, box.high.x, trees_x)},
      y_{make_axis(box.low.y, box.high.y, trees_y)} {}

int TreeGrid::finest_level(double min, const char* setting) const {
  int level = 1;
  while (level < deepest_level && edge(level + 1) >= min) ++level;
  const double largest =
      std::max({std::abs(box_.low.x), std::abs(box_.low.y), std::abs(box_.high.x), std::abs(box_.high.y)});
  const bool too_deep = edge(level + 1) >= min;
  const bool too_fine = edge(level) < largest * 0x1p-44;
  if (too_deep || too_fine) {
    std::ostringstream out;
    out << setting << " = " << min << " is too small for a root edge of " << tree_edge_
        << (too_deep ? " (more than 29 levels)" : " at these coordinates (double precision)")
        << "; make it larger";
    throw InputError(out.str());
  }
  return level;
}

TreeGrid choose_root(const Geometry& geometry, const std::optional<RootOptions>& wanted) {
  if (wanted) return users_root(geometry, *wanted);
  const Box& box = geometry.box();
  if (is_own_root(geometry)) {
    if (const auto trees = tiling(box)) return {box, trees->first, trees->second};
  }
  return padded_root(box);
}

}  // namespace quadloop
