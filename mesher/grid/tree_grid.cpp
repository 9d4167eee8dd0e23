#include "mesher/grid/tree_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

constexpr int most_trees = 16;     ///< along one side of the root
constexpr int deepest_level = 29;  ///< p4est's limit

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

/// The ratio, at least 1, of the size to meet and that of the leaves which it yields in trees of this edge.
double misfit(double tree_edge, const SizeOptions& sizes) {
  const double aim = sizes.aim.value_or(sizes.max), tolerance = 1 + TreeGrid::rounding;
  double reached = tree_edge / 2;
  while (reached > aim * tolerance && reached / 2 * tolerance >= sizes.min) reached /= 2;
  return std::max(reached / aim, aim / reached);
}

constexpr double acceptable = 1.1;  ///< misfit of a size that counts as met

/// A length divided into equal tree edges.
struct Division {
  int parts = 1;
  double misfit = std::numeric_limits<double>::infinity();
};

/// The number of parts, at least `least`, for which leaves meet the size best. More than necessary are used
/// for a better fit if they create no leaves that are finer than by `max`, or if the fit would be bad
/// without. `trees_in_all(parts)`: the number of trees in the root.
template <class TreesInAll>
Division best_division(double whole, int least, const SizeOptions& sizes, const TreesInAll& trees_in_all) {
  constexpr double good = 1 + 1.0 / 16;
  constexpr int most_parts = 32, most_in_all = 16384, most_fine = 1024;
  Division best;
  for (int parts = least; parts <= most_parts; ++parts) {
    const double edge = whole / parts;
    const bool is_coarse = edge >= sizes.max * (1 - TreeGrid::rounding);
    if (trees_in_all(parts) > (is_coarse ? most_in_all : most_fine)) break;
    const double found = misfit(edge, sizes);
    if (found >= best.misfit * (1 - TreeGrid::rounding) || (best.misfit <= good && !is_coarse)) continue;
    best = {parts, found};
  }
  return best;
}

/// The trees that tile the box and meet the size best.
std::optional<TreeGrid> framing_root(const Box& box, const SizeOptions& sizes) {
  const auto trees = tiling(box);
  if (!trees) return std::nullopt;
  const int nx = trees->first, ny = trees->second;
  const Division best = best_division(box.width() / nx, 1, sizes, [&](int m) { return m * m * nx * ny; });
  if (best.misfit > acceptable) return std::nullopt;
  return TreeGrid(box, best.parts * nx, best.parts * ny);
}

/// A range of coordinates divided into trees.
struct TreeRange {
  double low = 0, high = 0;
  int trees = 1;
};

/// The fewest trees of this edge that hold a range with this much room on either side; with the same centre.
TreeRange padded_range(double low, double high, double pad, double edge) {
  const int trees = static_cast<int>(std::ceil((high - low + 2 * pad) / edge));
  const double centre = 0.5 * (low + high), half = 0.5 * trees * edge;
  return {centre - half, centre + half, trees};
}

/// A root whose tree edge divides a translation along an axis, so that the grid is the same on both sides of
/// a pair. Where the box is as wide as the translation, so is the root.
std::optional<TreeGrid> periodic_root(const Box& box, Point period, const SizeOptions& sizes) {
  if ((period.x == 0) == (period.y == 0)) return std::nullopt;
  const bool along_x = period.x != 0;
  const double whole = std::abs(along_x ? period.x : period.y);
  const double pad = std::max(box.width(), box.height()) / 64;
  const double shorter = std::min(box.width(), box.height()) + 2 * pad;
  const auto range = [&](double edge, bool in_x) {
    const double low = in_x ? box.low.x : box.low.y, high = in_x ? box.high.x : box.high.y;
    const bool spans = in_x == along_x && std::abs(high - low - whole) <= TreeGrid::rounding * whole;
    return spans ? TreeRange{low, high, static_cast<int>(std::round(whole / edge))}
                 : padded_range(low, high, pad, edge);
  };
  const double least = std::floor(whole / (2 * shorter)) + 1;  // trees are not much larger than the box
  if (!(least <= most_trees)) return std::nullopt;
  const Division best = best_division(whole, static_cast<int>(least), sizes, [&](int parts) {
    return range(whole / parts, true).trees * range(whole / parts, false).trees;
  });
  if (best.misfit > acceptable) return std::nullopt;
  const TreeRange x = range(whole / best.parts, true), y = range(whole / best.parts, false);
  return TreeGrid({{x.low, y.low}, {x.high, y.high}}, x.trees, y.trees);
}

/// A root round the box, with the same centre, whose trees have the edge size * 2^k. It is less than twice as
/// large as the padded box, along each axis, unless that needs too many trees.
TreeGrid padded_root(const Box& box, double size) {
  const double pad = std::max(box.width(), box.height()) / 64;
  const double width = box.width() + 2 * pad, height = box.height() + 2 * pad;
  const double longer = std::max(width, height), shorter = std::min(width, height);
  double edge = size;
  while (edge < longer) edge *= 2;
  while (edge / 2 >= longer) edge /= 2;
  while (edge >= 2 * shorter && edge / 2 >= std::max(2 * size, longer / most_trees)) edge /= 2;
  const int nx = static_cast<int>(std::ceil(width / edge)), ny = static_cast<int>(std::ceil(height / edge));
  const Point half{0.5 * nx * edge, 0.5 * ny * edge};
  return {{box.centre() - half, box.centre() + half}, nx, ny};
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
  const int bits_of_count = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(axis.count - 1)));
  const double spare = std::ldexp(std::frexp(axis.unit, &exponent), 53 - bits_of_count);
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
  const auto allows = [&](int next) { return edge(next) * (1 + rounding) >= min; };
  while (level < deepest_level && allows(level + 1)) ++level;
  const double largest =
      std::max({std::abs(box_.low.x), std::abs(box_.low.y), std::abs(box_.high.x), std::abs(box_.high.y)});
  const bool too_deep = allows(level + 1);
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

TreeGrid choose_root(const Geometry& geometry, const SizeOptions& sizes) {
  if (sizes.root) return users_root(geometry, *sizes.root);
  if (is_own_root(geometry)) {
    if (const std::optional<TreeGrid> root = framing_root(geometry.box(), sizes)) return *root;
  }
  for (const Point period : sizes.periods) {
    if (const std::optional<TreeGrid> root = periodic_root(geometry.box(), period, sizes)) return *root;
  }
  return padded_root(geometry.box(), sizes.aim.value_or(sizes.max));
}

}  // namespace quadloop
