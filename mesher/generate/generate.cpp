#include "mesher/generate/generate.hpp"

#include <fmt/format.h>

#include <numeric>

#include "mesher/base/log.hpp"
#include "mesher/build/outline_losses.hpp"
#include "mesher/build/split_quads.hpp"
#include "mesher/cut/lattice_rank.hpp"
#include "mesher/generate/digests.hpp"
#include "smoother/smooth_mesh.hpp"

namespace quadloop {

namespace {

/// A leaf has the triangles that stand in the slots of its own before.
void count_triangles(const std::vector<std::int32_t>& standing, std::vector<LeafRecord>& leaves) {
  auto slot = standing.begin();
  for (LeafRecord& leaf : leaves) {
    const auto end = slot + leaf.triangles;
    leaf.triangles = std::accumulate(slot, end, std::int32_t{0});
    leaf.block = leaf.triangles + leaf.quads > 0 ? 1 : 0;
    slot = end;
  }
}

/// Moved nodes leave some parallelograms skew; those are divided too. *Collective.*
void keep_parallelograms(const Communicator& comm, const std::function<TieRank(Point)>& rank,
                         MeshResult& result) {
  split_skew_quads(result.mesh, result.tree.leaves, rank);
  result.tree.attributes.triangles = comm.sum(std::ssize(result.mesh.triangles));
  result.tree.attributes.quads = comm.sum(std::ssize(result.mesh.quads));
}

void smooth(const Communicator& comm, const MeshInput& input, MeshResult& result) {
  SmoothOptions options = input.smooth;
  if (options.sweeps == 0) return;
  options.geometry = &input.geometry;
  const Lattice lattice = choose_root(input.geometry, input.mesh.size.root);
  const auto rank = [&lattice, finest = result.report.finest_allowed](Point p) {
    return tie_rank(lattice, finest, p);
  };
  const bool parallel = input.mesh.type == MeshType::hybrid && input.mesh.quads == QuadChoice::parallel;
  if (input.mesh.type == MeshType::delaunay) options.delaunay = rank;
  if (parallel) options = sparing_parallelograms(options);
  options.keep_slots = input.mesh.type != MeshType::delaunay;
  const SmoothReport report = smooth_mesh(comm, result.mesh, options);
  if (!report.standing.empty()) count_triangles(report.standing, result.tree.leaves);
  if (parallel) keep_parallelograms(comm, rank, result);
  log::detail(fmt::format("smoothed: {} moves of {} nodes in {} sweeps; largest cost {:.4f}, before {:.4f}",
                          report.moves, report.free_nodes, report.sweeps, report.worst_cost_after,
                          report.worst_cost_before));
}

}  // namespace

GeneratedMesh generate_mesh(const Communicator& comm, const MeshInput& input,
                            const DemandedSplits& demanded) {
  GeneratedMesh generated{build_mesh(comm, input.geometry, input.mesh, demanded), {}};
  MeshResult& result = generated.result;
  generated.times.append(result.report.times);
  require_area(comm, input.geometry, result.report.area_dropped, result.mesh);
  generated.times.begin("smooth");
  smooth(comm, input, result);
  generated.times.end();
  require_area(comm, input.geometry, result.report.area_dropped, result.mesh, true);
  result.tree.attributes.case_digest = input.digest;
  result.tree.attributes.coordinate_digest = coordinate_digest(comm, result.mesh);
  return generated;
}

}  // namespace quadloop
