#include "mesher/layers/fan_rows.hpp"

#include <algorithm>

namespace quadloop {

namespace {

constexpr double least_sector = 22;  // degrees, on the mean
constexpr int rows_between_merges = 3;

/// Of rays those that stay when sectors are merged in pairs, from both ends, so that a mirror image merges
/// the same; an odd sector stays in the middle.
std::vector<std::int32_t> merged(const std::vector<std::int32_t>& rays) {
  const auto sectors = static_cast<std::int32_t>(rays.size()) - 1;
  std::int32_t from_each_end = sectors / 4;  // pairs
  std::vector<std::int32_t> kept;
  for (std::int32_t i = 0; i <= sectors; ++i) {
    const std::int32_t end = std::min(i, sectors - i);
    const bool in_pair = end < 2 * from_each_end && end % 2 == 1;
    const bool in_the_middle = sectors % 4 == 2 && 2 * i == sectors;
    if (!in_pair && !in_the_middle) kept.push_back(rays[i]);
  }
  return kept;
}

}  // namespace

FanRows::FanRows(std::int32_t rays, int rows, double turn_degrees) : rows_{rows}, lowest_(rays, 1) {
  std::vector<std::int32_t> at(rays);
  for (std::int32_t i = 0; i < rays; ++i) at[i] = i;
  for (int ring = rows - rows_between_merges; ring > 0; ring -= rows_between_merges) {
    if (turn_degrees / static_cast<double>(at.size() - 1) >= least_sector) return;
    const std::vector<std::int32_t> kept = merged(at);
    for (const std::int32_t ray : at) {
      if (!std::binary_search(kept.begin(), kept.end(), ray)) lowest_[ray] = ring + 1;
    }
    at = kept;
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
    const bool begins = lowest_[ray] == ring && ring > 1, ends = lowest_[next] == ring && ring > 1;
    if (ring == 1) {
      cells.push_back({{ray, 0}, {next, 1}, {ray, 1}});
    } else if (ends) {  // the next ray ends here: the two sectors become one below
      cells.push_back({{ray, ring - 1}, {next, ring}, {ray, ring}});
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
