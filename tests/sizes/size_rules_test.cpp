// What is promised of a quadrant's leaves before it is split holds for all splits inside it, whatever sources
// and corners ask.
#include "mesher/sizes/size_rules.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/sizes/diamond_sizes.hpp"

namespace quadloop {
namespace {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_{seed} {}
  double between(double low, double high) { return low + (high - low) * share_(engine_); }
  Point place() { return {between(-1.4, 1.4), between(-1.4, 1.4)}; }
  bool toss() { return share_(engine_) < 0.5; }

  SizeSource source() {
    const Point from = place();
    const Point to = from + Point{between(0.001, 0.5), between(0.001, 0.5)};
    const double spacing = std::exp(between(std::log(0.02), std::log(1.0)));
    switch (static_cast<int>(between(0, 3))) {
      case 0: return {Box{from, to}, spacing};
      case 1: return {SizeSource::Disc{from, between(0.001, 0.5)}, spacing};
      default: return {SizeSource::Line{from, to}, spacing};
    }
  }

 private:
  std::mt19937_64 engine_;
  std::uniform_real_distribution<double> share_{0, 1};
};

/// Both boundaries may ask for leaves of a size at their corners.
Geometry random_geometry(Random& random) {
  const auto corner_spacing = [&] { return random.toss() ? random.between(0.02, 0.6) : 0; };
  const double at_frame = corner_spacing(), at_diamond = corner_spacing();
  constexpr double reach = 0.125;
  const auto middle = [&] {  // of a diamond that touches a grid line from either side, or of none
    return random.toss() ? random.between(-0.8, 0.8) : random.toss() ? reach : -reach;
  };
  return test::diamond_in_square({{middle(), middle()}, reach},
                                 {"frame", random.between(0.1, 2), 30, "none", at_frame},
                                 {"diamond", random.between(0.03, 0.5), 30, "wall", at_diamond});
}

SizeOptions random_options(Random& random) {
  SizeOptions options;
  options.min = random.between(0.04, 0.2);
  options.max = random.between(options.min, 1.6);
  if (random.toss()) options.curvature = random.between(1, 90);
  if (random.toss()) options.gap = random.between(0, 8);
  for (int i = 0; i < 3; ++i) options.sources.push_back(random.source());
  return options;
}

/// A quadrant and those above it, with what was promised of their leaves.
struct Descent {
  const SizeRules& rules;
  std::vector<SizeRules::Judgement> promises;
  int splits = 0;

  void into(const Quadrant& q) {
    constexpr int deepest = 6;
    const Box box = rules.grid().box_of(q);
    std::vector<std::int32_t> segments, corners;
    for (std::int32_t s = 0; s < rules.outline().geometry().size(); ++s) {
      if (rules.outline().meets(s, box)) segments.push_back(s);
    }
    for (const std::int32_t v : rules.sized_corners()) {
      if (box.contains(rules.outline().geometry().point(v))) corners.push_back(v);
    }
    const SizedQuadrant sized{q, box, segments, corners, 0, false};
    promises.push_back(rules.judge(sized));
    if (rules.wants_split(sized)) {
      ++splits;
      for (const auto& [plain, finest] : promises) {
        EXPECT_GT(finest, q.level);
        EXPECT_TRUE(!plain || q.level < rules.coarsest_level()) << "at level " << q.level;
      }
    }
    if (q.level < deepest) {
      for (const Corner quarter : corners_along_curve) into(q.child(quarter));
    }
    promises.pop_back();
  }
};

TEST(SizeRules, JudgeNeverPromisesLessThanIsSplit) {
  int splits = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Geometry geometry = random_geometry(random);
    const ShiftedOutline outline(geometry);
    const TreeGrid grid(Box{{-1.5, -1.5}, {1.5, 1.5}}, 1, 1);
    const DemandedSplits demanded;
    const bool all_unresolved = random.toss();
    const SizeRules rules(
        outline, grid, random_options(random),
        [=](const Quadrant&, std::span<const std::int32_t>) { return all_unresolved; }, demanded);
    Descent descent{rules, {}};
    descent.into({});
    splits += descent.splits;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(splits, 1000);
}

}  // namespace
}  // namespace quadloop
