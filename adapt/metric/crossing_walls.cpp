#include "adapt/metric/crossing_walls.hpp"

#include <algorithm>
#include <span>

#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop::adapt {

namespace {

bool cross(const WallSpan& s, const WallSpan& t) {
  const bool at_from = s.from() == t.from() || s.from() == t.to();
  const bool at_to = s.to() == t.from() || s.to() == t.to();
  if (!at_from && !at_to) return segments_meet(s.from(), s.to(), t.from(), t.to());
  if (at_from && at_to) return true;  // one lies on the other
  const Point common = at_from ? s.from() : s.to(), s_end = at_from ? s.to() : s.from();
  const Point t_end = common == t.from() ? t.to() : t.from();
  return on_segment(s_end, common, t_end) || on_segment(t_end, common, s_end);
}

}  // namespace

std::vector<WallSpan> wall_edges(const Communicator& comm, const Mesh& mesh) {
  std::vector<WallSpan> own;
  std::int32_t boundary = 0;
  for (const BoundaryEdges& edges : mesh.boundaries) {
    for (const auto& [a, b] : edges.edges) {
      const Point from = mesh.point(a), to = mesh.point(b);
      own.push_back({from.x, from.y, to.x, to.y, boundary});
    }
    ++boundary;
  }
  std::vector<WallSpan> all = comm.all_gather_values(std::span<const WallSpan>(own));
  std::ranges::sort(all, [](const WallSpan& a, const WallSpan& b) { return a < b; });
  return all;
}

std::optional<CrossingWalls> crossing_walls(const std::vector<WallSpan>& edges,
                                            const std::vector<WallSpan>& known) {
  std::vector<Box> boxes;
  std::vector<char> is_known;
  const auto before = [](const WallSpan& a, const WallSpan& b) { return a < b; };
  for (const WallSpan& edge : edges) {
    boxes.push_back(box_of(edge.from(), edge.to()));
    is_known.push_back(std::ranges::binary_search(known, edge, before) ? 1 : 0);
  }
  const BoxTree tree(boxes);
  for (std::int32_t i = 0; i < size32(edges); ++i) {
    std::int32_t first = size32(edges);
    tree.for_each_meeting(boxes[i], [&](std::int32_t j) {
      if (j <= i || j >= first || (is_known[i] != 0 && is_known[j] != 0)) return;
      if (cross(edges[i], edges[j])) first = j;
    });
    if (first < size32(edges)) return CrossingWalls{edges[i], edges[first]};
  }
  return {};
}

}  // namespace quadloop::adapt
