#include "app/report/refusals.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesher/base/counted.hpp"
#include "mesher/base/error.hpp"
#include "smoother/objective/condition_number.hpp"

namespace quadloop::app {

namespace {

CellBlocks blocks_of(const io::LoadedMesh& loaded) {
  return {loaded.blocks, loaded.triangle_to_block, loaded.quad_to_block};
}

/// Returns the centre of the cell with the highest cost.
Point worst_place(const Mesh& mesh) {
  double worst = -1;
  Point place;
  const auto look_at = [&]<std::size_t width>(const std::array<NodeId, width>& nodes) {
    std::array<Point, width> corners;
    Point sum;
    for (std::size_t k = 0; k < width; ++k) {
      corners[k] = mesh.point(nodes[k]);
      sum = sum + corners[k];
    }
    const double cost = smoother::cell_cost(corners, smoother::ideal_targets<width>());
    if (cost <= worst) return;
    worst = cost;
    place = 1.0 / size32(nodes) * sum;
  };
  mesh.for_each_cell(look_at);
  return place;
}

}  // namespace

std::string more_faults(std::int64_t count) { return count == 0 ? "" : "; " + counted(count, "more fault"); }

void refuse_invalid(const std::string& file, const std::vector<MeshFault>& faults) {
  const MeshFault& first = faults.front();
  const char* cure = first.rule == MeshRule::geometry
                         ? "; give the geometry that was meshed, as written by `mesh --geometry-out`"
                         : "";
  throw InputError(fmt::format("{}: invalid mesh: {}: {} at ({}, {}){}{}", file, name_of(first.rule),
                               first.what, first.place.x, first.place.y, more_faults(std::ssize(faults) - 1),
                               cure));
}

std::vector<std::string> doubts_about(const io::LoadedMesh& loaded, const std::string& file) {
  const std::vector<MeshFault> faults = validate(loaded.mesh, blocks_of(loaded));
  if (faults.empty()) return {};
  const MeshFault& first = faults.front();
  return {fmt::format("{}: is not valid, and is written unchanged: {}: {} at ({}, {}){}", file,
                      name_of(first.rule), first.what, first.place.x, first.place.y,
                      more_faults(std::ssize(faults) - 1))};
}

void require_sound_topology(const io::LoadedMesh& loaded, const std::string& file) {
  const std::vector<MeshFault> faults = validate_topology(loaded.mesh, blocks_of(loaded));
  if (!faults.empty()) refuse_invalid(file, faults);
}

void require_valid_input(const io::LoadedMesh& loaded, const std::string& file) {
  const std::vector<MeshFault> faults = validate(loaded.mesh, blocks_of(loaded));
  if (!faults.empty()) refuse_invalid(file, faults);
}

void require_valid(const io::LoadedMesh& smoothed, const std::string& file) {
  const std::vector<MeshFault> faults = validate(smoothed.mesh, blocks_of(smoothed));
  if (faults.empty()) return;
  const auto inverted = std::count_if(
      faults.begin(), faults.end(), [](const MeshFault& fault) { return fault.rule == MeshRule::positive; });
  if (inverted == 0) refuse_invalid(file, faults);
  const Point place = worst_place(smoothed.mesh);
  throw InputError(
      fmt::format("{}: {} could not be untangled, the worst at ({:.6g}, {:.6g}); nothing was written. "
                  "Increase --sweeps, or repair the mesh there: nodes between blocks are fixed, and boundary "
                  "nodes slide only along straight parts, or along --geometry",
                  file, counted(inverted, "cell"), place.x, place.y));
}

}  // namespace quadloop::app
