#include "generate/refine_front.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "generate/leaf_quadrant.hpp"
#include "mesher/base/log.hpp"
#include "mesher/layers/unsound_strips.hpp"

namespace quadloop {

namespace {

constexpr int most_levels = 2;

/// Returns the split of the quadtree cell of level `level` at the point.
SplitDemand split_at(const TreeGrid& grid, Point p, int level) {
  const std::int64_t size = Quadrant{0, 0, level}.size();
  const std::int64_t column = grid.column_at(p.x), row = grid.row_at(p.y);
  return {{column - column % size, row - row % size, level}, 1U << level};
}

/// Returns the number of levels after which cells are half as long as the distance between stations.
int levels_for(const LayerFront& front, std::int32_t station, double edge) {
  double least = edge;
  for (const std::int32_t other : {front.line.previous(station), front.line.next(station)}) {
    if (other != WallLine::none) least = std::min(least, length(front.points[other] - front.points[station]));
  }
  int levels = 1;
  for (edge /= 2; levels < most_levels && edge > least / 2; edge /= 2) ++levels;
  return levels;
}

}  // namespace

bool refine_front(const Communicator& comm, const TreeGrid& grid, const MeshResult& outside,
                  LayerFront& front, DemandedSplits& splits) {
  const std::vector<UnsoundStrip> strips = unsound_strips(comm, front, outside.mesh, outside.edge_leaves);
  const std::int64_t count = comm.sum(std::ssize(strips));
  if (count == 0) return false;
  log::detail(fmt::format(
      "{} edges are too long for the columns of layers below them; the mesh is made again", count));
  std::vector<SplitDemand> demands;
  std::vector<std::int32_t> kept;
  for (const UnsoundStrip& strip : strips) {
    const int level = outside.tree.leaves[strip.leaf].level;
    const Point middle = 0.5 * (outside.mesh.point(strip.edge[0]) + outside.mesh.point(strip.edge[1]));
    if (strip.stations.empty()) demands.push_back(split_at(grid, middle, level));
    for (const std::int32_t station : strip.stations) {
      const int levels = levels_for(front, station, grid.edge(level));
      for (int deeper = 0; deeper < levels; ++deeper)
        demands.push_back(split_at(grid, front.points[station], level + deeper));
      kept.push_back(station);
    }
  }
  front.keep(comm.all_gather_values(std::span<const std::int32_t>(kept)));
  splits = DemandedSplits(comm, demands, splits);
  return true;
}

std::vector<GlobalNodeId> unsound_nodes(const Communicator& comm, const LayerFront& front,
                                        const MeshResult& outside) {
  std::vector<GlobalNodeId> nodes;
  for (const UnsoundStrip& strip : unsound_strips(comm, front, outside.mesh, outside.edge_leaves)) {
    for (const NodeId node : strip.edge) nodes.push_back(outside.mesh.global(node));
  }
  return comm.all_gather_values(std::span<const GlobalNodeId>(nodes));
}

void forget_splits(const DemandedSplits& adapted, TreeRecord& tree) {
  DemandPath demands(adapted);
  for (LeafRecord& leaf : tree.leaves) leaf.adapted = demands.levels_above(quadrant_of(leaf));
}

}  // namespace quadloop
