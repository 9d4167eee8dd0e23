#include "generate/outside_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

#include "mesher/base/error.hpp"
#include "mesher/build/islands.hpp"
#include "mesher/build/mesh_estimate.hpp"
#include "mesher/build/outline_losses.hpp"
#include "mesher/build/required_points.hpp"
#include "mesher/sizes/demanded_sizes.hpp"

namespace quadloop {

bool has_layers(const MeshInput& input) {
  return !input.lines.empty() || std::ranges::any_of(input.geometry.boundaries(),
                                                     [](const Boundary& b) { return b.layers.has_value(); });
}

bool wants_y_plus(const Geometry& geometry) {
  return std::ranges::any_of(geometry.boundaries(),
                             [](const Boundary& b) { return b.layers && b.layers->y_plus > 0; });
}

bool wants_thickness_of_flow(const Geometry& geometry) {
  return std::ranges::any_of(geometry.boundaries(),
                             [](const Boundary& b) { return b.layers && b.layers->follows_flow; });
}

bool wants_streamlines(const MeshInput& input) {
  return std::ranges::any_of(input.lines, &LayerLine::follows_flow) ||
         std::ranges::any_of(input.wakes_without_layers, &LayerLine::follows_flow);
}

Geometry geometry_with_layers(const MeshInput& input, MeshReport& dropped) {
  Geometry kept = without_small_islands(input.geometry, input.mesh.size.min, dropped);
  if (!input.mesh.may_vanish && !dropped.boundaries_vanished.empty()) {
    refuse_vanished(input.geometry, dropped.boundaries_vanished,
                    fmt::format("is smaller than spacing.min = {}", input.mesh.size.min));
  }
  return kept;
}

namespace {

/// Checks the size of the strips before they are built. Their nodes are temporarily stored on every rank.
void require_strips_within(const std::vector<PlacedLine>& lines, const MeshLimit& limit) {
  constexpr double of_cell = 200, of_cell_on_rank = 100;  // bytes
  constexpr double most = std::numeric_limits<std::int32_t>::max() / 4.0;
  for (const PlacedLine& line : lines) {
    const auto [columns, cells] = least_size(line);
    const double bytes = (of_cell + limit.ranks * of_cell_on_rank) * cells;
    if (cells <= std::min(limit.cells, most) && bytes <= limit.bytes) continue;
    const std::string allowed = cells > limit.cells   ? fmt::format("--max-cells allows {:.0f}", limit.cells)
                                : bytes > limit.bytes ? text_of_bytes(limit.bytes) + " are free"
                                                      : "no mesh can have so many";
    throw TooManyCells(
        fmt::format("{}the layers of {} would have at least {} cells in {} columns and need {} of memory, "
                    "but {}; shorten it, or increase its spacing of {:g}",
                    line.place, line.name, text_of_cells(cells), text_of_cells(columns), text_of_bytes(bytes),
                    allowed, line.spacing));
  }
}

}  // namespace

LayerFront front_of(const Communicator& comm, const MeshInput& input, const Geometry& geometry,
                    const MeasuredFlow& measured, const DemandedSplits& demanded) {
  require_strips_within(place_lines(geometry, input.lines, measured.wakes), input.mesh.limit);
  const auto front = [&](const AdaptedSize& adapted) {
    return layer_front(geometry, input.mesh.size.curvature, input.lines, measured,
                       input.mesh.mirror.has_value(), input.mesh.pairs, adapted, &comm);
  };
  if (demanded.empty()) return front({});
  const TreeGrid grid = input.grid();
  const DemandedSizes sizes(grid, demanded, input.mesh.size.gradation);
  return front([&](Point a, Point b, double most) { return sizes.near(a, b, most); });
}

MeshInput outside(const MeshInput& input, const LayerFront& front) {
  MeshInput outer = input;
  outer.geometry = front.outer;
  outer.mesh.required_points = points_outside_layers(input.geometry, front.outer, input.mesh.required_points);
  outer.smooth.front_heights = front.last_heights;
  const TreeGrid grid = input.grid();
  outer.mesh.size.root =
      RootOptions{grid.box().low, grid.tree_edge(), grid.trees_x(), grid.trees_y(), grid.box().high};
  return outer;
}

}  // namespace quadloop
