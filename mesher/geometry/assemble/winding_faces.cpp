#include "mesher/geometry/assemble/winding_faces.hpp"

#include <algorithm>
#include <map>

#include "mesher/geometry/assemble/half_edges.hpp"

namespace quadloop {

namespace {

constexpr std::int32_t none = -1;

/// The faces between the edges, with their winding numbers.
class WindingFaces {
 public:
  WindingFaces(const std::vector<WindingEdge>& edges, int outside) {
    for (const WindingEdge& edge : edges) add(edge);
    graph_.link();
    wind(outside);
  }

  const HalfEdges& graph() const { return graph_; }
  std::int32_t origin(std::int32_t h) const { return origin_[h]; }

  /// Whether the domain is to its left and not to its right.
  bool bounds_domain(std::int32_t h) const { return winding(h) > 0 && winding(h ^ 1) <= 0; }

  /// The next half-edge that bounds the domain, counter-clockwise from the reverse of h, so that there is no
  /// domain between the two.
  std::int32_t next_bound(std::int32_t h) const {
    std::int32_t turned = graph_.after(h ^ 1);
    while (!bounds_domain(turned)) turned = graph_.after(turned);
    return turned;
  }

 private:
  int winding(std::int32_t h) const { return winding_[graph_.walk_of(h)]; }

  void add(const WindingEdge& edge) {
    const std::int32_t along = graph_.add(edge.from, edge.to);
    weight_.resize(graph_.size(), 0);
    origin_.resize(graph_.size(), none);
    weight_[along] += edge.weight;
    weight_[along ^ 1] -= edge.weight;
    std::int32_t& origin = origin_[edge.weight > 0 ? along : along ^ 1];
    if (origin == none) origin = edge.origin;
  }

  void wind(int outside) {
    winding_.assign(graph_.walks(), 0);
    std::vector<std::vector<std::int32_t>> around(winding_.size());
    for (std::int32_t h = 0; h < graph_.size(); ++h) around[graph_.walk_of(h)].push_back(h);
    std::vector<char> known(winding_.size(), 0);
    std::vector<std::int32_t> waiting{graph_.walk_of(graph_.outermost().front())};
    known[waiting.front()] = 1;
    winding_[waiting.front()] = outside;
    while (!waiting.empty()) {
      const std::int32_t face = waiting.back();
      waiting.pop_back();
      for (const std::int32_t h : around[face]) {
        const std::int32_t other = graph_.walk_of(h ^ 1);
        if (known[other] != 0) continue;
        known[other] = 1;
        winding_[other] = winding_[face] - weight_[h];
        waiting.push_back(other);
      }
    }
  }

  HalfEdges graph_;
  std::vector<std::int32_t> origin_;
  std::vector<int> weight_, winding_;
};

/// Splits a closed walk into simple loops wherever it returns to a vertex.
void add_simple_loops(const WindingFaces& faces, const std::vector<std::int32_t>& walk,
                      std::vector<WindingLoop>& loops) {
  const HalfEdges& graph = faces.graph();
  std::vector<std::int32_t> path;
  std::map<std::int32_t, std::size_t> place_in_path;  // by tail
  const auto cut_off = [&](std::size_t begin) {
    WindingLoop loop;
    for (std::size_t i = begin; i < path.size(); ++i) {
      loop.points.push_back(graph.point(graph.tail(path[i])));
      loop.origin.push_back(faces.origin(path[i]));
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
  const WindingFaces faces(edges, outside);
  std::vector<char> used(faces.graph().size(), 0);
  std::vector<WindingLoop> loops;
  for (std::int32_t h = 0; h < faces.graph().size(); ++h) {
    if (used[h] != 0 || !faces.bounds_domain(h)) continue;
    std::vector<std::int32_t> walk;
    for (std::int32_t along = h; used[along] == 0; along = faces.next_bound(along)) {
      used[along] = 1;
      walk.push_back(along);
    }
    add_simple_loops(faces, walk, loops);
  }
  for (WindingLoop& loop : loops) rotate_to_first(loop);
  std::ranges::stable_sort(loops, {}, [](const WindingLoop& loop) { return loop.origin.front(); });
  return loops;
}

}  // namespace quadloop
