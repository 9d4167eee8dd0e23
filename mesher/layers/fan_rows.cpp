#include "mesher/layers/fan_rows.hpp"

#include <algorithm>
#include <numeric>

namespace quadloop {

namespace {

constexpr double cosine_of_sharp = 0.93;  // 21.6 degrees
constexpr double cosine_of_wide = 0.6;    // 53 degrees; wider cells get flat where rows grow by a fifth
constexpr int rows_between_merges = 3;

/// The rays that end where two sectors merge into one (or three in the middle). Pairs are formed from both
/// ends, so that a mirror image merges alike.
class Merging {
 public:
  Merging(std::span<const Point> directions, const std::vector<std::int32_t>& rays)
      : directions_{directions}, rays_{rays}, goes_(rays.size(), 0) {
    const std::int32_t sectors = size32(rays) - 1, half = sectors / 2;
    const bool odd = sectors % 2 == 1, three = odd && half > 0 && merge(half, half + 1);
    const std::int32_t beside = three ? half - 1 : half;  // number of sectors left in either half
    const bool one_is_left = !pair_up(0, 1, beside), another = !pair_up(sectors, -1, beside);
    if (!odd && half > 0 && one_is_left && another) merge(half, half);
  }

  bool any() const { return std::ranges::find(goes_, 1) != goes_.end(); }
  bool goes(std::size_t i) const { return goes_[i] != 0; }

 private:
  /// Merges pairs among this number of sectors from one end on; returns whether the last sector is in a pair.
  bool pair_up(std::int32_t end, std::int32_t step, std::int32_t sectors) {
    bool paired = false;
    for (std::int32_t i = 1; i < sectors; ++i) paired = !paired && merge(end + i * step, end + i * step);
    return paired;
  }
  /// Merges the sectors beside these rays if one of them is sharp and none becomes too wide.
  bool merge(std::int32_t first, std::int32_t last) {
    bool sharp = false;
    for (std::int32_t i = first; i <= last + 1; ++i) sharp |= dot(at(i - 1), at(i)) > cosine_of_sharp;
    if (!sharp || dot(at(first - 1), at(last + 1)) < cosine_of_wide) return false;
    goes_[first] = goes_[last] = 1;
    return true;
  }
  Point at(std::int32_t i) const { return directions_[rays_[i]]; }

  std::span<const Point> directions_;
  const std::vector<std::int32_t>& rays_;
  std::vector<char> goes_;
};

}  // namespace

FanRows::FanRows(std::span<const Point> rays, int rows) : rows_{rows}, lowest_(rays.size(), 1) {
  std::vector<std::int32_t> at(rays.size());
  std::iota(at.begin(), at.end(), 0);
  for (int ring = rows - rows_between_merges; ring > 0; ring -= rows_between_merges) {
    const Merging merging(rays, at);
    if (!merging.any()) return;
    std::vector<std::int32_t> stay;
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (merging.goes(i))
        lowest_[at[i]] = ring + 1;
      else
        stay.push_back(at[i]);
    }
    at = std::move(stay);
  }
}

std::vector<std::int32_t> FanRows::rays_at(int ring) const {
  std::vector<std::int32_t> rays;
  for (std::int32_t ray = 0; ray < static_cast<std::int32_t>(lowest_.size()); ++ray) {
    if (lowest_[ray] <= ring) rays.push_back(ray);
  }
  return rays;
}

std::vector<FanRows::Cell> FanRows::cells_after(std::int32_t ray) const {
  std::vector<Cell> cells;
  for (int ring = lowest_[ray]; ring <= rows_; ++ring) {
    const std::vector<std::int32_t> rays = rays_at(ring);
    const auto at = std::find(rays.begin(), rays.end(), ray);
    if (at + 1 == rays.end()) continue;
    const std::int32_t next = at[1];
    const auto stops = [&](std::int32_t which) { return lowest_[which] == ring && ring > 1; };
    const bool begins = stops(ray), ends = stops(next);
    if (ring == 1) {
      cells.push_back({{ray, 0}, {next, 1}, {ray, 1}});
    } else if (begins && ends) {
      continue;         // the middle one of three sectors that merge
    } else if (ends) {  // the next ray ends here: the sectors beside it are merged below
      cells.push_back({{ray, ring - 1}, {next, ring}, {ray, ring}});
      if (stops(at[2]))
        cells.push_back({{ray, ring - 1}, {at[3], ring - 1}, {at[2], ring}, {next, ring}});
      else
        cells.push_back({{ray, ring - 1}, {at[2], ring - 1}, {next, ring}});
    } else if (begins) {
      cells.push_back({{next, ring - 1}, {next, ring}, {ray, ring}});
    } else {
      cells.push_back({{ray, ring - 1}, {next, ring - 1}, {next, ring}, {ray, ring}});
    }
  }
  return cells;
}

}  // namespace quadloop
