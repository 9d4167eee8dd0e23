#include "mesher/geometry/box_tree.hpp"

#include "mesher/base/ids.hpp"

namespace quadloop {

namespace {

constexpr std::int32_t leaf_items = 8;

}  // namespace

/// Halves the items along the longer side of their box until few are left.
void BoxTree::build(std::int32_t begin, std::int32_t end) {
  Box box;
  for (const Item& item : std::span(items_.begin() + begin, items_.begin() + end)) {
    box.include(item.box);
  }
  const std::size_t self = nodes_.size();
  nodes_.push_back({box, begin, end, 0});
  if (end - begin > leaf_items) {
    const std::int32_t middle = begin + (end - begin) / 2;
    const auto halve = [&](const auto& place) {  // equal ones by number, so that the halves are unique
      std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end,
                       [&](const Item& a, const Item& b) {
                         const double at_a = place(a.box), at_b = place(b.box);
                         return at_a != at_b ? at_a < at_b : a.number < b.number;
                       });
    };
    if (box.width() > box.height()) {
      halve([](const Box& b) { return b.low.x + b.high.x; });
    } else {
      halve([](const Box& b) { return b.low.y + b.high.y; });
    }
    build(begin, middle);
    build(middle, end);
  } else {
    std::sort(items_.begin() + begin, items_.begin() + end,
              [](const Item& a, const Item& b) { return a.number < b.number; });
  }
  nodes_[self].after = size32(nodes_);
}

double BoxTree::squared_distance_to(const Box& box, Point p) {
  const Point off{std::max({0.0, box.low.x - p.x, p.x - box.high.x}),
                  std::max({0.0, box.low.y - p.y, p.y - box.high.y})};
  return dot(off, off);
}

std::int32_t BoxTree::nearest_box(Point p) const {
  Candidate best;
  if (!empty())
    search(
        0, p, [&](const Item& item) { return squared_distance_to(item.box, p); }, best);
  return best.number;
}

}  // namespace quadloop
