#include "adapt/remesh/followed_walls.hpp"

#include <cmath>

#include "adapt/remesh/demands/mirrored_leaves.hpp"
#include "generate/outside_layers.hpp"

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

bool other_heights(const MeshInput& input, const MeasuredWall& before, const MeasuredWall& now) {
  constexpr double much = 0.05;
  if (before == now) return false;
  const WallLine old_line = wall_line(input.geometry, input.lines, {before, {}}),
                 new_line = wall_line(input.geometry, input.lines, {now, {}});
  for (std::int32_t i = 0; i < new_line.size(); ++i) {
    const double old_height = old_line.spec(i).first;
    if (std::abs(new_line.spec(i).first - old_height) > much * old_height) return true;
  }
  return false;
}

}  // namespace quadloop::adapt
