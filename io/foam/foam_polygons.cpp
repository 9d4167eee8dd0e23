#include "io/foam/foam_polygons.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadloop::io {

namespace {

/// Dynamic programming over the sub-polygons cut off by the chord between two corners.
class PolygonDivision {
 public:
  explicit PolygonDivision(std::span<const Point3> corners)
      : corners_{corners},
        count_{static_cast<std::int32_t>(corners.size())},
        best_(corners.size() * corners.size()) {
    for (std::int32_t i = 0; i < count_; ++i)
      normal_ = normal_ + cross(corners_[i] - corners_[0], corners_[(i + 1) % count_] - corners_[0]);
  }

  std::vector<PolygonPiece> run() {
    for (std::int32_t length = 2; length < count_; ++length) {
      for (std::int32_t i = 0; i + length < count_; ++i) find_best(i, i + length);
    }
    if (!(at(0, count_ - 1).worst > 0)) return {};
    collect(0, count_ - 1);
    return pieces_;
  }

 private:
  struct Best {
    double worst = std::numeric_limits<double>::infinity();  ///< infinite for an edge, which cuts off nothing
    PolygonPiece piece{-1, -1, -1, -1};                      ///< piece at the chord
    std::int32_t pieces = 0;
  };

  Best& at(std::int32_t i, std::int32_t j) { return best_[i * count_ + j]; }

  /// Returns the sine of a corner angle, seen from the front of the polygon.
  double corner(std::int32_t before, std::int32_t i, std::int32_t after) const {
    const Point3 u = corners_[after] - corners_[i], v = corners_[before] - corners_[i];
    return dot(cross(u, v), normal_) / (length(u) * length(v) * length(normal_));
  }

  /// Returns the worst corner, 1 for an equilateral triangle and for a square.
  double shape(const PolygonPiece& p) const {
    constexpr double of_equilateral = 0.8660254037844386;  // sine of 60 degrees
    const std::size_t width = p[3] < 0 ? 3 : 4;
    double worst = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < width; ++k) {
      const double sine = corner(p[(k + width - 1) % width], p[k], p[(k + 1) % width]);
      if (!(sine >= worst)) worst = sine;  // also for edges of zero length (NaN)
    }
    return width == 3 ? worst / of_equilateral : worst;
  }

  void find_best(std::int32_t i, std::int32_t j) {
    Best& best = at(i, j);
    best.worst = -std::numeric_limits<double>::infinity();
    const auto consider = [&](const PolygonPiece& piece) {
      Best found{shape(piece), piece, 1};
      const std::size_t width = piece[3] < 0 ? 3 : 4;
      for (std::size_t k = 0; k + 1 < width; ++k) {
        const Best& beyond = at(piece[k], piece[k + 1]);
        found.worst = std::min(found.worst, beyond.worst);
        found.pieces += beyond.pieces;
      }
      const bool is_as_good = found.worst == best.worst && found.pieces < best.pieces;
      if (found.worst > best.worst || is_as_good) best = found;
    };
    for (std::int32_t k = i + 1; k < j; ++k) {
      for (std::int32_t l = k + 1; l < j; ++l) consider({i, k, l, j});
      consider({i, k, j, -1});
    }
  }

  void collect(std::int32_t i, std::int32_t j) {
    const PolygonPiece piece = at(i, j).piece;
    if (piece[0] < 0) return;
    pieces_.push_back(piece);
    const std::size_t width = piece[3] < 0 ? 3 : 4;
    for (std::size_t k = 0; k + 1 < width; ++k) collect(piece[k], piece[k + 1]);
  }

  std::span<const Point3> corners_;
  std::int32_t count_;
  Point3 normal_;
  std::vector<Best> best_;
  std::vector<PolygonPiece> pieces_;
};

}  // namespace

std::vector<PolygonPiece> divide_polygon(std::span<const Point3> corners) {
  return PolygonDivision(corners).run();
}

}  // namespace quadloop::io
