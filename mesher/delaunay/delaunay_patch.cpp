#include "mesher/delaunay/delaunay_patch.hpp"

#include <algorithm>

#include "mesher/geometry/predicates.hpp"

namespace quadloop {

DelaunayPatch::DelaunayPatch(std::vector<Point> points, std::vector<TieRank> ranks,
                             std::vector<Triangle> triangles, const std::vector<char>& open,
                             const std::vector<std::int32_t>& blocks)
    : points_{std::move(points)},
      ranks_{std::move(ranks)},
      triangles_{std::move(triangles)},
      across_(3 * triangles_.size(), border) {
  join(open, blocks);
}

/// Finds the triangle across each edge.
void DelaunayPatch::join(const std::vector<char>& open, const std::vector<std::int32_t>& blocks) {
  struct Named {
    std::int32_t low, high;
    Edge edge;
  };
  std::vector<Named> named;
  named.reserve(across_.size());
  for (Edge e = 0; e < static_cast<Edge>(across_.size()); ++e) {
    const auto [low, high] = std::minmax({node(e, 1), node(e, 2)});
    named.push_back({low, high, e});
  }
  std::sort(named.begin(), named.end(), [](const Named& a, const Named& b) {
    return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.edge < b.edge;
  });
  for (std::size_t i = 0; i < named.size(); ++i) {
    const bool paired =
        i + 1 < named.size() && named[i].low == named[i + 1].low && named[i].high == named[i + 1].high;
    if (paired) {
      const Edge e = named[i].edge, f = named[i + 1].edge;
      const bool flips = blocks.empty() || blocks[triangle_of(e)] == blocks[triangle_of(f)];
      across(e) = flips ? f : border;
      across(f) = flips ? e : border;
      ++i;
    } else if (open[triangle_of(named[i].edge)] != 0) {
      across(named[i].edge) = open_border;
    }
  }
}

void DelaunayPatch::flip_to_delaunay() {
  std::vector<Edge> waiting;
  for (Edge e = 0; e < static_cast<Edge>(across_.size()); ++e) {
    if (across(e) > e) waiting.push_back(e);
  }
  while (!waiting.empty()) {
    const Edge e = waiting.back();
    waiting.pop_back();
    if (across(e) < 0 || !should_flip(e)) continue;
    const auto s = static_cast<Edge>(triangle_of(e)), t = static_cast<Edge>(triangle_of(across(e)));
    flip(e);
    for (Edge k = 0; k < 3; ++k) {
      waiting.push_back(3 * s + k);
      waiting.push_back(3 * t + k);
    }
  }
}

/// By the plain products in doubles that every reader of the mesh will use, at each corner.
bool DelaunayPatch::positive(std::int32_t a, std::int32_t b, std::int32_t c) const {
  const Point p = point(a), q = point(b), r = point(c);
  return cross(q - p, r - p) > 0 && cross(r - q, p - q) > 0 && cross(p - r, q - r) > 0 &&
         orientation(p, q, r) > 0;
}

bool DelaunayPatch::should_flip(Edge e) const {
  const std::int32_t c = node(e, 0), a = node(e, 1), b = node(e, 2), d = node(across(e), 0);
  const int inside = in_circle(point(a), point(b), point(c), point(d));
  if (inside < 0) return false;
  const auto rank = [&](std::int32_t n) -> const TieRank& { return ranks_[static_cast<std::size_t>(n)]; };
  if (inside == 0 && !(std::max(rank(c), rank(d)) > std::max(rank(a), rank(b)))) return false;
  return positive(a, d, c) && positive(d, b, c);
}

void DelaunayPatch::set_across(Edge e, Edge other) {
  across(e) = other;
  if (other >= 0) across(other) = e;
}

/// The triangles c a b and d b a become c a d and d b c.
void DelaunayPatch::flip(Edge e) {
  const Edge f = across(e);
  const auto next = [](Edge edge) { return edge % 3 == 2 ? edge - 2 : edge + 1; };
  const std::int32_t c = node(e, 0), a = node(e, 1), b = node(e, 2), d = node(f, 0);
  const Edge beyond_bc = across(next(e)), beyond_ca = across(next(next(e)));  // opposite a, opposite b
  const Edge beyond_ad = across(next(f)), beyond_db = across(next(next(f)));  // opposite b, opposite a
  const auto s = static_cast<Edge>(triangle_of(e)), t = static_cast<Edge>(triangle_of(f));
  triangles_[static_cast<std::size_t>(s)] = {c, a, d};
  triangles_[static_cast<std::size_t>(t)] = {d, b, c};
  set_across(3 * s, beyond_ad);
  set_across(3 * s + 2, beyond_ca);
  set_across(3 * t, beyond_bc);
  set_across(3 * t + 2, beyond_db);
  set_across(3 * s + 1, 3 * t + 1);
}

std::vector<char> DelaunayPatch::doubtful() const {
  std::vector<char> doubts(triangles_.size(), 0);
  std::vector<std::int32_t> seen_from(triangles_.size(), -1);
  std::vector<std::size_t> waiting;
  for (Edge e = 0; e < static_cast<Edge>(across_.size()); ++e) {
    if (across(e) != open_border) continue;
    const Point from = point(node(e, 1)), to = point(node(e, 2));
    waiting.assign(1, triangle_of(e));
    while (!waiting.empty()) {
      const std::size_t t = waiting.back();
      waiting.pop_back();
      if (seen_from[t] == e || !circle_reaches(t, from, to)) continue;
      seen_from[t] = e;
      doubts[t] = 1;
      for (std::size_t k = 0; k < 3; ++k) {
        const Edge beyond = across_[3 * t + k];
        if (beyond >= 0) waiting.push_back(triangle_of(beyond));
      }
    }
  }
  return doubts;
}

/// Whether the closed circumcircle meets a segment; rather yes than no where rounding might tell otherwise.
bool DelaunayPatch::circle_reaches(std::size_t triangle, Point from, Point to) const {
  using Wide = long double;
  constexpr Wide margin = 1e-6L;
  const auto& [i, j, k] = triangles_[triangle];
  const Point a = point(i), u = point(j) - a, v = point(k) - a;
  const Wide twice_area = Wide(u.x) * v.y - Wide(u.y) * v.x;
  const Wide uu = Wide(u.x) * u.x + Wide(u.y) * u.y, vv = Wide(v.x) * v.x + Wide(v.y) * v.y;
  const Wide x = (v.y * uu - u.y * vv) / (2 * twice_area),
             y = (u.x * vv - v.x * uu) / (2 * twice_area);  // the centre, from a
  const Wide square = x * x + y * y;
  if (!(square < 1e12L * (uu + vv))) return true;  // next to a half plane
  const Point p = from - a, d = to - from;
  const Wide length_squared = Wide(d.x) * d.x + Wide(d.y) * d.y;
  const Wide t = std::clamp(((x - p.x) * d.x + (y - p.y) * d.y) / length_squared, Wide(0), Wide(1));
  const Wide dx = p.x + t * d.x - x, dy = p.y + t * d.y - y;
  return dx * dx + dy * dy <= square * (1 + margin);
}

}  // namespace quadloop
