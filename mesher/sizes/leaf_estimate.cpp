#include "mesher/sizes/leaf_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "mesher/sizes/leaves_ahead.hpp"
#include "mesher/sizes/size_cursor.hpp"

namespace quadloop {

namespace {

constexpr double followed = 192;         ///< split quadrants of a level, about
constexpr double outside_of_cut = 0.75;  ///< leaves into which the outside is split for each cut one, about

/// A quadrant that stands for `weight` of its level.
struct Sampled {
  Quadrant quadrant;
  double weight = 1;
  enum class Side : std::uint8_t { unknown, inside, outside };
  Side side = Side::unknown;  ///< known where it holds no outline
};

/// The chances of being followed: half by the leaves expected, a quarter by the outline inside, a quarter for
/// each alike, so that a wrong guess of any one kind cannot hide much.
std::vector<double> chances_of(const std::vector<Sampled>& splits, LeavesAhead& leaves, SizeCursor& cursor) {
  std::vector<double> ahead, outline;
  double all_ahead = 0, all_outline = 0, all = 0;
  for (const Sampled& s : splits) {
    ahead.push_back(s.weight * leaves.below(s.quadrant));
    outline.push_back(s.weight * size32(cursor.segments_in(s.quadrant)));
    all_ahead += ahead.back();
    all_outline += outline.back();
    all += s.weight;
  }
  std::vector<double> chances;
  for (std::size_t i = 0; i < splits.size(); ++i) {
    const double by_outline = all_outline > 0 ? outline[i] / all_outline : 0;
    chances.push_back(std::min(
        1.0, followed * (0.5 * ahead[i] / all_ahead + 0.25 * by_outline + 0.25 * splits[i].weight / all)));
  }
  return chances;
}

/// Evenly along the curve. All where there are few.
std::vector<Sampled> chosen(std::vector<Sampled> splits, LeavesAhead& leaves, SizeCursor& cursor) {
  if (size32(splits) <= followed) return splits;
  const std::vector<double> chances = chances_of(splits, leaves, cursor);
  std::vector<Sampled> kept;
  double sum = 0.5;
  for (std::size_t i = 0; i < splits.size(); ++i) {
    const double before = sum;
    sum += chances[i];
    if (chances[i] < 1 && std::floor(sum) == std::floor(before)) continue;
    kept.push_back(splits[i]);
    kept.back().weight /= chances[i];
  }
  return kept;
}

class LeafCount {
 public:
  explicit LeafCount(const SizeTree& sizes)
      : sizes_{sizes}, cursor_{sizes}, gradation_{sizes}, ahead_{sizes, gradation_} {}

  LeafEstimate count() {
    std::vector<Sampled> level;
    for (std::int64_t ty = 0; ty < sizes_.lattice().trees_y(); ++ty) {
      for (std::int64_t tx = 0; tx < sizes_.lattice().trees_x(); ++tx) {
        level.push_back({{tx << Quadrant::unit_level, ty << Quadrant::unit_level, 0}});
      }
    }
    while (!level.empty()) level = chosen(splits_among(children_of(level)), ahead_, cursor_);
    counted_.sample = LeafSample(std::move(sampled_));
    return std::move(counted_);
  }

 private:
  static std::vector<Sampled> children_of(const std::vector<Sampled>& parents) {
    std::vector<Sampled> children;
    for (const Sampled& parent : parents) {
      for (const Corner quarter : corners_along_curve)
        children.push_back({parent.quadrant.child(quarter), parent.weight, parent.side});
    }
    return children;
  }

  std::vector<Sampled> splits_among(const std::vector<Sampled>& quadrants) {
    std::vector<Sampled> splits;
    for (Sampled q : quadrants) {
      const bool cut = q.side == Sampled::Side::unknown && !cursor_.segments_in(q.quadrant).empty();
      if (!cut && q.side == Sampled::Side::unknown) q.side = side_of(q.quadrant);
      if (q.side == Sampled::Side::outside)
        count(q, counted_.outside);
      else if (gradation_.must_split(q.quadrant))
        splits.push_back(q);
      else
        cut ? count(q, counted_.cut, outside_of_cut * q.weight) : count(q, counted_.inside);
    }
    return splits;
  }

  /// `outside`: how many more lie outside beside it.
  void count(const Sampled& leaf, double& of_its_kind, double outside = 0) {
    of_its_kind += leaf.weight;
    counted_.outside += outside;
    sampled_.push_back({leaf.quadrant, leaf.weight + outside});
  }

  Sampled::Side side_of(const Quadrant& q) {
    return cursor_.is_inside(q, Corner::south_west) ? Sampled::Side::inside : Sampled::Side::outside;
  }

  const SizeTree& sizes_;
  SizeCursor cursor_;
  Gradation gradation_;
  LeavesAhead ahead_;
  LeafEstimate counted_;
  std::vector<LeafSample::Row> sampled_;
};

}  // namespace

LeafEstimate estimate_leaves(const SizeTree& sizes) { return LeafCount(sizes).count(); }

}  // namespace quadloop
