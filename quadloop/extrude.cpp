#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "mesher/base/error.hpp"
#include "quadloop/quadloop.hpp"
#include "quadloop/require_input.hpp"

namespace quadloop {

namespace {

/// Removes the boundaries between blocks, which are no patches, unless the format has a zone for each block.
/// Returns a line on what is lost. *Collective.*
std::vector<std::string> remove_interfaces(const Communicator& comm, Mesh& mesh, const std::string& path) {
  if (const io::FileFormat* format = io::format_of(path); format != nullptr && format->has_zones) return {};
  std::int64_t dropped = 0;
  for (const BoundaryEdges& boundary : mesh.boundaries)
    dropped += boundary.between_blocks ? std::ssize(boundary.edges) : 0;
  std::erase_if(mesh.boundaries, [](const BoundaryEdges& boundary) { return boundary.between_blocks; });
  dropped = comm.sum(dropped);
  if (dropped == 0) return {};
  return {fmt::format("{}: the {} edges between two blocks are no patch", path, dropped)};
}

}  // namespace

void require_heights(const std::vector<double>& heights, const std::string& source) {
  constexpr double least = 1e-100, most = 1e100;
  if (heights.size() < 2)
    throw InputError(
        fmt::format("{}: {} heights; extrusion needs two levels or more", source, heights.size()));
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (!(std::abs(heights[i]) <= most))
      throw InputError(fmt::format("{}: the level at {} is out of range; heights reach to {:g} at most",
                                   source, heights[i], most));
    if (i == 0) continue;
    if (!(heights[i] > heights[i - 1]))
      throw InputError(fmt::format("{}: the level at {} does not lie above the one before it, at {}", source,
                                   heights[i], heights[i - 1]));
    if (heights[i] - heights[i - 1] < least)
      throw InputError(
          fmt::format("{}: the layer from {} to {} is out of range; layers are {:g} thick at least", source,
                      heights[i - 1], heights[i], least));
  }
}

std::vector<std::string> extrude(const Communicator& comm, Mesh mesh, const std::vector<double>& heights,
                                 const std::string& path, const Field& solution, ExtrusionAxis axis) {
  io::require_mesh3d_suffix(path);
  require_rows(comm, mesh, solution);
  comm.together([&] { require_heights(heights, "heights"); });
  std::vector<std::string> warnings = remove_interfaces(comm, mesh, path);
  io::ExtrudedMesh extruded = io::extruded(mesh, heights, axis, solution.empty() ? nullptr : &solution);
  if (mesh.blocks.names.size() > 1) extruded.blocks = &mesh.blocks;
  for (std::string& loss : io::losses_in(extruded, path)) warnings.push_back(std::move(loss));
  io::OutputSet outputs(comm);
  io::write_mesh(outputs, extruded, path);
  outputs.commit();
  return warnings;
}

}  // namespace quadloop
