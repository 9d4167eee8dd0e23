#include "adapt/transfer/locate/locate_points.hpp"

#include <algorithm>
#include <numeric>

#include "mesher/base/ids.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop::adapt {

namespace {

constexpr std::size_t few = 8;  ///< number of points or triangles that is not subdivided
constexpr int deepest = 100;    ///< ends the subdivision of coincident points

/// Distributes points and triangles together to ever smaller bounding boxes of the remaining points, until
/// the few are tested with each other.
class Search {
 public:
  Search(const TrianglePiece& piece, std::span<const Point> points)
      : piece_{piece}, found_(points.size(), -1) {
    asked_.reserve(points.size());
    for (const Point p : points) asked_.push_back({p, size32(asked_)});
    boxes_.reserve(piece.triangles.size());
    for (std::int32_t i = 0; i < std::ssize(piece.triangles); ++i) {
      Box box;
      for (const Point p : piece.corners(piece.triangles[i])) box.include(p);
      if (boxes_.empty() || boxes_.back().low != box.low || boxes_.back().high != box.high) {
        boxes_.push_back(box);
        first_.push_back(i);
      }
    }
    first_.push_back(size32(piece.triangles));
  }

  std::vector<std::int32_t> run() {
    candidates_.resize(boxes_.size());
    std::iota(candidates_.begin(), candidates_.end(), 0);
    share_out(asked_, 0, 0);
    return std::move(found_);
  }

 private:
  struct Asked {
    Point point;
    std::int32_t index = 0;
  };

  /// Searches the points against candidates_[first ...], whose boxes meet the parent box.
  void share_out(std::span<Asked> asked, std::size_t first, int depth) {
    if (asked.empty()) return;
    Box box;
    for (const Asked& each : asked) box.include(each.point);
    const std::size_t begin = candidates_.size();
    candidates_.resize(begin + (begin - first));
    std::size_t end = begin;
    for (std::size_t i = first; i < begin; ++i) {
      const std::int32_t candidate = candidates_[i];
      candidates_[end] = candidate;  // removed again unless its box meets this one
      end += boxes_[candidate].meets(box) ? 1 : 0;
    }
    candidates_.resize(end);
    if (std::min(asked.size(), candidates_.size() - begin) <= few || depth == deepest) {
      try_all(asked, begin);
    } else {
      halve(asked, begin, box, depth);
    }
    candidates_.resize(begin);
  }

  void halve(std::span<Asked> asked, std::size_t begin, const Box& box, int depth) {
    const Point centre = box.centre();
    const bool wide = box.width() > box.height();
    const auto middle = std::partition(asked.begin(), asked.end(), [&](const Asked& each) {
      return wide ? each.point.x < centre.x : each.point.y < centre.y;
    });
    const std::size_t low = middle - asked.begin();
    share_out(asked.first(low), begin, depth + 1);
    share_out(asked.subspan(low), begin, depth + 1);
  }

  void try_all(std::span<const Asked> asked, std::size_t begin) {
    for (const auto& [p, index] : asked) {
      std::int32_t& best = found_[index];
      for (std::size_t i = begin; i < candidates_.size(); ++i) {
        const std::int32_t candidate = candidates_[i];
        if (!boxes_[candidate].contains(p)) continue;
        for (std::int32_t triangle = first_[candidate]; triangle < first_[candidate + 1]; ++triangle) {
          if (best >= 0 && number_of(best) < number_of(triangle)) continue;
          if (contains(piece_.corners(piece_.triangles[triangle]), p)) best = triangle;
        }
      }
    }
  }

  std::int64_t number_of(std::int32_t triangle) const { return piece_.triangles[triangle].number; }

  const TrianglePiece& piece_;
  std::vector<Asked> asked_;              ///< in the order of the boxes
  std::vector<Box> boxes_;                ///< of the triangles, one for both halves of a rectangle
  std::vector<std::int32_t> first_;       ///< first triangle of each box, then the total number
  std::vector<std::int32_t> candidates_;  ///< a stack: the boxes of each depth follow those of its parent
  std::vector<std::int32_t> found_;
};

}  // namespace

bool contains(const std::array<Point, 3>& corners, Point p) {
  const auto& [a, b, c] = corners;
  return orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0;
}

std::vector<std::int32_t> locate_points(const TrianglePiece& piece, std::span<const Point> points) {
  return Search(piece, points).run();
}

}  // namespace quadloop::adapt
