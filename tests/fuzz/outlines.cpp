#include "tests/fuzz/outlines.hpp"

#include <algorithm>
#include <cmath>

namespace quadloop::fuzz {

namespace {

/// Walked round their mean, so that the loop seldom meets itself.
void sort_round_mean(std::vector<Point>& corners) {
  Point mean;
  for (const Point p : corners) mean = mean + (1.0 / static_cast<double>(corners.size())) * p;
  std::ranges::stable_sort(corners, {}, [&](Point p) { return std::atan2(p.y - mean.y, p.x - mean.x); });
}

}  // namespace

std::vector<Chain> loops_from(Bytes& bytes) {
  std::vector<Chain> chains{{"box", false, {{-3, -3}, {4, -3}, {4, 4}, {-3, 4}}, {}}};
  const int kind = bytes.below(4);
  if (kind % 2 == 1) chains.clear();
  for (int loops = 1 + bytes.below(3); loops > 0; --loops) {
    Chain chain{"loop", false, {}, {}};
    for (int corners = 3 + bytes.below(6); corners > 0; --corners) {
      const int x = bytes.below(33), y = bytes.below(33);
      chain.points.push_back({(x - 8) / 16.0, (y - 8) / 16.0});
    }
    if (kind < 2) sort_round_mean(chain.points);
    chains.push_back(chain);
  }
  return chains;
}

}  // namespace quadloop::fuzz
