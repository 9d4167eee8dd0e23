#include "adapt/loop/passes.hpp"

#include <fmt/format.h>

#include <utility>

#include "mesher/base/progress.hpp"

namespace quadloop::adapt {

namespace {

void add_warnings(int pass, const std::vector<std::string>& from, std::vector<std::string>& to) {
  for (const std::string& warning : from) to.push_back(fmt::format("pass {}: {}", pass, warning));
}

}  // namespace

RemeshedSolution mesh_after_passes(const Communicator& comm, const MeshInput& mesh, const AdaptOptions& adapt,
                                   const flow::FlowSolver& rough_solver) {
  std::vector<PassRecord> passes;
  std::vector<std::string> warnings;
  RemeshedSolution remeshed{generate_mesh(comm, mesh), {}, {}, {}};
  require_room_for_metric(comm, mesh, adapt, remeshed.generated.result);
  for (int pass = 0; pass < adapt.passes; ++pass) {
    progress::set_prefix(fmt::format("pass {} of {}", pass + 1, adapt.passes));
    MeshResult& result = remeshed.generated.result;
    flow::SolvedFlow flow = rough_solver(comm, result.mesh, remeshed.start, 0);
    passes.push_back({result.tree.attributes.nodes, flow.cl, flow.cd, flow.residual});
    SolvedMesh solved{std::move(result.mesh), std::move(result.tree), std::move(flow.solution), {}};
    const AdaptationPlan plan = plan_adaptation(comm, mesh, adapt, solved);
    add_warnings(pass + 1, plan.warnings, warnings);
    if (!plan.changes_mesh()) {
      result.mesh = std::move(solved.mesh);
      result.tree = std::move(solved.tree);
      remeshed.start = std::move(solved.solution);
      if (remeshed.report.drift.empty()) remeshed.report = TransferReport::without_drift(remeshed.start);
      break;
    }
    add_warnings(pass + 1, result.report.warnings, warnings);
    remeshed = remesh_and_transfer(comm, mesh, plan, solved);
  }
  std::vector<std::string>& told = remeshed.generated.result.report.warnings;
  told.insert(told.begin(), warnings.begin(), warnings.end());
  remeshed.passes = std::move(passes);
  return remeshed;
}

}  // namespace quadloop::adapt
