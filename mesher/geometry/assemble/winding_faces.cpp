#include "mesher/geometry/assemble/winding_faces.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

constexpr std::int32_t none = -1;

/// The graph as half-edges: 2 e and 2 e + 1 are the two directions of edge e.
class HalfEdges {
 public:
  HalfEdges(const std::vector<WindingEdge>& edges, int outside) {
    for (const WindingEdge& edge : edges) add(edge);
    sort_round_vertices();
    number_faces();
    wind(outside);
  }

  std::int32_t size() const { return size32(head_); }
  Point point(std::int32_t vertex) const { return points_[vertex]; }
  std::int32_t tail(std::int32_t h) const { return head_[h ^ 1]; }
  std::int32_t head(std::int32_t h) const { return head_[h]; }
  std::int32_t origin(std::int32_t h) const { return origin_[h]; }

  /// Whether the domain is to its left and not to its right.
  bool bounds_domain(std::int32_t h) const { return winding_[face_[h]] > 0 && winding_[face_[h ^ 1]] <= 0; }

  /// The next half-edge that bounds the domain, counter-clockwise from the reverse of h, so that there is no
  /// domain between the two.
  std::int32_t next_bound(std::int32_t h) const {
    std::int32_t turned = after_[h ^ 1];
    while (!bounds_domain(turned)) turned = after_[turned];
    return turned;
  }

 private:
  void add(const WindingEdge& edge) {
    const std::int32_t from = vertex(edge.from), to = vertex(edge.to);
    const auto [found, is_new] =
        half_edge_.try_emplace({std::min(from, to), std::max(from, to)}, size32(head_));
    if (is_new) {
      head_.insert(head_.end(), {std::max(from, to), std::min(from, to)});
      weight_.insert(weight_.end(), {0, 0});
      origin_.insert(origin_.end(), {none, none});
    }
    const std::int32_t along = found->second + (from < to ? 0 : 1);
    weight_[along] += edge.weight;
    weight_[along ^ 1] -= edge.weight;
    std::int32_t& origin = origin_[edge.weight > 0 ? along : along ^ 1];
    if (origin == none) origin = edge.origin;
  }

  std::int32_t vertex(Point p) {
    const auto [found, is_new] = vertices_.try_emplace(p, size32(points_));
    if (is_new) points_.push_back(p);
    return found->second;
  }

  bool is_right(std::int32_t h) const { return points_[tail(h)] < points_[head_[h]]; }

  /// Order by tails, then counter-clockwise from straight down.
  bool comes_before(std::int32_t g, std::int32_t h) const {
    if (tail(g) != tail(h)) return tail(g) < tail(h);
    if (is_right(g) != is_right(h)) return is_right(g);
    return orientation(points_[tail(g)], points_[head_[g]], points_[head_[h]]) > 0;
  }

  void sort_round_vertices() {
    std::vector<std::int32_t> order(head_.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, [&](std::int32_t g, std::int32_t h) { return comes_before(g, h); });
    after_.assign(head_.size(), none);
    before_.assign(head_.size(), none);
    for (std::size_t first = 0; first < order.size();) {
      std::size_t end = first;
      while (end < order.size() && tail(order[end]) == tail(order[first])) ++end;
      for (std::size_t i = first; i < end; ++i) {
        const std::int32_t following = order[i + 1 < end ? i + 1 : first];
        after_[order[i]] = following;
        before_[following] = order[i];
      }
      // Nothing is left of the leftmost vertex: the face to the right behind the last edge is the outside.
      if (outermost_ == none || points_[tail(order[first])] < points_[tail(outermost_)])
        outermost_ = order[end - 1];
      first = end;
    }
  }

  void number_faces() {
    face_.assign(head_.size(), none);
    std::int32_t count = 0;
    for (std::int32_t h = 0; h < size(); ++h) {
      if (face_[h] != none) continue;
      for (std::int32_t along = h; face_[along] == none; along = before_[along ^ 1]) face_[along] = count;
      ++count;
    }
    winding_.assign(count, 0);
  }

  void wind(int outside) {
    std::vector<std::vector<std::int32_t>> around(winding_.size());
    for (std::int32_t h = 0; h < size(); ++h) around[face_[h]].push_back(h);
    std::vector<char> known(winding_.size(), 0);
    std::vector<std::int32_t> waiting{face_[outermost_]};
    known[waiting.front()] = 1;
    winding_[waiting.front()] = outside;
    while (!waiting.empty()) {
      const std::int32_t face = waiting.back();
      waiting.pop_back();
      for (const std::int32_t h : around[face]) {
        const std::int32_t other = face_[h ^ 1];
        if (known[other] != 0) continue;
        known[other] = 1;
        winding_[other] = winding_[face] - weight_[h];
        waiting.push_back(other);
      }
    }
  }

  std::vector<Point> points_;
  std::map<Point, std::int32_t> vertices_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> half_edge_;
  std::vector<std::int32_t> head_, origin_, after_, before_, face_;
  std::vector<int> weight_, winding_;
  std::int32_t outermost_ = none;
};

/// Splits a closed walk into simple loops wherever it returns to a vertex.
void add_simple_loops(const HalfEdges& graph, const std::vector<std::int32_t>& walk,
                      std::vector<WindingLoop>& loops) {
  std::vector<std::int32_t> path;
  std::map<std::int32_t, std::size_t> place_in_path;  // by tail
  const auto cut_off = [&](std::size_t begin) {
    WindingLoop loop;
    for (std::size_t i = begin; i < path.size(); ++i) {
      loop.points.push_back(graph.point(graph.tail(path[i])));
      loop.origin.push_back(graph.origin(path[i]));
      place_in_path.erase(graph.tail(path[i]));
    }
    path.resize(begin);
    loops.push_back(std::move(loop));
  };
  for (const std::int32_t h : walk) {
    place_in_path[graph.tail(h)] = path.size();
    path.push_back(h);
    if (const auto back = place_in_path.find(graph.head(h)); back != place_in_path.end())
      cut_off(back->second);
  }
}

/// Rotates the loop to begin with its first origin.
void rotate_to_first(WindingLoop& loop) {
  const auto first = std::ranges::min_element(loop.origin) - loop.origin.begin();
  // Pieces of one segment are consecutive; the first has a different origin before it.
  auto begin = first;
  const auto size = std::ssize(loop.origin);
  while (loop.origin[(begin + size - 1) % size] == loop.origin[first] && begin > first - size) --begin;
  begin = (begin + size) % size;
  std::ranges::rotate(loop.points, loop.points.begin() + begin);
  std::ranges::rotate(loop.origin, loop.origin.begin() + begin);
}

}  // namespace

std::vector<WindingLoop> outline_of_positive(const std::vector<WindingEdge>& edges, int outside) {
  const HalfEdges graph(edges, outside);
  std::vector<char> used(graph.size(), 0);
  std::vector<WindingLoop> loops;
  for (std::int32_t h = 0; h < graph.size(); ++h) {
    if (used[h] != 0 || !graph.bounds_domain(h)) continue;
    std::vector<std::int32_t> walk;
    for (std::int32_t along = h; used[along] == 0; along = graph.next_bound(along)) {
      used[along] = 1;
      walk.push_back(along);
    }
    add_simple_loops(graph, walk, loops);
  }
  for (WindingLoop& loop : loops) rotate_to_first(loop);
  std::ranges::stable_sort(loops, {}, [](const WindingLoop& loop) { return loop.origin.front(); });
  return loops;
}

}  // namespace quadloop
