#include "mesher/build/build_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesher/base/error.hpp"
#include "mesher/base/log.hpp"
#include "mesher/base/parallel/free_memory.hpp"
#include "mesher/base/parallel/shared_stage.hpp"
#include "mesher/build/assemble_mesh.hpp"
#include "mesher/build/islands.hpp"
#include "mesher/build/make_delaunay.hpp"
#include "mesher/build/mesh_estimate.hpp"
#include "mesher/build/near_ends.hpp"
#include "mesher/build/outline_losses.hpp"
#include "mesher/build/required_points.hpp"
#include "mesher/build/split_baffles.hpp"
#include "mesher/build/split_quads.hpp"
#include "mesher/cut/grid_rank.hpp"
#include "mesher/forest/refine_forest.hpp"

namespace quadloop {

namespace {

void report_tree(const Communicator& comm, const LeafGraph& graph, const CutForest& cut, MeshReport& report) {
  std::int64_t coarsest = Quadrant::unit_level, finest = 0;
  for (const LeafId leaf : graph.local()) {
    coarsest = std::min<std::int64_t>(coarsest, graph.leaf(leaf).level);
    finest = std::max<std::int64_t>(finest, graph.leaf(leaf).level);
  }
  const auto leaves = std::ssize(cut.states);
  const auto cut_leaves = std::count(cut.states.begin(), cut.states.end(), CutForest::State::cut);
  report.leaves = comm.sum(leaves);
  report.cut_leaves = comm.sum(cut_leaves);
  report.coarsest_level = static_cast<int>(comm.minimum(coarsest));
  report.finest_level = static_cast<int>(comm.maximum(finest));
  const std::int64_t work = weight_uncut * leaves + (weight_cut - weight_uncut) * cut_leaves;
  report.imbalance =
      static_cast<double>(comm.maximum(work)) * comm.size() / static_cast<double>(comm.sum(work));
}

void describe_tree(const Communicator& comm, const Geometry& geometry, const TreeGrid& grid,
                   const MeshOptions& options, MeshResult& result) {
  TreeAttributes& a = result.tree.attributes;
  a.root_x = grid.box().low.x;
  a.root_y = grid.box().low.y;
  a.tree_edge = grid.tree_edge();
  a.trees_x = grid.trees_x();
  a.trees_y = grid.trees_y();
  if (root_box(a).high != grid.box().high) a.root_far = grid.box().high;
  a.gradation = options.size.gradation;
  a.geometry_digest = geometry.digest();
  count_entries(comm, result);
}

/// Reports the size of a large mesh if it is the first of the run; for a very large one also the setting
/// responsible, which may be a mistake.
void tell(const MeshEstimate& estimate, const Geometry& geometry, const MeshOptions& options, int ranks,
          bool first) {
  constexpr double large = 1e6, very_large = 1e7;
  std::string text = "about " + text_of_cells(estimate.cells) + " cells, " +
                     text_of_bytes(total_bytes(estimate, ranks)) + " of memory";
  if (first && estimate.cells >= very_large) {
    if (const std::string cause = cause_of_cells(estimate, geometry, options); !cause.empty())
      text += "; " + cause;
  }
  if (first && estimate.cells >= large)
    log::information(text);
  else
    log::detail(text);
}

}  // namespace

void count_entries(const Communicator& comm, MeshResult& result) {
  TreeAttributes& a = result.tree.attributes;
  a.nodes = comm.sum(result.mesh.owned_nodes);
  a.triangles = comm.sum(std::ssize(result.mesh.triangles));
  a.quads = comm.sum(std::ssize(result.mesh.quads));
}

MeshResult build_mesh(const Communicator& comm, const Geometry& given, const MeshOptions& wanted,
                      const DemandedSplits& demanded) {
  MeshResult result;
  StageTimes& times = result.report.times;
  times.begin("geometry");
  const std::optional<Geometry> fewer = small_islands_dropped(given, wanted.size.min, result.report);
  const Geometry& geometry = fewer ? *fewer : given;
  if (!wanted.may_vanish && !result.report.boundaries_vanished.empty()) {
    refuse_vanished(given, result.report.boundaries_vanished,
                    fmt::format("is smaller than spacing.min = {}", wanted.size.min));
  }
  const MeshOptions options = with_room_for_points(geometry, wanted);
  SizedDomain domain(geometry, options.size, demanded);
  SizeTree& sizes = domain.sizes;
  result.report.regions = regions_of(geometry);
  result.report.finest_allowed = sizes.finest_level();

  times.begin("estimate");
  const LeafEstimate leaves = estimate_leaves(comm, sizes);
  result.report.estimate = estimate_mesh(geometry, options.type, domain, leaves);
  require_within(result.report.estimate, geometry, options, demanded);
  tell(result.report.estimate, geometry, options, comm.size(), demanded.empty());

  times.begin("refinement");
  const LeafGraph graph = refine_forest(comm, sizes, leaves);

  times.begin("cutting");
  CutForest cut = cut_forest(comm, graph, sizes, domain.outline, domain.inside, options.snap, options.mirror,
                             positions_of(options.required_points));

  times.begin("mesh");
  sizes.forget();  // frees the size tree before the mesh is allocated
  return_freed_memory();
  assemble_mesh(comm, geometry, sizes, graph, cut, has_triangles_alone(options.type), result);
  cut.drop_lists();
  report_losses(comm, geometry, result.mesh, options.may_vanish, result.report);
  if (const auto warning = warning_of_near_ends(comm, geometry, result.mesh))
    result.report.warnings.push_back(*warning);

  const auto rank_of = [&](Point p) {
    return tie_rank(domain.grid, sizes.finest_level(), p, options.mirror);
  };
  if (has_triangles_alone(options.type)) {
    times.begin("delaunay");
    const progress::SharedStage stage(comm, "delaunay");
    make_delaunay(comm, domain.grid, rank_of, graph, cut, result.mesh, result.tree.leaves);
  }
  if (options.type == MeshType::hybrid && options.quads == QuadChoice::parallel) {
    split_skew_quads(result.mesh, result.tree.leaves, rank_of);
  }
  split_baffles(comm, geometry, result.mesh);
  times.end();

  report_tree(comm, graph, cut, result.report);
  describe_tree(comm, geometry, domain.grid, options, result);
  return result;
}

}  // namespace quadloop
