#include "mesher/geometry/assemble/half_edges.hpp"

#include <algorithm>
#include <numeric>

#include "mesher/base/ids.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

constexpr std::int32_t no_half_edge = -1;

}  // namespace

std::int32_t HalfEdges::add(Point a, Point b) {
  const std::int32_t from = vertex(a), to = vertex(b);
  const auto [found, is_new] =
      half_edge_.try_emplace({std::min(from, to), std::max(from, to)}, size32(head_));
  if (is_new) head_.insert(head_.end(), {std::max(from, to), std::min(from, to)});
  return found->second + (from < to ? 0 : 1);
}

void HalfEdges::link() {
  sort_round_vertices();
  find_outermost();
  number_walks();
}

std::int32_t HalfEdges::vertex(Point p) {
  const auto [found, is_new] = vertices_.try_emplace(p, size32(points_));
  if (is_new) points_.push_back(p);
  return found->second;
}

/// Order by tails, then counter-clockwise from straight down.
bool HalfEdges::comes_before(std::int32_t g, std::int32_t h) const {
  const auto is_right = [&](std::int32_t e) { return points_[tail(e)] < points_[head_[e]]; };
  if (tail(g) != tail(h)) return tail(g) < tail(h);
  if (is_right(g) != is_right(h)) return is_right(g);
  return orientation(points_[tail(g)], points_[head_[g]], points_[head_[h]]) > 0;
}

void HalfEdges::sort_round_vertices() {
  std::vector<std::int32_t> order(head_.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, [&](std::int32_t g, std::int32_t h) { return comes_before(g, h); });
  after_.assign(head_.size(), no_half_edge);
  before_.assign(head_.size(), no_half_edge);
  last_of_.assign(points_.size(), no_half_edge);
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first;
    while (end < order.size() && tail(order[end]) == tail(order[first])) ++end;
    for (std::size_t i = first; i < end; ++i) {
      const std::int32_t following = order[i + 1 < end ? i + 1 : first];
      after_[order[i]] = following;
      before_[following] = order[i];
    }
    last_of_[tail(order[first])] = order[end - 1];
    first = end;
  }
}

/// Nothing of a part is left of its leftmost vertex: the face behind the last half-edge there is outside.
void HalfEdges::find_outermost() {
  std::vector<std::int32_t> part(points_.size());
  std::iota(part.begin(), part.end(), 0);
  const auto part_of = [&](std::int32_t v) {
    while (part[v] != v) v = part[v] = part[part[v]];
    return v;
  };
  for (std::int32_t h = 0; h < size(); h += 2) part[part_of(tail(h))] = part_of(head(h));
  std::vector<std::int32_t> leftmost(points_.size(), no_half_edge), parts;
  for (std::int32_t v = 0; v < vertices(); ++v) {
    std::int32_t& left = leftmost[part_of(v)];
    if (left == no_half_edge) parts.push_back(part_of(v));
    if (left == no_half_edge || points_[v] < points_[left]) left = v;
  }
  for (const std::int32_t p : parts) outermost_.push_back(last_of_[leftmost[p]]);
}

void HalfEdges::number_walks() {
  walk_.assign(head_.size(), no_half_edge);
  for (std::int32_t h = 0; h < size(); ++h) {
    if (walk_[h] != no_half_edge) continue;
    for (std::int32_t along = h; walk_[along] == no_half_edge; along = before_[along ^ 1])
      walk_[along] = walks_;
    ++walks_;
  }
}

}  // namespace quadloop
