#include "mesher/build/cell_demands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace quadloop {

namespace {

constexpr std::size_t most_of_a_kind =
    16;  // maximum number of boundary spacings and of sources considered, the smallest ones

double longer_side(const Geometry& geometry) {
  return std::max(geometry.box().width(), geometry.box().height());
}

void add_spacing(const SizeSettings& settings, double side, std::vector<CellDemand>& demands) {
  demands.push_back({"spacing.max",
                     settings.size.max,
                     side,
                     true,
                     [](SizeSettings& s, double value) { s.size.max = std::max(value, s.size.min); },
                     {}});
  if (settings.size.curvature) {
    demands.push_back({"spacing.curvature",
                       *settings.size.curvature,
                       180,
                       true,
                       [](SizeSettings& s, double value) { s.size.curvature = value; },
                       {}});
  }
  if (settings.size.gap) {
    demands.push_back({"spacing.gap",
                       *settings.size.gap,
                       0,
                       false,
                       [](SizeSettings& s, double value) { s.size.gap = value; },
                       {}});
  }
}

void add_boundaries(const SizeSettings& settings, double side, std::vector<CellDemand>& demands) {
  std::map<double, std::vector<std::size_t>> by_spacing;
  for (std::size_t b = 0; b < settings.boundaries.size(); ++b) {
    if (settings.boundaries[b].spacing > 0) by_spacing[settings.boundaries[b].spacing].push_back(b);
  }
  std::size_t added = 0;
  for (const auto& [spacing, of_it] : by_spacing) {
    if (added++ == most_of_a_kind) return;
    std::string key = "boundary." + settings.boundaries[of_it.front()].name + ".spacing";
    if (of_it.size() > 1) key += fmt::format(" (and {} more)", of_it.size() - 1);
    demands.push_back({key,
                       spacing,
                       side,
                       true,
                       [members = of_it](SizeSettings& s, double value) {
                         for (const std::size_t b : members) s.boundaries[b].spacing = value;
                       },
                       {}});
  }
}

void add_sources(const SizeSettings& settings, double side, std::vector<CellDemand>& demands) {
  std::vector<std::size_t> order(settings.size.sources.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto& sources = settings.size.sources;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sources[a].spacing < sources[b].spacing; });
  order.resize(std::min(order.size(), most_of_a_kind));
  for (const std::size_t i : order) {
    const std::string key =
        "spacing of the [[source]]" + (sources[i].where.empty() ? "" : " at " + sources[i].where);
    demands.push_back({key,
                       sources[i].spacing,
                       side,
                       true,
                       [i](SizeSettings& s, double value) { s.size.sources[i].spacing = value; },
                       {}});
  }
}

/// Adds the size of the smallest leaves, which is responsible if a boundary uses the spacing of its own
/// points.
void add_smallest(const SizeSettings& settings, double side, std::vector<CellDemand>& demands) {
  const auto set = [](SizeSettings& s, double value) {
    s.size.min = value;
    s.size.max = std::max(s.size.max, value);
  };
  const auto lift = [side](SizeSettings& s) {
    for (Boundary& boundary : s.boundaries) {
      if (boundary.spacing == 0) boundary.spacing = side;
    }
  };
  demands.push_back({"spacing.min", settings.size.min, side, true, set, lift});
}

}  // namespace

std::vector<CellDemand> cell_demands(const SizeSettings& settings, const Geometry& geometry) {
  std::vector<CellDemand> demands;
  const double side = longer_side(geometry);
  add_spacing(settings, side, demands);
  add_boundaries(settings, side, demands);
  add_sources(settings, side, demands);
  for (CellDemand& demand : demands)
    demand.lift = [set = demand.set, loosest = demand.loosest](SizeSettings& s) { set(s, loosest); };
  add_smallest(settings, side, demands);
  return demands;
}

Geometry with_boundaries(const Geometry& geometry, const std::vector<Boundary>& boundaries) {
  std::vector<std::int32_t> starts;
  for (std::int32_t loop = 0; loop <= geometry.loop_count(); ++loop)
    starts.push_back(geometry.loop_start(loop));
  std::vector<BoundaryId> of_segment;
  for (std::int32_t s = 0; s < geometry.size(); ++s) of_segment.push_back(geometry.boundary_of(s));
  return {boundaries,
          {geometry.points().begin(), geometry.points().end()},
          std::move(starts),
          std::move(of_segment)};
}

}  // namespace quadloop
