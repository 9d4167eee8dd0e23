#include "adapt/loop/passes.hpp"

#include <fmt/format.h>

#include <utility>

#include "mesher/base/progress.hpp"

namespace quadloop {

namespace {

void add_warnings(int pass, const std::vector<std::string>& from, std::vector<std::string>& to) {
  for (const std::string& warning : from) to.push_back(fmt::format("pass {}: {}", pass, warning));
}

}  // namespace

CarriedMesh mesh_after_passes(const Communicator& comm, const MeshInput& mesh, const AdaptOptions& adapt,
                              const FlowSolver& rough_solver) {
  std::vector<PassRecord> passes;
  std::vector<std::string> warnings;
  CarriedMesh carried{generate_mesh(comm, mesh), {}, {}, {}};
  require_room_for_metric(comm, mesh, adapt, carried.generated.result);
  for (int pass = 0; pass < adapt.passes; ++pass) {
    progress::set_prefix(fmt::format("pass {} of {}", pass + 1, adapt.passes));
    MeshResult& result = carried.generated.result;
    SolvedFlow flow = rough_solver(comm, result.mesh, carried.start, 0);
    passes.push_back({result.tree.attributes.nodes, flow.cl, flow.cd, flow.residual});
    SolvedMesh solved{std::move(result.mesh), std::move(result.tree), std::move(flow.solution), {}};
    const AdaptationPlan plan = plan_adaptation(comm, mesh, adapt, solved);
    add_warnings(pass + 1, plan.warnings, warnings);
    if (!plan.changes_mesh()) {
      result.mesh = std::move(solved.mesh);
      result.tree = std::move(solved.tree);
      carried.start = std::move(solved.solution);
      if (carried.report.drift.empty()) carried.report = TransferReport::without_drift(carried.start);
      break;
    }
    add_warnings(pass + 1, result.report.warnings, warnings);
    carried = carry_over(comm, mesh, plan, solved);
  }
  std::vector<std::string>& told = carried.generated.result.report.warnings;
  told.insert(told.begin(), warnings.begin(), warnings.end());
  carried.passes = std::move(passes);
  return carried;
}

}  // namespace quadloop
