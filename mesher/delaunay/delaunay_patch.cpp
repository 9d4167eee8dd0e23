#include "mesher/delaunay/delaunay_patch.hpp"

#include <algorithm>

namespace quadloop {

std::vector<char> DelaunayPatch::doubtful() const {
  std::vector<char> doubts(triangles_.size(), 0);
  std::vector<std::int32_t> seen_from(triangles_.size(), -1);
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < 3 * triangles_.size(); ++i) {
    const auto e = static_cast<Flipper::Edge>(i);
    if (flipper_.across(e) != Flipper::open_border) continue;
    const Triangle& rim = triangles_[Flipper::triangle_of(e)];
    const Point from = point(rim[Flipper::corner_of(e, 1)]), to = point(rim[Flipper::corner_of(e, 2)]);
    waiting.assign(1, Flipper::triangle_of(e));
    while (!waiting.empty()) {
      const std::size_t t = waiting.back();
      waiting.pop_back();
      if (seen_from[t] == e || !circle_reaches(t, from, to)) continue;
      seen_from[t] = e;
      doubts[t] = 1;
      for (std::int32_t k = 0; k < 3; ++k) {
        const Flipper::Edge beyond = flipper_.across(static_cast<Flipper::Edge>(3 * t) + k);
        if (beyond >= 0) waiting.push_back(Flipper::triangle_of(beyond));
      }
    }
  }
  return doubts;
}

/// Whether the closed circumcircle meets a segment; true in case of doubt (rounding).
bool DelaunayPatch::circle_reaches(std::size_t triangle, Point from, Point to) const {
  using Wide = long double;
  constexpr Wide margin = 1e-6L;
  const auto& [i, j, k] = triangles_[triangle];
  const Point a = point(i), u = point(j) - a, v = point(k) - a;
  const Wide twice_area = Wide(u.x) * v.y - Wide(u.y) * v.x;
  const Wide uu = Wide(u.x) * u.x + Wide(u.y) * u.y, vv = Wide(v.x) * v.x + Wide(v.y) * v.y;
  const Wide x = (v.y * uu - u.y * vv) / (2 * twice_area),
             y = (u.x * vv - v.x * uu) / (2 * twice_area);  // the centre, relative to a
  const Wide square = x * x + y * y;
  if (!(square < 1e12L * (uu + vv))) return true;  // the circle is nearly a half plane
  const Point p = from - a, d = to - from;
  const Wide length_squared = Wide(d.x) * d.x + Wide(d.y) * d.y;
  const Wide t = std::clamp(((x - p.x) * d.x + (y - p.y) * d.y) / length_squared, Wide(0), Wide(1));
  const Wide dx = p.x + t * d.x - x, dy = p.y + t * d.y - y;
  return dx * dx + dy * dy <= square * (1 + margin);
}

}  // namespace quadloop
