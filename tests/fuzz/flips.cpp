// Triangles of a grid whose inner nodes are moved, so that many lie on one circle, with diagonals by lot:
// flipped, they are Delaunay, and the same whatever the diagonals were.
#include <algorithm>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/delaunay/flipper.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace quadloop::fuzz {

namespace {

using Triangles = std::vector<Flipper::Triangle>;

Triangles sorted(Triangles triangles) {
  for (auto& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

void require_delaunay(const std::vector<Point>& points, const Triangles& triangles) {
  for (const auto& t : triangles) {
    QUADLOOP_REQUIRE(is_positive(points[t[0]], points[t[1]], points[t[2]]), "a triangle is not positive");
    for (const Point p : points) {
      QUADLOOP_REQUIRE(in_circle(points[t[0]], points[t[1]], points[t[2]], p) <= 0,
                       "a node lies inside a circumcircle");
    }
  }
}

}  // namespace

int flip_edges(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const int n = 1 + bytes.below(6);
  std::vector<Point> points;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const bool inner = 0 < i && i < n && 0 < j && j < n;  // up to 0.2 off, all squares stay convex
      const double across = inner ? 0.05 * (bytes.below(9) - 4) : 0,
                   up = inner ? 0.05 * (bytes.below(9) - 4) : 0;
      points.push_back({i + across, j + up});
    }
  }
  const Flipper::RankOf rank_of = [&](std::int32_t node) {
    return tie_rank({0.3 * n, 0.45 * n}, points[node]);
  };
  Triangles one, other;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const std::int32_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      const int lot = bytes.below(4);
      for (Triangles* triangles : {&one, &other}) {
        const bool first = (lot & (triangles == &one ? 1 : 2)) != 0;
        triangles->push_back(first ? Flipper::Triangle{a, b, c} : Flipper::Triangle{a, b, d});
        triangles->push_back(first ? Flipper::Triangle{a, c, d} : Flipper::Triangle{b, c, d});
      }
    }
  }
  Flipper flipper;
  flipper.flip_to_delaunay(points, rank_of, one);
  flipper.flip_to_delaunay(points, rank_of, other);
  require_delaunay(points, one);
  QUADLOOP_REQUIRE(sorted(one) == sorted(other), "the triangles depend on those at the beginning");
  return 0;
}

}  // namespace quadloop::fuzz
