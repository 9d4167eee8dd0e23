#include "mesher/geometry/halved_curves.hpp"

#include <utility>

namespace quadloop {

Geometry with_halved_curves(const Geometry& g, const std::vector<char>& flagged) {
  GeometryBuilder builder;
  LocalDemands demands;
  const auto add = [&](const CurvedSegment& segment, std::int32_t s) {
    builder.add(segment.from, g.boundary_of(s), segment.curve, g.returns(s));
    demands.spacing.push_back(g.spacing_of(s));
    demands.kept.push_back(0);
    demands.bend_degrees.push_back(0);
  };
  for (std::int32_t loop = 0; loop < g.loop_count(); ++loop) {
    for (std::int32_t s = g.loop_start(loop); s < g.loop_start(loop + 1); ++s) {
      const bool halved = flagged[s] != 0 && g.is_curved(s);
      const auto [first, second] = halved ? halves(g.segment(s)) : std::pair(g.segment(s), CurvedSegment{});
      add(first, s);
      demands.kept.back() = g.kept(s) ? 1 : 0;
      demands.bend_degrees.back() = g.bend_degrees(s);
      if (halved) add(second, s);
    }
    builder.end_loop(g.block_of(g.loop_start(loop)));
  }
  return std::move(builder).geometry(g.boundaries(), g.block_names()).with(std::move(demands));
}

}  // namespace quadloop
