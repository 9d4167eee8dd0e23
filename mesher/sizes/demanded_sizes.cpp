#include "mesher/sizes/demanded_sizes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace quadloop {

namespace {

/// A segment, described alike from either end.
class Span {
 public:
  Span(Point a, Point b) : middle_{0.5 * (a + b)}, half_{0.5 * (b - a)}, ends_{a, b} {}

  double distance(const Box& box) const {
    if (meets(box)) return 0;
    double least = std::min(distance(box, ends_[0]), distance(box, ends_[1]));
    for (const Point corner : {box.low, Point{box.high.x, box.low.y}, box.high, Point{box.low.x, box.high.y}})
      least = std::min(least, distance(corner));
    return least;
  }

 private:
  /// By the axes of the box and the normal of the segment, one of which separates them otherwise.
  bool meets(const Box& box) const {
    const Point centre = box.centre(), apart = middle_ - centre;
    const double x = 0.5 * box.width(), y = 0.5 * box.height();
    return std::abs(apart.x) <= std::abs(half_.x) + x && std::abs(apart.y) <= std::abs(half_.y) + y &&
           std::abs(cross(half_, apart)) <= x * std::abs(half_.y) + y * std::abs(half_.x);
  }
  double distance(Point p) const {
    const double whole = dot(half_, half_);
    const double share = whole > 0 ? std::clamp(dot(p - middle_, half_) / whole, -1.0, 1.0) : 0;
    return length((p - middle_) - share * half_);
  }
  static double distance(const Box& box, Point p) {
    return length({std::max({box.low.x - p.x, p.x - box.high.x, 0.0}),
                   std::max({box.low.y - p.y, p.y - box.high.y, 0.0})});
  }

  Point middle_, half_;
  std::array<Point, 2> ends_;
};

class Search {
 public:
  Search(const TreeGrid& grid, const DemandedSplits& demanded, double growth, const Span& span, double most)
      : grid_{grid}, demanded_{demanded}, growth_{growth}, span_{span}, least_{most} {}

  void look_in(const Quadrant& q, std::int32_t number) {
    if (size_at(demanded_.finest_level_in(number), distance(q)) >= least_) return;
    struct Child {
      double distance;
      Quadrant quadrant;
      std::int32_t number;
    };
    std::array<Child, 4> children{};
    for (std::size_t k = 0; k < children.size(); ++k) {
      const Quadrant child = q.child(corners_along_curve[k]);
      children[k] = {distance(child), child, demanded_.child(number, corners_along_curve[k])};
    }
    std::ranges::stable_sort(children, {}, &Child::distance);
    for (const Child& child : children) {
      if (child.number == DemandedSplits::none)
        least_ = std::min(least_, size_at(child.quadrant.level, child.distance));
      else
        look_in(child.quadrant, child.number);
    }
  }
  double found() const { return least_; }

 private:
  double size_at(int level, double distance) const { return grid_.edge(level) + growth_ * distance; }
  double distance(const Quadrant& q) const { return span_.distance(grid_.box_of(q)); }

  const TreeGrid& grid_;
  const DemandedSplits& demanded_;
  double growth_;
  const Span& span_;
  double least_;
};

}  // namespace

DemandedSizes::DemandedSizes(const TreeGrid& grid, const DemandedSplits& demanded, double gradation)
    : grid_{grid}, demanded_{demanded}, growth_{(gradation - 1) / 2} {
  for (std::int64_t y = 0; y < grid.trees_y() && !demanded.empty(); ++y) {
    for (std::int64_t x = 0; x < grid.trees_x(); ++x) {
      const std::int32_t number = demanded.root(x, y);
      if (number == DemandedSplits::none) continue;
      trees_.push_back({{x << Quadrant::unit_level, y << Quadrant::unit_level, 0}, number});
    }
  }
}

double DemandedSizes::near(Point a, Point b, double most) const {
  const Span span(a, b);
  Search search(grid_, demanded_, growth_, span, most);
  for (const Tree& tree : trees_) search.look_in(tree.quadrant, tree.number);
  return search.found();
}

}  // namespace quadloop
