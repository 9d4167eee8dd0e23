#include "tests/layers/walls.hpp"

#include <map>

namespace quadloop::test {

Geometry outline_of(const std::vector<std::vector<Side>>& loops, double spacing) {
  std::vector<Boundary> boundaries;
  std::map<std::string, BoundaryId> ids;
  std::vector<Point> points;
  std::vector<std::int32_t> starts{0};
  std::vector<BoundaryId> of_segment;
  for (const auto& loop : loops) {
    for (const Side& side : loop) {
      const auto [at, is_new] = ids.emplace(side.name, BoundaryId{size32(boundaries)});
      if (is_new) boundaries.push_back({side.name, spacing, 30, "wall"});
      if (side.layers) boundaries[at->second.value()].layers = side.layers;
      points.insert(points.end(), side.points.begin(), side.points.end());
      of_segment.insert(of_segment.end(), side.points.size(), at->second);
    }
    starts.push_back(size32(points));
  }
  return {boundaries, points, starts, of_segment};
}

LayerSpec equal_layers(double thickness, int count) { return {thickness / count, 1, 1, count}; }

Geometry floor_with_layers(const LayerSpec& layers) {
  return outline_of({{{"floor", {{0, 0}}, layers}, {"rest", {{8, 0}, {8, 4}, {0, 4}}}}});
}

Geometry step_with_layers(const LayerSpec& layers) {
  return outline_of({{{"floor", {{0, 0}, {4, 0}, {4, 2}}, layers}, {"rest", {{8, 2}, {8, 6}, {0, 6}}}}});
}

Geometry arch_and_step_with_layers(const LayerSpec& layers) {
  const Geometry g = step_with_layers(layers);
  std::vector<BoundaryId> of_segment;
  for (std::int32_t s = 0; s < g.size(); ++s) of_segment.push_back(g.boundary_of(s));
  std::vector<Curve> curves(g.size());
  curves[0].inner = {{2, 0.8}};
  return {{g.boundaries().begin(), g.boundaries().end()},
          {g.points().begin(), g.points().end()},
          {0, g.size()},
          of_segment,
          curves};
}

Geometry rhombus_with_layers(const LayerSpec& layers, double half_height) {
  return outline_of({{{"box", {{-8, -8}, {8, -8}, {8, 8}, {-8, 8}}}},
                     {{"body", {{-2, 0}, {0, half_height}, {2, 0}, {0, -half_height}}, layers}}});
}

Geometry mirrored(const Geometry& g) {
  std::vector<Point> points;
  std::vector<std::int32_t> starts{0};
  std::vector<BoundaryId> of_segment;
  std::vector<Curve> curves;
  for (std::int32_t loop = 0; loop < g.loop_count(); ++loop) {
    for (std::int32_t v = g.loop_start(loop + 1) - 1; v >= g.loop_start(loop); --v) {
      points.push_back({g.point(v).x, -g.point(v).y});
      of_segment.push_back(g.boundary_of(g.previous(v)));
      curves.push_back(reversed(g.curve(g.previous(v))));
      for (Point& p : curves.back().inner) p.y = -p.y;
    }
    starts.push_back(size32(points));
  }
  return {{g.boundaries().begin(), g.boundaries().end()}, points, starts, of_segment, curves};
}

}  // namespace quadloop::test
