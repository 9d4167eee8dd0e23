#include "mesher/sizes/size_rules.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace quadloop {

namespace {

constexpr double turning_unit = 0x1p-20;  // degrees; integers, so that sums do not depend on their order

}  // namespace

SizeRules::SizeRules(const ShiftedOutline& outline, const TreeGrid& grid, const SizeOptions& options,
                     Unresolved unresolved, const DemandedSplits& demanded)
    : outline_{&outline},
      grid_{&grid},
      options_{options},
      demanded_{&demanded},
      unresolved_{std::move(unresolved)},
      finest_of_case_{grid.finest_level(options.min)},
      finest_{std::max(finest_of_case_, demanded.finest_level())},
      coarsest_{1},
      slope_{std::llround((options.gradation - 1) / 2 * static_cast<double>(1 << slope_bits))} {
  while (coarsest_ < finest_of_case_ && grid.is_larger(coarsest_, options.max)) ++coarsest_;
  const Geometry& g = outline.geometry();
  const auto line_after = [](std::int64_t line, double at, double coordinate) {
    return at < coordinate ? line + 1 : line;
  };
  const std::int64_t right = grid.column_at(g.box().high.x), top = grid.row_at(g.box().high.y);
  domain_ = {grid.column_at(g.box().low.x), line_after(right, grid.x(right), g.box().high.x),
             grid.row_at(g.box().low.y), line_after(top, grid.y(top), g.box().high.y)};
  if (options.gap) proximity_.emplace(g);
  level_of_segment_.reserve(g.size());
  const bool any_corner =
      std::ranges::any_of(g.boundaries(), [](const Boundary& b) { return b.corner_spacing > 0; });
  int level = coarsest_;  // search from the level of the previous segment, which is usually close
  for (std::int32_t s = 0; s < g.size(); ++s) {
    level = level_within(g.spacing_of(s), level);
    level_of_segment_.push_back(static_cast<std::int8_t>(level));
    if (any_corner) corner_spacing_.push_back(g.corner_spacing_of(s));
    if (options.curvature)  // twins turn once
      turning_.push_back(g.is_second(s) ? 0 : std::llround(g.bend_degrees(s) / turning_unit));
  }
}

std::vector<std::int32_t> SizeRules::sized_corners() const {
  std::vector<std::int32_t> vertices;
  for (std::int32_t v = 0; v < std::ssize(corner_spacing_); ++v) {
    if (corner_spacing_[v] > 0) vertices.push_back(v);
  }
  return vertices;
}

SizeRules::Judgement SizeRules::judge(const SizedQuadrant& q) const {
  const bool is_demanded = q.finest_demanded > 0;
  Judgement said{q.segments.empty() && !is_demanded && !q.made_by_demand,
                 std::max(q.segments.empty() ? coarsest_ : finest_of_case_, q.finest_demanded)};
  if (q.made_by_demand) said.finest = std::max(said.finest, q.quadrant.level);
  const auto ask_for = [&](double spacing) {
    said.plain = false;
    said.finest = std::max(said.finest, level_for(spacing));
  };
  for (const SizeSource& source : options_.sources) {
    if (meets(source, q.box)) ask_for(source.spacing);
  }
  for (const std::int32_t vertex : q.corners) ask_for(corner_spacing_[vertex]);
  return said;
}

bool SizeRules::in_domains_box(const Quadrant& q) const {
  return q.x < domain_[1] && domain_[0] < q.x + q.size() && q.y < domain_[3] && domain_[2] < q.y + q.size();
}

std::int64_t SizeRules::gap_to_domain(const Quadrant& q) const {
  return std::max({std::int64_t{0}, domain_[0] - (q.x + q.size()), q.x - domain_[1],
                   domain_[2] - (q.y + q.size()), q.y - domain_[3]});
}

int SizeRules::level_for(double spacing) const {
  int level = coarsest_;
  while (level < finest_of_case_ && grid_->is_larger(level, spacing)) ++level;
  return level;
}

int SizeRules::level_within(double spacing, int from) const {
  int level = from;
  while (level > 0 && !grid_->is_larger(level - 1, spacing)) --level;
  while (level < finest_of_case_ && grid_->is_larger(level, spacing)) ++level;
  return level;
}

int SizeRules::level_of_outline(const Quadrant& q, std::span<const std::int32_t> segments) const {
  int level = coarsest_;
  std::int64_t turning = 0;
  for (const std::int32_t s : segments) {
    level = std::max<int>(level, level_of_segment_[s]);
    if (options_.curvature) turning += turning_[s];
  }
  if (options_.curvature && turning > 0) {
    const double turns = static_cast<double>(turning) * turning_unit / *options_.curvature;
    level = std::max(level, level_for(grid_->edge(q.level) / turns));
  }
  return level;
}

bool SizeRules::wants_split(const SizedQuadrant& sized) const {
  const Quadrant& q = sized.quadrant;
  if (sized.finest_demanded > 0) return true;
  if (q.level >= finest_of_case_) return false;
  const Box& box = sized.box;
  if (q.level < coarsest_ && in_domains_box(q)) return true;
  for (const SizeSource& source : options_.sources) {
    if (grid_->is_larger(q.level, source.spacing) && meets(source, box)) return true;
  }
  const auto too_large_for = [&](std::int32_t vertex) {
    return grid_->is_larger(q.level, corner_spacing_[vertex]);
  };
  if (std::ranges::any_of(sized.corners, too_large_for)) return true;
  const std::span<const std::int32_t> inside = sized.segments;
  if (inside.empty()) return false;
  for (const std::int32_t s : inside) {
    if (q.level < level_of_segment_[s]) return true;
  }
  if (options_.curvature && turns_too_far(inside, box)) return true;
  if (proximity_ && proximity_->narrower(inside, box, *options_.gap * grid_->edge(q.level))) return true;
  return unresolved_(q, inside);
}

bool SizeRules::turns_too_far(std::span<const std::int32_t> segments, const Box& box) const {
  const Geometry& g = outline_->geometry();
  std::vector<std::pair<BoundaryId, std::int64_t>> turned;
  for (const std::int32_t v : segments) {
    if (!outline_->is_in(box, v)) continue;
    const BoundaryId boundary = g.boundary_of(v);
    const auto known = std::find_if(turned.begin(), turned.end(),
                                    [&](const auto& entry) { return entry.first == boundary; });
    if (known == turned.end()) {
      turned.emplace_back(boundary, turning_[v]);
    } else {
      known->second += turning_[v];
    }
  }
  const auto allowed = std::llround(*options_.curvature / turning_unit);
  return std::any_of(turned.begin(), turned.end(), [&](const auto& entry) { return entry.second > allowed; });
}

}  // namespace quadloop
