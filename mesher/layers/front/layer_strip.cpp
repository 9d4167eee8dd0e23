#include "mesher/layers/front/layer_strip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/layers/front/wall_line.hpp"

namespace quadloop {

namespace {

constexpr double widening = 0.1;         // of columns, per distance from an end
constexpr double opening = 1.15;         // factor per column of the first layer at the line
constexpr double spreading = 0.1;        // of all layers together, per distance from a root
constexpr double thinnest = 0.2;         // of the layers at the root, wherever there is room for a wake
constexpr double core_spreading = 0.05;  // of half the rows behind a base, per distance
constexpr double flattest = 0.7;         // largest height of a row over the width of its columns
constexpr double triangle_height = 0.85, steepest_front = 0.85;
constexpr double most_rows_of_triangle = 3, flattest_triangle = 0.35;
constexpr double leaf_over_column = 1.2;           // at most; leaves are rounded down to half of that
constexpr double adapted_leaf_over_column = 0.85;  // the geometric mean of both limits
constexpr double flattest_at_end = 0.5, leaf_over_end_row = 2, triangle_over_end_row = 1.4;

/// A polyline parametrised by arc length.
class Path {
 public:
  explicit Path(const std::vector<Point>& points) : points_{points}, reached_{0} {
    for (std::size_t i = 1; i < points.size(); ++i)
      reached_.push_back(reached_.back() + quadloop::length(points[i] - points[i - 1]));
  }
  double length() const { return reached_.back(); }
  Point at(double s) const {
    const auto after = std::upper_bound(reached_.begin() + 1, reached_.end() - 1, s);
    const auto i = static_cast<std::size_t>(after - reached_.begin());
    const double share = (s - reached_[i - 1]) / (reached_[i] - reached_[i - 1]);
    return points_[i - 1] + share * (points_[i] - points_[i - 1]);
  }
  /// Direction of the chord from `reach` before s to `reach` after it.
  Point direction(double s, double reach) const {
    return unit(at(std::min(s + reach, length())) - at(std::max(s - reach, 0.0)));
  }

 private:
  const std::vector<Point>& points_;
  std::vector<double> reached_;
};

/// The base of a blunt edge with layers on it. The layers begin at its two feet, like the rows behind it.
class Base {
 public:
  Base(const PlacedLine& line, const std::vector<Point>& points, int rows)
      : points_{points}, turned_{points.rbegin(), points.rend()}, rows_{rows} {
    LayerSpec half = line.layers;
    half.count = rows;
    heights_ = column_heights(half, half.first, 0.5 * path_.length()).reached;
    normal_ = left_of(unit(points_.back() - points_.front()));
  }
  Base(const Base&) = delete;
  Base& operator=(const Base&) = delete;

  /// Height of this number of layers; `half`: height of all layers, half the length of the base.
  double height(int layers) const { return heights_[layers]; }
  double half() const { return heights_.back(); }

  /// The line above `layers` of `all` layers, from right to left.
  std::vector<Point> line(int layers, int all) const {
    const double stretch = (half() - heights_[layers]) / (half() - heights_[all]);
    const auto from_foot = [&](int row) { return half() - stretch * (half() - heights_[row]); };
    std::vector<Point> right, left;
    for (int row = all; row < rows_; ++row) {
      right.push_back(at(false, from_foot(row), layers));
      left.push_back(at(true, from_foot(row), layers));
    }
    right.push_back(0.5 * (at(false, half(), layers) + at(true, half(), layers)));
    right.insert(right.end(), left.rbegin(), left.rend());
    return right;
  }
  /// The node at which the line above this number of layers turns into the wake.
  Point corner(bool left, int layers) const { return at(left, heights_[layers], layers); }

 private:
  /// The point at a distance along the base from one of its feet, above this number of layers; heights are
  /// normal to the base.
  Point at(bool left, double from_foot, int layers) const {
    constexpr double least_cosine = 0.5, reach_over_base = 1.0 / 16;
    const Path& path = left ? path_ : turned_path_;
    const Point along = path.direction(from_foot, reach_over_base * path.length());
    const double cosine = dot(normal_, left_of(left ? along : -1.0 * along));
    return path.at(from_foot) + (heights_[layers] / std::max(cosine, least_cosine)) * normal_;
  }

  std::vector<Point> points_, turned_;  ///< from the left foot to the right one, and reversed
  Path path_{points_}, turned_path_{turned_};
  int rows_;
  std::vector<double> heights_;
  Point normal_;
};

/// Whether the cells between two lines are positive, where the first line is to the left of the second.
bool is_positive(std::span<const Point> first, std::span<const Point> second) {
  for (std::size_t i = 0; i + 1 < first.size(); ++i) {
    const std::array cell{first[i], second[i], second[i + 1], first[i + 1]};
    for (std::size_t c = 0; c < cell.size(); ++c) {
      if (orientation(cell[c], cell[(c + 1) % 4], cell[(c + 2) % 4]) <= 0) return false;
    }
  }
  return true;
}

/// The largest widths of a line's columns, and the largest thicknesses of its layers, beside adapted cells
/// and near what the line keeps clear of, as functions of the arc length.
class Limits {
 public:
  Limits() = default;
  /// `reach(s)`: distance of the front from the line without limits.
  template <class Reach>
  Limits(const Path& path, const AdaptedSize& adapted, const FreeDistance& free, double spacing,
         const Reach& reach) {
    constexpr double step = 0.25;  // of the size, so that no leaf is passed over
    constexpr double least_step = 1.0 / 64;
    if (!adapted && !free) return;
    const double whole = path.length(), most = adapted_leaf_over_column * spacing;
    for (double s = 0;;) {
      const Point across = reach(s) * left_of(path.direction(s, 0.5 * spacing));
      const double size = adapted ? adapted(path.at(s) + across, path.at(s) - across, most) : most;
      const double room = free ? free(path.at(s)) : infinity;
      s_.push_back(s);
      room_.push_back(room);
      width_.push_back(
          std::min(size < most ? size / adapted_leaf_over_column : infinity, width_over_room * room));
      if (s == whole) break;
      s = std::min(whole, s + std::min(step * size, std::max(least_step * spacing, step * room)));
    }
    limit(width_, widening, widening);
  }

  /// Infinity without limits.
  double width_at(double s) const { return at(s, width_, widening, widening); }
  /// As `thickness`, but at most `rows` times the width where that is above `least`, and as the room allows:
  /// there also thinner, by a third of the distance from a root with `least`; behind narrow places they
  /// thicken as slowly as elsewhere. `half_base`: of the rows between the layers.
  void limit_thickness(double least, double rows, double half_base) {
    for (std::size_t i = 0; i < s_.size(); ++i) {
      thickness_.push_back(std::max(least, rows * width_[i]));
      in_room_.push_back(std::max(
          {layers_in_room(room_[i], half_base), least - steepest_thickness * s_[i], thinnest * least}));
    }
    limit(thickness_, spreading, spreading);
    limit(in_room_, spreading, steepest_thickness);
  }
  double thickness_at(double s) const {
    return std::min(at(s, thickness_, spreading, spreading), at(s, in_room_, spreading, steepest_thickness));
  }
  /// Of half the rows behind a base: its largest height.
  double core_at(double s) const { return core_over_layers * at(s, in_room_, spreading, steepest_thickness); }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// Limits each value to the growth `up` from those before it, and to the growth `down` from those behind.
  void limit(std::vector<double>& values, double up, double down) const {
    for (std::size_t i = 1; i < values.size(); ++i)
      values[i] = std::min(values[i], values[i - 1] + up * (s_[i] - s_[i - 1]));
    for (std::size_t i = values.size(); i-- > 1;)
      values[i - 1] = std::min(values[i - 1], values[i] + down * (s_[i] - s_[i - 1]));
  }
  double at(double s, const std::vector<double>& values, double up, double down) const {
    if (values.empty()) return infinity;
    const auto after = std::upper_bound(s_.begin() + 1, s_.end() - 1, s);
    const auto i = static_cast<std::size_t>(after - s_.begin());
    return std::min(values[i - 1] + up * (s - s_[i - 1]), values[i] + down * (s_[i] - s));
  }

  std::vector<double> s_, width_, room_, thickness_, in_room_;
};

class Strip {
 public:
  Strip(const PlacedLine& line, const std::optional<WakeRoot>& root, const AdaptedSize& adapted,
        const FreeDistance& free)
      : line_{line}, path_{line.path}, thickness_{layers_thickness(line.layers)} {
    strip_.name = line.name;
    strip_.place = line.place;
    strip_.turn_degrees = line.turn_degrees;
    strip_.shortened = line.shortened;
    strip_.spec = line.layers;
    strip_.asked = thickness_;
    strip_.root = root;
    strip_.layers = line.layers.count;
    if (root) thickness_ = std::max(length(root->left - foot(true)), length(root->right - foot(false)));
    if (root && !root->base.empty()) half_base_ = 0.5 * length(root->base.front() - root->base.back());
    Limits limits(path_, adapted, free, line.spacing,
                  [&](double s) { return half_base_ + thickness_at(s) + triangle_height * width_wanted(s); });
    limits.limit_thickness(thickness_, flattest * layers(), half_base_);
    limits_ = std::move(limits);
    if (half_base_ == 0) return;
    constexpr int most_rows = 1000;
    strip_.core = 2 * layers_within(line.layers, half_base_, most_rows);
    base_.emplace(line, root->base, strip_.core / 2);
  }

  LayerStrip built() && {
    if (strip_.core > 0) base_layers_ = most_base_layers();
    place_columns();
    for (std::size_t k = 0; k < reached_.size(); ++k) strip_.columns.push_back(column(k));
    if (strip_.core > 0) lay_base();
    add_side(true);
    add_end();
    add_side(false);
    if (!strip_.root) add_beginning();
    if (line_.across) reflect(*line_.across);
    return std::move(strip_);
  }

 private:
  int layers() const { return strip_.layers; }
  std::size_t last() const { return reached_.size() - 1; }

  /// Thickness of all layers on one side.
  double thickness_at(double s) const {
    if (!strip_.root) return thickness_;
    const double widest = std::max(thickness_, flattest * layers() * line_.spacing);
    return std::min({thickness_ + spreading * s, widest, limits_.thickness_at(s)});
  }
  double even_row(double s) const { return thickness_at(s) / layers(); }

  /// Requested width, limited at free ends by the height of the rows.
  double width_wanted(double s) const {
    const double on = path_.length() - s, at_end = even_row(path_.length()) / flattest_at_end;
    const double at_beginning = strip_.root ? width_at_root() : at_end;
    return std::min(
        {line_.spacing, at_beginning + widening * s, at_end + widening * on, limits_.width_at(s)});
  }

  /// Width of the first columns; behind the layers of a base smaller, so that sizes grow from these.
  double width_at_root() const {
    constexpr double over_last_layer = 3, narrowest = 0.25;
    const double wanted = strip_.root->spacing;
    if (base_layers_ == 0) return wanted;
    const double last = base_->height(base_layers_) - base_->height(base_layers_ - 1);
    return std::min(wanted,
                    std::max(base_->height(base_layers_) + over_last_layer * last, narrowest * wanted));
  }
  /// Upper limit of the layers on the base: at most those of the wall, leaving part of the base to the rows
  /// behind it and space before the next column.
  int most_base_layers() const {
    constexpr double share_of_half = 0.6;
    const double room = std::min({strip_.root->spacing, line_.spacing, limits_.width_at(0)});
    int layers = 0;
    while (layers < strip_.layers && layers + 1 < strip_.core / 2 &&
           base_->height(layers + 1) <= share_of_half * base_->half() &&
           2 * base_->height(layers + 1) - base_->height(layers) <= room)
      ++layers;
    return layers;
  }

  /// Of a line across an axis as many on either side, and one on the axis.
  void place_columns() {
    const double end = line_.across ? 0.5 * path_.length() : path_.length();
    reached_ = {0};
    while (reached_.back() < end) reached_.push_back(reached_.back() + width_wanted(reached_.back()));
    const double excess = reached_.back() / end;
    for (double& s : reached_) s /= excess;
    if (!line_.across) return;
    for (std::size_t k = last(); k > 0; --k) reached_.push_back(path_.length() - reached_[k - 1]);
  }
  double width_at(std::size_t k) const {
    return k == last() ? reached_[k] - reached_[k - 1] : reached_[k + 1] - reached_[k];
  }

  /// Height of the layer at the line, growing from that of the wall, and from that of even rows at a free
  /// end.
  double first_height(std::size_t k) const {
    const double even = even_row(reached_[k]);
    double from_root = line_.layers.first, from_end = even;
    const std::size_t to_end = strip_.root ? last() - k : std::min(k, last() - k);
    for (std::size_t i = 0; i < k && strip_.root && from_root < even; ++i) from_root *= opening;
    for (std::size_t i = 0; i < to_end && from_end > line_.layers.first; ++i) from_end /= opening;
    return std::min(std::max({from_root, from_end, line_.layers.first}), even);
  }

  /// Direction of the line. Bends are rounded over the layers' thickness, so that columns on their inner side
  /// do not cross.
  Point along(std::size_t k) const {
    const double core = strip_.core > 0 ? half_core(k) : 0;
    return path_.direction(reached_[k], std::max(width_at(k), core + thickness_at(reached_[k])));
  }
  Point direction(std::size_t k, bool left) const {
    const double s = reached_[k];
    const Point normal = left_of(along(k));
    const Point out = left ? normal : -1.0 * normal;
    if (!strip_.root) return out;
    const double share = std::min(1.0, s / (2 * thickness_));
    return unit((1 - share) * unit(root_end(left) - foot(left)) + share * out);
  }
  Point root_end(bool left) const { return left ? strip_.root->left : strip_.root->right; }
  /// The foot of the wall's column at the root.
  Point foot(bool left) const {
    const std::vector<Point>& base = strip_.root->base;
    return base.empty() ? line_.path[0] : left ? base.front() : base.back();
  }
  double thickness(std::size_t k, bool left) const {
    if (!strip_.root) return thickness_;
    const double root = length(root_end(left) - foot(left));
    return thickness_at(reached_[k]) -
           (thickness_ - root) * std::max(0.0, 1 - reached_[k] / (4 * thickness_));
  }

  std::vector<Point> column(std::size_t k) const {
    std::vector<Point> across = side(k, false);
    std::ranges::reverse(across);
    const std::vector<Point> left = side(k, true);
    const std::vector<Point> core = k == 0 ? core_at_base() : core_rows(k, across.back(), left.front());
    across.insert(across.end(), core.begin(), core.end());
    across.insert(across.end(), left.begin() + (strip_.core == 0 ? 1 : 0), left.end());
    if (k == 0 && strip_.root) {  // exactly the wall's columns
      across.front() = strip_.root->right;
      across.back() = strip_.root->left;
    }
    return across;
  }
  /// The points of one side, from the line outwards; behind a base from its rows outwards.
  std::vector<Point> side(std::size_t k, bool left) const {
    const Point on_line = k == last() ? line_.path.back() : path_.at(reached_[k]);
    Point from = on_line;
    if (strip_.core > 0) {
      const double share = std::min(1.0, reached_[k] / (4 * half_base_));
      const Point aside =
          (1 - share) * (foot(left) - line_.path[0]) + share * half_base_ * direction(k, left);
      from = k == 0 ? foot(left) : on_line + (half_core(k) / half_base_) * aside;
    }
    const double whole = thickness(k, left);
    std::vector<Point> points;
    for (const double height : column_heights(line_.layers, first_height(k), whole).reached)
      points.push_back(from + height * direction(k, left));
    return points;
  }
  /// The rows behind a base thicken at the rate of the layers beside them.
  double half_core(std::size_t k) const {
    const double open = 0.5 * strip_.core * first_height(k),
                 widest = half_base_ + core_spreading * reached_[k];
    return std::max(half_base_, std::min({open, widest, limits_.core_at(reached_[k])}));
  }
  /// The points between the feet, without these: around the layers on the base.
  std::vector<Point> core_at_base() const {
    if (strip_.core == 0) return {};
    std::vector<Point> rows;
    for (int row = 1; row < base_layers_; ++row) rows.push_back(base_->corner(false, row));
    const std::vector<Point> line = base_->line(base_layers_, base_layers_);
    const bool with_ends = base_layers_ > 0;
    rows.insert(rows.end(), line.begin() + (with_ends ? 0 : 1), line.end() - (with_ends ? 0 : 1));
    for (int row = base_layers_ - 1; row > 0; --row) rows.push_back(base_->corner(true, row));
    return rows;
  }
  /// Adds the layers on the base, fewer if their cells would not be positive.
  void lay_base() {
    for (; base_layers_ > 0; --base_layers_) {
      strip_.columns[0] = column(0);
      strip_.base_lines.clear();
      for (int layer = 0; layer < base_layers_; ++layer)
        strip_.base_lines.push_back(base_->line(layer, base_layers_));
      if (base_is_positive()) return;
    }
    strip_.base_lines.clear();
    strip_.columns[0] = column(0);
  }
  bool base_is_positive() const {
    const auto rows = [&](std::size_t k, int from_foot) {
      return std::span(strip_.columns[k]).subspan(layers() + from_foot, strip_.core + 1 - 2 * from_foot);
    };
    if (!is_positive(rows(0, 0), rows(1, 0))) return false;
    for (int layer = 1; layer < base_layers_; ++layer) {
      if (!is_positive(strip_.base_lines[layer - 1], strip_.base_lines[layer])) return false;
    }
    return is_positive(strip_.base_lines.back(), rows(0, base_layers_));
  }
  /// The points of the rows behind the base: at the sides as high as the adjacent layers, growing towards the
  /// middle.
  std::vector<Point> core_rows(std::size_t k, Point right, Point left) const {
    if (strip_.core == 0) return {};
    LayerSpec half = line_.layers;
    half.count = strip_.core / 2;
    const double width = length(left - right);
    const std::vector<double> heights = column_heights(half, first_height(k), 0.5 * width).reached;
    const auto at = [&](double share, bool from_left) {  // fraction of the width
      return from_left ? left + share * (right - left) : right + share * (left - right);
    };
    std::vector<Point> rows;
    for (int row = 1; row <= half.count; ++row) rows.push_back(at(heights[row] / width, false));
    for (int row = half.count - 1; row > 0; --row) rows.push_back(at(heights[row] / width, true));
    return rows;
  }

  /// Distance between the last row and the front.
  double gap(std::size_t k, bool left) const {
    const std::vector<Point>& across = strip_.columns[k];
    const double last_row =
        left ? length(across.back() - across[across.size() - 2]) : length(across[0] - across[1]);
    const double gap = std::min(triangle_height * width_at(k),
                                std::max(most_rows_of_triangle * last_row, flattest_triangle * width_at(k)));
    return strip_.root ? std::min(gap, steepest_front * reached_[k]) : gap;
  }
  Point outside(std::size_t k, bool left) const {
    return (left ? strip_.columns[k].back() : strip_.columns[k].front()) + gap(k, left) * direction(k, left);
  }

  void add_front(Point p, double spacing) {
    strip_.front.push_back(p);
    strip_.spacing.push_back(spacing);
  }
  /// Adds one side of the front: downstream on the left, back on the right.
  void add_side(bool left) {
    const std::size_t first = strip_.root ? 1 : 0;
    const auto asked = [&](std::size_t k) { return leaf_over_column * width_at(k); };
    if (strip_.root && left) strip_.spacing.push_back(asked(0));
    for (std::size_t n = first; n <= last(); ++n) {
      const std::size_t k = left ? n : last() + first - n;
      add_front(outside(k, left), asked(left || k == 0 ? k : k - 1));
    }
  }
  void add_end() { add_cap(last(), along(last()), true, 0); }
  void add_beginning() { add_cap(0, -1.0 * along(0), false, 2); }

  /// Adds the two corners beyond a free end.
  void add_cap(std::size_t k, Point out, bool left_first, std::size_t corner) {
    const double row =
        length(strip_.columns[k].back() - strip_.columns[k].front()) / (2 * layers() + strip_.core);
    const Point beyond = triangle_over_end_row * row * out;
    strip_.corners[corner] = strip_.front.size();
    add_front(outside(k, left_first) + beyond, leaf_over_end_row * row);
    strip_.corners[corner + 1] = strip_.front.size();
    add_front(outside(k, !left_first) + beyond, leaf_over_column * width_at(k));
  }

  /// The first half becomes the image of the second one.
  void reflect(MirrorAxis axis) {
    strip_.across = axis;
    const std::size_t middle = last() / 2, points = strip_.front.size();
    for (std::size_t k = 0; k < middle; ++k) {
      strip_.columns[k].clear();
      for (const Point p : strip_.columns[last() - k]) strip_.columns[k].push_back(image_of(axis, p));
    }
    for (Point& p : strip_.columns[middle]) p = foot_on(axis, p);
    const std::size_t left = middle, right = points - 3 - middle;  // of the front, on the axis
    for (const std::size_t i : {left, right}) strip_.front[i] = foot_on(axis, strip_.front[i]);
    for (std::size_t i = left + 1; i <= right; ++i) {
      const std::size_t image = (last() + points - i) % points;
      strip_.front[image] = image_of(axis, strip_.front[i]);
      strip_.spacing[image] = strip_.spacing[i - 1];
    }
  }

  const PlacedLine& line_;
  Path path_;
  Limits limits_;
  double thickness_, half_base_ = 0;
  std::optional<Base> base_;
  int base_layers_ = 0;
  std::vector<double> reached_;  ///< arc length at each column
  LayerStrip strip_;
};

}  // namespace

StripSize least_size(const PlacedLine& line) {
  const double columns = std::ceil(Path(line.path).length() / line.spacing);  // columns are at most this wide
  return {columns, columns * 2 * line.layers.count};
}

LayerStrip layer_strip(const PlacedLine& line, const std::optional<WakeRoot>& root,
                       const AdaptedSize& adapted, const FreeDistance& free) {
  LayerStrip strip = Strip(line, root, adapted, free).built();
  const auto is_finite = [](Point p) { return std::isfinite(p.x) && std::isfinite(p.y); };
  if (std::ranges::all_of(strip.front, is_finite)) return strip;
  throw InputError(
      fmt::format("{}{} returns to its first point ({:.6g}, {:.6g}) within the thickness of its layers, "
                  "{:.3g}; change its path, "
                  "or make the layers thinner",
                  line.place, line.name, line.path[0].x, line.path[0].y, strip.asked));
}

}  // namespace quadloop
