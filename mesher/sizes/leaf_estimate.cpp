#include "mesher/sizes/leaf_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "mesher/sizes/leaves_ahead.hpp"
#include "mesher/sizes/size_cursor.hpp"

namespace quadloop {

namespace {

constexpr double followed = 192;         ///< approximate number of split quadrants followed per level
constexpr double outside_of_cut = 0.75;  ///< approximate number of leaves outside the domain per cut leaf

/// A sampled quadrant that represents `weight` quadrants of its level.
struct Sampled {
  Quadrant quadrant;
  double weight = 1;
  enum class Side : std::uint8_t { unknown, inside, outside };
  Side side = Side::unknown;  ///< known if it contains no geometry
};

class LeafCount {
 public:
  /// `comm`: the ranks that share the evaluation of quadrants; null: this rank evaluates all.
  LeafCount(const Communicator* comm, SizeTree& sizes)
      : comm_{comm}, sizes_{sizes}, cursor_{sizes}, gradation_{sizes}, ahead_{sizes, gradation_} {}

  LeafEstimate count() {
    std::vector<Sampled> level;
    for (std::int64_t ty = 0; ty < sizes_.grid().trees_y(); ++ty) {
      for (std::int64_t tx = 0; tx < sizes_.grid().trees_x(); ++tx) {
        level.push_back({{tx << Quadrant::unit_level, ty << Quadrant::unit_level, 0}});
      }
    }
    while (!level.empty()) level = chosen(splits_among(children_of(level)));
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

  /// Evaluates `look` for each quadrant, in order. Each rank evaluates a contiguous part.
  template <class Look>
  auto looks_at(const std::vector<Sampled>& quadrants, const Look& look) const {
    using Found = decltype(look(quadrants.front()));
    const std::size_t ranks = comm_ ? comm_->size() : 1, rank = comm_ ? comm_->rank() : 0;
    const std::size_t end = quadrants.size() * (rank + 1) / ranks;
    std::vector<Found> found;
    for (std::size_t i = quadrants.size() * rank / ranks; i < end; ++i) found.push_back(look(quadrants[i]));
    return ranks > 1 ? comm_->all_gather_values(std::span<const Found>(found)) : found;
  }

  struct Seen {
    Sampled::Side side;
    bool is_cut, is_split;
  };
  Seen see(const Sampled& q) {
    const bool unknown = q.side == Sampled::Side::unknown;
    const bool is_cut = unknown && !cursor_.segments_in(q.quadrant).empty();
    const Sampled::Side side = unknown && !is_cut ? side_of(q.quadrant) : q.side;
    return {side, is_cut, side != Sampled::Side::outside && gradation_.must_split(q.quadrant)};
  }

  std::vector<Sampled> splits_among(const std::vector<Sampled>& quadrants) {
    std::vector<Sampled> splits;
    const std::vector<Seen> seen = looks_at(quadrants, [&](const Sampled& q) { return see(q); });
    for (std::size_t i = 0; i < quadrants.size(); ++i) {
      const Sampled q{quadrants[i].quadrant, quadrants[i].weight, seen[i].side};
      if (seen[i].is_split)
        splits.push_back(q);
      else if (q.side == Sampled::Side::outside)
        count(q, counted_.outside);
      else
        seen[i].is_cut ? count(q, counted_.cut, outside_of_cut * q.weight) : count(q, counted_.inside);
    }
    return splits;
  }

  /// Expected content of a split quadrant and the others that it represents.
  struct Expected {
    double leaves, segments;
  };
  Expected expect(const Sampled& s) {
    return {s.weight * ahead_.below(s.quadrant), s.weight * size32(cursor_.segments_in(s.quadrant))};
  }

  /// Selection probabilities: half by the expected leaves, a quarter by the geometry inside, a quarter
  /// uniform, so that a wrong guess of one kind has limited effect.
  std::vector<double> chances_of(const std::vector<Sampled>& splits) {
    const std::vector<Expected> expected = looks_at(splits, [&](const Sampled& s) { return expect(s); });
    Expected all{0, 0};
    double all_weight = 0;
    for (std::size_t i = 0; i < splits.size(); ++i) {
      all.leaves += expected[i].leaves;
      all.segments += expected[i].segments;
      all_weight += splits[i].weight;
    }
    std::vector<double> chances;
    for (std::size_t i = 0; i < splits.size(); ++i) {
      const double by_outline = all.segments > 0 ? expected[i].segments / all.segments : 0;
      chances.push_back(std::min(1.0, followed * (0.5 * expected[i].leaves / all.leaves + 0.25 * by_outline +
                                                  0.25 * splits[i].weight / all_weight)));
    }
    return chances;
  }

  /// Samples evenly along the curve; takes all if there are few.
  std::vector<Sampled> chosen(std::vector<Sampled> splits) {
    if (size32(splits) <= followed) return splits;
    const std::vector<double> chances = chances_of(splits);
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

  /// `outside`: number of additional leaves outside the domain.
  void count(const Sampled& leaf, double& of_its_kind, double outside = 0) {
    of_its_kind += leaf.weight;
    counted_.outside += outside;
    sampled_.push_back({leaf.quadrant, leaf.weight + outside});
  }

  Sampled::Side side_of(const Quadrant& q) {
    return cursor_.is_inside(q, Corner::south_west) ? Sampled::Side::inside : Sampled::Side::outside;
  }

  const Communicator* comm_;
  SizeTree& sizes_;
  SizeCursor cursor_;
  Gradation gradation_;
  LeavesAhead ahead_;
  LeafEstimate counted_;
  std::vector<LeafSample::Row> sampled_;
};

}  // namespace

LeafEstimate estimate_leaves(SizeTree& sizes) { return LeafCount(nullptr, sizes).count(); }

LeafEstimate estimate_leaves(const Communicator& comm, SizeTree& sizes) {
  return LeafCount(&comm, sizes).count();
}

}  // namespace quadloop
