#include "adapt/remesh/morphed_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/generate/digests.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/scatter_mesh.hpp"

namespace quadloop {

namespace {

/// The first fault of a distributed mesh; empty where there is none. *Collective.*
std::string first_fault(const Communicator& comm, const Mesh& mesh) {
  const Mesh whole = gather_whole(comm, mesh);
  std::vector<char> said;
  if (comm.is_root()) {
    const std::vector<MeshFault> faults = validate(whole);
    if (!faults.empty()) said.assign(faults.front().what.begin(), faults.front().what.end());
  }
  comm.broadcast(said);
  return {said.begin(), said.end()};
}

/// What a mesh that is made anew would tell of itself. *Collective.*
MeshReport report_of(const Communicator& comm, const TreeRecord& tree) {
  MeshReport report;
  int coarsest = std::numeric_limits<std::int8_t>::max(), finest = 0;
  for (const LeafRecord& leaf : tree.leaves) {
    coarsest = std::min<int>(coarsest, leaf.level);
    finest = std::max<int>(finest, leaf.level);
  }
  report.leaves = comm.sum(std::ssize(tree.leaves));
  report.coarsest_level = static_cast<int>(comm.minimum(std::int64_t{coarsest}));
  report.finest_level = static_cast<int>(comm.maximum(std::int64_t{finest}));
  report.finest_allowed = report.finest_level;
  report.estimate.cells = static_cast<double>(tree.attributes.triangles + tree.attributes.quads);
  return report;
}

}  // namespace

MorphedMesh morph_solved(const Communicator& comm, const MeshInput& input, const SolvedMesh& old,
                         double least_quality, const std::string& file) {
  if (input.geometry.digest() == old.tree.attributes.geometry_digest) return {};
  StageTimes times;
  times.begin("morph");
  Mesh mesh = old.mesh;
  MorphReport report;
  try {
    report = morph_mesh(comm, mesh, {input.geometry, file});
  } catch (const InputError& error) {
    return {{}, error.what()};
  }
  if (!report.valid())
    return {{},
            fmt::format("near ({:g}, {:g}) some cells turn over after {:.0f} % of the way",
                        report.worst_place.x, report.worst_place.y, 100 * report.possible_way)};
  if (report.worst_after < least_quality)
    return {{}, fmt::format("the worst cell's quality fell to {:.3f}", report.worst_after)};
  if (const std::string fault = first_fault(comm, mesh); !fault.empty()) return {{}, fault};
  times.end();
  CarriedMesh carried;
  carried.generated.result.tree = old.tree;
  TreeAttributes& tree = carried.generated.result.tree.attributes;
  tree.geometry_digest = input.geometry.digest();
  tree.coordinate_digest = coordinate_digest(comm, mesh);
  carried.generated.result.report = report_of(comm, old.tree);
  carried.generated.result.mesh = std::move(mesh);
  carried.start = old.solution;
  carried.report.drift.assign(old.solution.width() + old.solution.cells.width(), 0);
  carried.report.relative_drift = carried.report.drift;
  carried.times = std::move(times);
  carried.morphed = true;
  return {std::move(carried), {}};
}

}  // namespace quadloop
