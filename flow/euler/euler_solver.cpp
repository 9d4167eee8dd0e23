#include "flow/euler/euler_solver.hpp"

#include <fmt/format.h>

#include <utility>

#include "flow/euler/shortfall.hpp"
#include "flow/postprocess/run_constants.hpp"

namespace quadloop::flow {

Field flow_with_constants(const EulerResult& result, const EulerOptions& options) {
  Field flow = result.flow;
  const RunConstants constants{.steps = static_cast<double>(result.iterations),
                               .time = result.time,
                               .mach = options.mach,
                               .alpha = options.alpha,
                               .cl = result.cl,
                               .cd = result.cd,
                               .residual = result.residual};
  flow.constants = constants.values();
  return flow;
}

FreeStream free_stream_of(const EulerOptions& options) {
  return {1,
          1 / options.gamma,
          options.mach,
          options.alpha,
          options.gamma,
          options.viscosity,
          options.reference_length};
}

std::string line_of(const EulerProgress& p, bool in_time) {
  const std::string time = in_time ? fmt::format(", time {:.6g}", p.time) : "";
  return fmt::format("step {}: residual {:.2e}, cl {:.6f}, cd {:.6f}{}", p.iteration, p.residual, p.cl, p.cd,
                     time);
}

FlowSolver euler_solver(EulerOptions options, AtEnd at_end) {
  return [options = std::move(options), at_end = std::move(at_end)](
             const Communicator& comm, const Mesh& mesh, const Field& start, int cycle) {
    SolvedFlow flow;
    EulerOptions told = options;
    const bool in_time = options.time == EulerOptions::Time::accurate;
    told.progress = [&, in_time](const EulerProgress& p) { flow.notes.push_back(line_of(p, in_time)); };
    const EulerResult result = solve_euler(comm, mesh, told, start, at_end);
    const std::string prefix = cycle < 0 ? "" : fmt::format("cycle {}: ", cycle);
    for (const std::string& line : shortfalls(result, options)) flow.warnings.push_back(prefix + line);
    static_cast<FlowTables&>(flow) = result;
    if (result.unsteady) flow.warnings.push_back(prefix + line_of(*result.unsteady));
    flow.solution = flow_with_constants(result, options);
    flow.cl = result.cl;
    flow.cd = result.cd;
    flow.residual = result.residual;
    flow.stream = free_stream_of(options);
    flow.history = result.history;
    flow.steps = result.iterations;
    return flow;
  };
}

}  // namespace quadloop::flow
