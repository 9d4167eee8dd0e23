#include "mesher/layers/layer_strip.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/layers/wall_line.hpp"

namespace quadloop {

namespace {

constexpr double widening = 0.1;   // of columns, over the distance from an end
constexpr double opening = 1.15;   // of the layer at the line, from column to column
constexpr double spreading = 0.1;  // of all layers together, over the distance from a root
constexpr double flattest = 0.7;   // height of a row over the width of its columns, at most
constexpr double triangle_height = 0.85, steepest_front = 0.85;
constexpr double leaf_over_column = 1.2;

/// A polyline by its arc length.
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
  /// Of the chord from so far before to so far behind.
  Point direction(double s, double reach) const {
    return unit(at(std::min(s + reach, length())) - at(std::max(s - reach, 0.0)));
  }

 private:
  const std::vector<Point>& points_;
  std::vector<double> reached_;
};

class Strip {
 public:
  Strip(const PlacedLine& line, const std::optional<WakeRoot>& root)
      : line_{line}, path_{line.path}, thickness_{layers_thickness(line.layers)} {
    strip_.root = root;
    strip_.layers = line.layers.count;
    if (root) thickness_ = std::max(length(root->left - line.path[0]), length(root->right - line.path[0]));
  }

  LayerStrip built() && {
    place_columns();
    for (std::size_t k = 0; k < reached_.size(); ++k) strip_.columns.push_back(column(k));
    add_side(true);
    add_end();
    add_side(false);
    if (!strip_.root) add_beginning();
    return std::move(strip_);
  }

 private:
  int layers() const { return strip_.layers; }
  std::size_t last() const { return reached_.size() - 1; }

  /// Of all layers on one side.
  double thickness_at(double s) const {
    if (!strip_.root) return thickness_;
    const double widest = std::max(thickness_, flattest * layers() * line_.spacing);
    return std::min(thickness_ + spreading * s, widest);
  }
  double even_row(double s) const { return thickness_at(s) / layers(); }

  /// As wide as is wanted, at free ends as the rows are high.
  double width_wanted(double s) const {
    const double on = path_.length() - s, at_end = even_row(path_.length()) / flattest;
    const double at_beginning = strip_.root ? strip_.root->spacing : at_end;
    return std::min({line_.spacing, at_beginning + widening * s, at_end + widening * on});
  }

  void place_columns() {
    reached_ = {0};
    while (reached_.back() < path_.length())
      reached_.push_back(reached_.back() + width_wanted(reached_.back()));
    const double excess = reached_.back() / path_.length();
    for (double& s : reached_) s /= excess;
  }
  double width_at(std::size_t k) const {
    return k == last() ? reached_[k] - reached_[k - 1] : reached_[k + 1] - reached_[k];
  }

  /// Of the layer at the line: from that of the wall, and from that of even rows at a free end.
  double first_height(std::size_t k) const {
    const double even = even_row(reached_[k]);
    double from_root = line_.layers.first, from_end = even;
    const std::size_t to_end = strip_.root ? last() - k : std::min(k, last() - k);
    for (std::size_t i = 0; i < k && strip_.root && from_root < even; ++i) from_root *= opening;
    for (std::size_t i = 0; i < to_end && from_end > line_.layers.first; ++i) from_end /= opening;
    return std::min(std::max({from_root, from_end, line_.layers.first}), even);
  }

  Point direction(std::size_t k, bool left) const {
    const double s = reached_[k];
    const Point normal = left_of(path_.direction(s, width_at(k)));
    const Point out = left ? normal : -1.0 * normal;
    if (!strip_.root) return out;
    const double share = std::min(1.0, s / (2 * thickness_));
    const Point root = unit((left ? strip_.root->left : strip_.root->right) - line_.path[0]);
    return unit((1 - share) * root + share * out);
  }
  double thickness(std::size_t k, bool left) const {
    if (!strip_.root) return thickness_;
    const double root = length((left ? strip_.root->left : strip_.root->right) - line_.path[0]);
    return thickness_at(reached_[k]) -
           (thickness_ - root) * std::max(0.0, 1 - reached_[k] / (4 * thickness_));
  }

  std::vector<Point> column(std::size_t k) const {
    const Point foot = k == last() ? line_.path.back() : path_.at(reached_[k]);
    const auto side = [&](bool left) {
      const double whole = thickness(k, left);
      std::vector<Point> points;
      for (const double height : column_heights(line_.layers, first_height(k), whole).reached)
        points.push_back(foot + height * direction(k, left));
      return points;
    };
    const std::vector<Point> right = side(false), left = side(true);
    std::vector<Point> across(right.rbegin(), right.rend());
    across.insert(across.end(), left.begin() + 1, left.end());
    if (k == 0 && strip_.root) {  // to the last bit
      across.front() = strip_.root->right;
      across.back() = strip_.root->left;
    }
    return across;
  }

  /// Between the last row and the front.
  double gap(std::size_t k, bool left) const {
    const std::vector<Point>& across = strip_.columns[k];
    const double last_row =
        left ? length(across.back() - across[across.size() - 2]) : length(across[0] - across[1]);
    const double gap = std::min(triangle_height * width_at(k), 3 * last_row);
    return strip_.root ? std::min(gap, steepest_front * reached_[k]) : gap;
  }
  Point outside(std::size_t k, bool left) const {
    return (left ? strip_.columns[k].back() : strip_.columns[k].front()) + gap(k, left) * direction(k, left);
  }

  void add_front(Point p, double spacing) {
    strip_.front.push_back(p);
    strip_.spacing.push_back(spacing);
  }
  /// Onwards along the left, back along the right.
  void add_side(bool left) {
    const std::size_t first = strip_.root ? 1 : 0;
    const auto asked = [&](std::size_t k) { return leaf_over_column * width_at(k); };
    if (strip_.root && left) strip_.spacing.push_back(asked(0));
    for (std::size_t n = first; n <= last(); ++n) {
      const std::size_t k = left ? n : last() + first - n;
      add_front(outside(k, left), asked(left || k == 0 ? k : k - 1));
    }
  }
  void add_end() { add_cap(last(), path_.direction(path_.length(), width_at(last())), true, 0); }
  void add_beginning() { add_cap(0, -1.0 * path_.direction(0, width_at(0)), false, 2); }

  /// The two corners beyond a free end.
  void add_cap(std::size_t k, Point out, bool left_first, std::size_t corner) {
    const double row = length(strip_.columns[k].back() - strip_.columns[k].front()) / (2 * layers());
    const Point beyond = triangle_height * row * out;
    strip_.corners[corner] = strip_.front.size();
    add_front(outside(k, left_first) + beyond, leaf_over_column * row);
    strip_.corners[corner + 1] = strip_.front.size();
    add_front(outside(k, !left_first) + beyond, leaf_over_column * width_at(k));
  }

  const PlacedLine& line_;
  Path path_;
  double thickness_;
  std::vector<double> reached_;  ///< arc length to each column
  LayerStrip strip_;
};

}  // namespace

LayerStrip layer_strip(const PlacedLine& line, const std::optional<WakeRoot>& root) {
  return Strip(line, root).built();
}

}  // namespace quadloop
