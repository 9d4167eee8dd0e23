#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A search tree of numbered boxes (of edges or cells): finds the boxes that meet a box, and the content
/// nearest to a point. Results and their order depend on the boxes only. O(log n + k) for k boxes found.
/// Coordinates must be finite.
class BoxTree {
 public:
  static constexpr std::int32_t none = -1;

  BoxTree() = default;
  /// Boxes have the numbers 0, 1, ... O(n log n).
  explicit BoxTree(std::span<const Box> boxes)
      : BoxTree(size32(boxes), [&](std::int32_t number) { return boxes[number]; }) {}
  /// `box_of(number)` is called once for each.
  template <class BoxOf>
  BoxTree(std::int32_t count, const BoxOf& box_of) {
    items_.reserve(count);
    for (std::int32_t number = 0; number < count; ++number) items_.push_back({box_of(number), number});
    if (count > 0) build(0, count);
  }

  bool empty() const { return items_.empty(); }

  /// Calls `found(number)` for boxes that meet this closed box until it returns true; returns whether it did.
  template <class Found>
  bool any_meeting(const Box& box, const Found& found) const;

  /// Calls `visit(number)` for every box that meets this closed box.
  template <class Visit>
  void for_each_meeting(const Box& box, const Visit& visit) const;

  /// The number with the smallest `squared_distance(number)` from p to the content of the box, the lowest of
  /// equal ones; `none` in an empty tree.
  template <class SquaredDistance>
  std::int32_t nearest(Point p, const SquaredDistance& squared_distance) const;

  /// Same for the boxes themselves; the distance inside a box is 0.
  std::int32_t nearest_box(Point p) const;

 private:
  struct Item {
    Box box;
    std::int32_t number = none;
  };
  /// Nodes in preorder: the first child of an inner node follows it, the second follows the last descendant
  /// of the first.
  struct Node {
    Box box;
    std::int32_t begin = 0, end = 0;  ///< its items
    std::int32_t after = 0;           ///< the node after its descendants
    bool leaf(std::int32_t self) const { return after == self + 1; }
  };
  struct Candidate {
    double squared_distance = std::numeric_limits<double>::infinity();
    std::int32_t number = none;
  };
  /// Allows for rounding of a box's distance: boxes farther by this factor are still searched.
  static constexpr double slack = 1 + 1e-12;

  static double squared_distance_to(const Box& box, Point p);
  void build(std::int32_t begin, std::int32_t end);
  const Node& node(std::int32_t n) const { return nodes_[n]; }
  std::span<const Item> items_of(const Node& leaf) const {
    return std::span(items_).subspan(leaf.begin, leaf.end - leaf.begin);
  }
  template <class DistanceOfItem>
  void search(std::int32_t n, Point p, const DistanceOfItem& distance_of, Candidate& best) const;

  std::vector<Item> items_;
  std::vector<Node> nodes_;
};

template <class Found>
bool BoxTree::any_meeting(const Box& box, const Found& found) const {
  const auto count = size32(nodes_);
  for (std::int32_t n = 0; n < count;) {
    const Node& here = node(n);
    if (!here.box.meets(box)) {
      n = here.after;
      continue;
    }
    if (here.leaf(n)) {
      for (const Item& item : items_of(here)) {
        if (item.box.meets(box) && found(item.number)) return true;
      }
    }
    ++n;
  }
  return false;
}

template <class Visit>
void BoxTree::for_each_meeting(const Box& box, const Visit& visit) const {
  any_meeting(box, [&](std::int32_t number) {
    visit(number);
    return false;
  });
}

template <class DistanceOfItem>
void BoxTree::search(std::int32_t n, Point p, const DistanceOfItem& distance_of, Candidate& best) const {
  const Node& here = node(n);
  if (squared_distance_to(here.box, p) > slack * best.squared_distance) return;
  if (here.leaf(n)) {
    for (const Item& item : items_of(here)) {
      if (squared_distance_to(item.box, p) > slack * best.squared_distance) continue;
      const double distance = distance_of(item);
      if (distance > best.squared_distance ||
          (distance == best.squared_distance && best.number != none && item.number > best.number))
        continue;
      best = {distance, item.number};
    }
    return;
  }
  std::int32_t first = n + 1, second = node(first).after;
  if (squared_distance_to(node(second).box, p) < squared_distance_to(node(first).box, p))
    std::swap(first, second);
  search(first, p, distance_of, best);
  search(second, p, distance_of, best);
}

template <class SquaredDistance>
std::int32_t BoxTree::nearest(Point p, const SquaredDistance& squared_distance) const {
  Candidate best;
  if (!empty())
    search(
        0, p, [&](const Item& item) { return squared_distance(item.number); }, best);
  return best.number;
}

}  // namespace quadloop
