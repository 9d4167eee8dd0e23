#include "mesher/mesh/build_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesher/base/error.hpp"
#include "mesher/forest/refine_forest.hpp"
#include "mesher/mesh/assemble_mesh.hpp"
#include "mesher/mesh/islands.hpp"
#include "mesher/mesh/make_delaunay.hpp"
#include "mesher/mesh/outline_losses.hpp"

namespace quadloop {

namespace {

void report_tree(const Communicator& comm, const LeafGraph& graph, const CutForest& cut, MeshReport& report) {
  std::int64_t coarsest = Quadrant::unit_level, finest = 0;
  for (std::int32_t leaf = graph.local_begin(); leaf < graph.local_end(); ++leaf) {
    coarsest = std::min<std::int64_t>(coarsest, graph.leaf(leaf).level);
    finest = std::max<std::int64_t>(finest, graph.leaf(leaf).level);
  }
  const auto leaves = static_cast<std::int64_t>(cut.states.size());
  const auto cut_leaves = static_cast<std::int64_t>(std::count(cut.states.begin(), cut.states.end(), CutForest::State::cut));
  report.leaves = comm.sum(leaves);
  report.cut_leaves = comm.sum(cut_leaves);
  report.coarsest_level = static_cast<int>(comm.minimum(coarsest));
  report.finest_level = static_cast<int>(comm.maximum(finest));
  const std::int64_t work = weight_uncut * leaves + (weight_cut - weight_uncut) * cut_leaves;
  report.imbalance = static_cast<double>(comm.maximum(work)) * comm.size() / static_cast<double>(comm.sum(work));
}

void describe_tree(const Communicator& comm, const Geometry& geometry, const Lattice& lattice, const MeshOptions& options, MeshResult& result) {
  TreeAttributes& a = result.tree.attributes;
  a.root_x = lattice.box().low.x;
  a.root_y = lattice.box().low.y;
  a.tree_edge = lattice.tree_edge();
  a.trees_x = lattice.trees_x();
  a.trees_y = lattice.trees_y();
  a.gradation = options.size.gradation;
  a.geometry_digest = geometry.digest();
  a.nodes = comm.sum(result.mesh.owned_nodes);
  a.triangles = comm.sum(static_cast<std::int64_t>(result.mesh.triangles.size()));
  a.quads = comm.sum(static_cast<std::int64_t>(result.mesh.quads.size()));
}

}  // namespace

MeshResult build_mesh(const Communicator& comm, const Geometry& given, const MeshOptions& options, const DemandedSplits& demanded) {
  MeshResult result;
  StageTimes& times = result.report.times;
  times.begin("geometry");
  const Geometry geometry = without_small_islands(given, options.size.min, result.report);
  if (!options.may_vanish && !result.report.boundaries_vanished.empty()) {
    refuse_vanished(given, result.report.boundaries_vanished, fmt::format("is smaller than spacing.min = {}", options.size.min));
  }
  const Lattice lattice = choose_root(geometry, options.size.root);
  const ShiftedOutline outline(geometry);
  const InsideTest inside(outline);
  ResolutionTest resolution(lattice, outline, inside);
  SizeTree sizes(
      outline, lattice, options.size, [&](const Quadrant& q, std::span<const std::int32_t> segments) { return resolution.unresolved(q, segments); },
      demanded);
  result.report.finest_allowed = sizes.finest_level();

  times.begin("refinement");
  const LeafGraph graph = refine_forest(comm, sizes);

  times.begin("cutting");
  const CutForest cut = cut_forest(comm, graph, sizes, outline, inside, options.snap);

  times.begin("mesh");
  assemble_mesh(comm, geometry, sizes, graph, cut, result);
  report_losses(comm, geometry, result.mesh, options.may_vanish, result.report);

  if (options.type == MeshType::delaunay) {
    times.begin("delaunay");
    make_delaunay(comm, lattice, sizes.finest_level(), graph, cut, result.mesh, result.tree.leaves);
  }
  times.end();

  report_tree(comm, graph, cut, result.report);
  describe_tree(comm, geometry, lattice, options, result);
  return result;
}

}  // namespace quadloop
