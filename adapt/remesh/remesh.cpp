#include "adapt/remesh/remesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapt/remesh/demands/mirrored_leaves.hpp"
#include "adapt/remesh/demands/restart.hpp"
#include "mesher/mesh/block_runs.hpp"
#include "mesher/mesh/reorder_mesh.hpp"

namespace quadloop::adapt {

SolvedMesh in_tree_order(const Communicator& comm, Mesh mesh, Field solution, TreeRecord tree) {
  if (tree.block_runs.empty()) {
    mesh.blocks = {};
    return {std::move(mesh), std::move(tree), std::move(solution), {}};
  }
  const ReorderedMesh reordered(comm, mesh, order_by_runs(comm, mesh, tree.block_runs));
  SolvedMesh solved{reordered.mesh(mesh), std::move(tree), reordered.field(solution), {}};
  set_blocks(comm, mesh.blocks.names, solved.tree.block_runs, solved.mesh);
  return solved;
}

std::vector<std::pair<std::string, double>> RemeshedSolution::drifts() const {
  std::vector<std::pair<std::string, double>> named;
  for (std::size_t i = 0; i < start.width(); ++i) named.emplace_back(start.names[i], report.drift[i]);
  for (std::size_t i = 0; i < start.cells.width(); ++i)
    named.emplace_back(
        (std::ranges::count(start.names, start.cells.names[i]) > 0 ? "cell_" : "") + start.cells.names[i],
        report.drift[start.width() + i]);
  return named;
}

namespace {

/// Relative error of a conserved integral that rounding does not exceed.
constexpr double kept_to = 1e-10;

}  // namespace

std::vector<std::string> drift_warnings(const RemeshedSolution& remeshed) {
  const TransferReport& report = remeshed.report;
  const double allowed = std::max(kept_to, 10 * std::abs(report.area_change));
  const auto size = [&](std::size_t k) { return std::abs(report.relative_drift[k]); };
  std::size_t worst = report.conserved_from, count = 0;
  for (std::size_t k = report.conserved_from; k < report.relative_drift.size(); ++k) {
    count += size(k) > allowed ? 1 : 0;
    if (size(k) > size(worst)) worst = k;
  }
  if (count == 0) return {};
  return {fmt::format(
      "the solution transfer changed the integral of {} by {:.2g} of its magnitude{}; it should conserve "
      "integrals to {:g}, except where layers move (docs/explanation/adaptation.md)",
      remeshed.drifts()[worst].first, report.relative_drift[worst],
      count > 1 ? fmt::format(", and those of {} more", count - 1) : "", kept_to)};
}

RemeshedSolution remesh_and_transfer(const Communicator& comm, const MeshInput& input,
                                     const AdaptationPlan& plan, const SolvedMesh& old,
                                     const TransferFunction& by) {
  RemeshedSolution remeshed;
  MeshChange stretch;
  if (const auto* targets = std::get_if<TargetDemand>(&plan.anisotropy)) {
    stretch = [&, targets](const MeshInput& outer, MeshResult& result) {
      move_nodes_to_shocks(comm, outer, old.mesh, old.solution, *targets, result);
    };
  } else if (const auto* metric = std::get_if<MetricDemand>(&plan.anisotropy)) {
    stretch = [&, metric](const MeshInput& outer, MeshResult& result) {
      StretchReport report = stretch_mesh(comm, outer, old.mesh, old.solution, *metric, result);
      result.report.warnings.insert(result.report.warnings.end(), report.warnings.begin(),
                                    report.warnings.end());
      remeshed.stretched = report.statistics;
    };
  }
  remeshed.generated = generate_mesh(comm, input, DemandedSplits(comm, plan.demands), plan.measured, stretch);
  remeshed.times.append(remeshed.generated.times);
  remeshed.times.begin("transfer");
  const Mesh& mesh = remeshed.generated.result.mesh;
  Transferred transferred = by ? transfer_by(comm, old.mesh, old.solution, mesh, by)
                               : transfer(comm, old.mesh, old.solution, mesh, plan.transfer);
  remeshed.start = std::move(transferred.field);
  remeshed.report = std::move(transferred.report);
  for (std::string& warning : drift_warnings(remeshed))
    remeshed.generated.result.report.warnings.push_back(std::move(warning));
  remeshed.times.end();
  return remeshed;
}

AdaptationPlan unchanged_plan(const TreeRecord& tree, const MeshInput& input) {
  AdaptationPlan plan;
  plan.demands = unchanged_splits(tree, input);
  if (input.mesh.mirror)
    plan.demands = with_images(*input.mesh.mirror, tree.attributes, std::move(plan.demands));
  plan.measured = tree.measured;
  if (const char* setting = setting_that_follows(input))
    plan.warnings.push_back(
        fmt::format("{} has no effect without a table [adapt]: the mesh is that of the quadtree, without "
                    "anisotropic cells",
                    setting));
  return plan;
}

const char* setting_that_follows(const MeshInput& input) {
  if (input.mesh.type == MeshType::metric) return "mesh.type = \"metric\"";
  return input.stretch ? "smooth.targets = \"solution\"" : nullptr;
}

}  // namespace quadloop::adapt
