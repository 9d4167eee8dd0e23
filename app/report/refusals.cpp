#include "app/report/refusals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/model/distribute.hpp"
#include "io/model/tidy_mesh.hpp"
#include "mesher/base/counted.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/check/surely_valid.hpp"
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

/// Calls `refuse(whole mesh, faults)` on the root if a distributed mesh has faults: it is gathered to name
/// them, unless it is certainly valid. *Collective.*
template <class Refuse>
void if_not_valid(const Communicator& comm, const io::LoadedMesh& loaded, const Refuse& refuse) {
  if (loaded.blocks == 1 && is_surely_valid(comm, loaded.mesh)) return;
  const io::LoadedMesh whole = io::gathered(comm, loaded);
  comm.together([&] {
    if (!comm.is_root()) return;
    const std::vector<MeshFault> faults = validate(whole.mesh, blocks_of(whole));
    if (!faults.empty()) refuse(whole, faults);
  });
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

std::vector<MeshFault> faults_of(const Communicator& comm, const io::LoadedMesh& loaded) {
  std::vector<MeshFault> found;
  if_not_valid(comm, loaded,
               [&](const io::LoadedMesh&, const std::vector<MeshFault>& faults) { found = faults; });
  return found;
}

std::vector<std::string> doubts_about(const Communicator& comm, const io::LoadedMesh& loaded,
                                      const std::string& file) {
  std::vector<std::string> doubts;
  if_not_valid(comm, loaded, [&](const io::LoadedMesh&, const std::vector<MeshFault>& faults) {
    const MeshFault& first = faults.front();
    doubts = {fmt::format("{}: is not valid, and is written unchanged: {}: {} at ({}, {}){}", file,
                          name_of(first.rule), first.what, first.place.x, first.place.y,
                          more_faults(std::ssize(faults) - 1))};
  });
  return broadcast_words(comm, doubts);
}

void repair(const Communicator& comm, io::LoadedMesh& mesh, const std::string& file,
            const std::function<void(const io::LoadedMesh&)>& check) {
  if (mesh.blocks == 1 && is_surely_valid(comm, mesh.mesh)) return;
  io::LoadedMesh whole = io::gathered(comm, mesh);
  comm.together([&] {
    if (!comm.is_root()) return;
    io::tidy_mesh(whole, file);
    check(whole);
  });
  mesh = io::distributed(comm, std::move(whole));
}

void require_sound_topology(const io::LoadedMesh& loaded, const std::string& file) {
  const std::vector<MeshFault> faults = validate_topology(loaded.mesh, blocks_of(loaded));
  if (!faults.empty()) refuse_invalid(file, faults);
}

void require_valid_input(const Communicator& comm, const io::LoadedMesh& loaded, const std::string& file) {
  if_not_valid(comm, loaded, [&](const io::LoadedMesh&, const std::vector<MeshFault>& faults) {
    refuse_invalid(file, faults);
  });
}

void require_valid(const Communicator& comm, const io::LoadedMesh& smoothed, const std::string& file) {
  if_not_valid(comm, smoothed, [&](const io::LoadedMesh& whole, const std::vector<MeshFault>& faults) {
    const auto inverted = std::count_if(faults.begin(), faults.end(), [](const MeshFault& fault) {
      return fault.rule == MeshRule::positive;
    });
    if (inverted == 0) refuse_invalid(file, faults);
    const Point place = worst_place(whole.mesh);
    throw InputError(fmt::format(
        "{}: {} could not be untangled, the worst at ({:.6g}, {:.6g}); nothing was written. Increase "
        "--sweeps, or repair the mesh there: nodes between blocks are fixed, and boundary nodes slide only "
        "along straight parts, or along --geometry",
        file, counted(inverted, "cell"), place.x, place.y));
  });
}

}  // namespace quadloop::app
