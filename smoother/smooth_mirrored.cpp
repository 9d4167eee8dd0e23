#include "smoother/smooth_mirrored.hpp"

#include <algorithm>
#include <string>

#include "smoother/mirror/half_mesh.hpp"

namespace quadloop::smoother {

namespace {

/// A name that no boundary of mesh or geometry has, the same on all ranks. As the geometry lacks it, nodes
/// slide along the straight mesh boundary.
std::string name_of_axis(const Mesh& mesh, const Geometry* geometry) {
  std::string name = "mirror axis";
  const auto has_name = [&](const auto& boundary) { return boundary.name == name; };
  while (std::ranges::any_of(mesh.boundaries, has_name) ||
         (geometry != nullptr && std::ranges::any_of(geometry->boundaries(), has_name)))
    name += '+';
  return name;
}

}  // namespace

SmoothReport smooth_mirrored(
    const Communicator& comm, Mesh& mesh, const SmoothOptions& options,
    const std::function<SmoothReport(Mesh& half, const SmoothOptions& options)>& smooth_half) {
  const bool flips = options.delaunay != nullptr;
  HalfMesh half(comm, mesh, *options.mirror, name_of_axis(mesh, options.geometry), flips);
  SmoothOptions of_half = options;
  of_half.mirror.reset();
  of_half.pinned = half.pinned(options.pinned);
  of_half.triangle_to_block = half.of_triangles(options.triangle_to_block);
  of_half.targets = half.of_cells(options.targets);
  SmoothReport report = smooth_half(half.mesh(), of_half);
  const std::vector<std::int32_t> standing = half.reflect(report.standing, mesh);
  if (!options.keep_slots) report.standing = standing;
  return report;
}

}  // namespace quadloop::smoother
