#include "adapt/remesh/followed_walls.hpp"

#include <fmt/format.h>

#include <cmath>

#include "adapt/remesh/boundary_layer/measured_thickness.hpp"
#include "adapt/remesh/demands/mirrored_leaves.hpp"
#include "generate/outside_layers.hpp"
#include "mesher/layers/front/values_along_wall.hpp"

namespace quadloop::adapt {

MeasuredWall wall_to_follow(const Communicator& comm, const MeshInput& input, const AdaptOptions& options,
                            const SolvedMesh& solved) {
  if (!options.wall_flow || !wants_y_plus(input.geometry)) return {};
  std::vector<std::string> walls;
  for (const Boundary& boundary : input.geometry.boundaries()) {
    if (boundary.layers && boundary.layers->y_plus > 0) walls.push_back(boundary.name);
  }
  MeasuredWall measured =
      measured_friction(comm, solved.mesh, solved.solution, walls, *options.wall_flow, solved.file);
  if (input.mesh.mirror) agree_with_images(*input.mesh.mirror, measured);
  return measured.empty() ? solved.tree.measured.walls : measured;
}

namespace {

/// Where the flow does not tell the thickness, that which the last mesh was made with.
void keep_unknown(const std::vector<MeasuredThickness>& last, std::vector<MeasuredThickness>& thickness) {
  const ValuesAlongWall<MeasuredThickness> known(last);
  for (MeasuredThickness& edge : thickness) {
    if (edge.at_from > 0) continue;
    const Point along = edge.to - edge.from;
    const auto at = [&](Point place) {
      return known.at(place, along, along, &MeasuredThickness::at_from, &MeasuredThickness::at_to)
          .value_or(0);
    };
    const double from = at(edge.from), to = at(edge.to);
    if (from > 0 && to > 0) edge.at_from = from, edge.at_to = to;
  }
}

}  // namespace

std::vector<MeasuredThickness> thickness_to_follow(const Communicator& comm, const MeshInput& input,
                                                   const SolvedMesh& solved,
                                                   std::vector<std::string>& warnings) {
  if (!wants_thickness_of_flow(input.geometry)) return {};
  if (!has_velocity(solved.solution)) {
    warnings.push_back(
        fmt::format("{}the solution has no variables x_velocity and y_velocity at nodes, from "
                    "which thickness = \"flow\" follows; the layers keep their thickness",
                    solved.file.empty() ? "" : solved.file + ": "));
    return solved.tree.measured.thickness;
  }
  std::vector<MeasuredThickness> measured = measured_thickness(comm, input.geometry, solved);
  if (input.mesh.mirror) agree_with_images(*input.mesh.mirror, measured);
  keep_unknown(solved.tree.measured.thickness, measured);
  return measured;
}

bool other_heights(const MeshInput& input, const MeasuredFlow& before, const MeasuredFlow& now) {
  constexpr double much = 0.05, much_thickness = 0.1;
  if (before.walls == now.walls && before.thickness == now.thickness) return false;
  const WallLine old_line = wall_line(input.geometry, input.lines, before),
                 new_line = wall_line(input.geometry, input.lines, now);
  for (std::int32_t i = 0; i < new_line.size(); ++i) {
    const LayerSpec &old_layers = old_line.spec(i), &new_layers = new_line.spec(i);
    if (std::abs(new_layers.first - old_layers.first) > much * old_layers.first) return true;
    const double thickness = layers_thickness(old_layers);
    if (new_layers.follows_flow &&
        std::abs(layers_thickness(new_layers) - thickness) > much_thickness * thickness)
      return true;
  }
  return false;
}

}  // namespace quadloop::adapt
