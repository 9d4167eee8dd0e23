#include "adapt/solvers/su2_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "flow/command/log_tail.hpp"
#include "flow/su2/careful_settings.hpp"
#include "flow/su2/su2_config.hpp"
#include "flow/su2/su2_history.hpp"
#include "flow/su2/su2_variables.hpp"
#include "io/files/reading/input_file.hpp"
#include "io/text/text_output.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/suffix.hpp"

namespace quadloop::adapt {

namespace {

constexpr const char* history_name = "history";

flow::Su2Config read_config(const std::string& path) { return {io::read_input(path), path}; }

/// Returns the name of the restart file that SU2 will write.
std::string restart_name(const flow::Su2Config& config, const std::string& path) {
  const std::vector<std::string> files = config.words("OUTPUT_FILES");
  const auto has = [&](const char* word) { return std::ranges::find(files, word) != files.end(); };
  if (files.empty() || has("RESTART")) return "restart.dat";
  if (has("RESTART_ASCII") || has("CSV")) return "restart.csv";
  throw InputError(path +
                   ": OUTPUT_FILES names neither RESTART nor RESTART_ASCII; add one of them, as the flow "
                   "is read from there");
}

double gamma_of(const flow::Su2Config& config, const std::string& path, double absent) {
  const auto text = config.value("GAMMA_VALUE");
  if (!text) return absent;
  try {
    return std::stod(*text);
  } catch (const std::exception&) {
    throw InputError(path + ": GAMMA_VALUE is no number: " + *text);
  }
}

using Entries = std::vector<std::pair<std::string, std::string>>;

/// Returns the keys that the loop sets, with their values.
Entries entries_of_loop(const CommandSolver& command, bool restarts) {
  return {{"MESH_FILENAME", command.mesh},
          {"MESH_FORMAT", "SU2"},
          {"RESTART_SOL", restarts ? "YES" : "NO"},
          {"SOLUTION_FILENAME", command.state()},
          {"RESTART_FILENAME", command.solution},
          {"READ_BINARY_RESTART", suffix_of(command.solution) == ".dat" ? "YES" : "NO"},
          {"CONV_FILENAME", history_name}};
}

/// A run of SU2 in a cycle.
struct Run {
  bool restarts = false;   ///< from a transferred solution, or from the first run of the cycle
  bool finishing = false;  ///< the second run of the cycle
  bool careful = false;    ///< after a run that diverged
};

void set_all(flow::Su2Config& config, const Entries& entries) {
  for (const auto& [key, value] : entries) config.set(flow::su2_key(key), value);
}

/// Returns the user's configuration with the settings of the run.
std::string config_text(const Su2Solver& solver, Run run) {
  flow::Su2Config config = read_config(solver.config);
  set_all(config, entries_of_loop(solver.command, run.restarts));
  if (run.restarts && !run.careful) set_all(config, solver.warm);
  if (run.finishing) set_all(config, solver.finish);
  if (run.careful) flow::set_careful_cfl(config);
  return config.text();
}

/// *Collective.*
void write_config(const Communicator& comm, const Su2Solver& solver, const std::string& folder, Run run) {
  io::OutputSet outputs(comm);
  io::TextOutput file(outputs, (std::filesystem::path(folder) / su2_config_name).string());
  std::string text;
  comm.together([&] {
    if (comm.is_root()) text = config_text(solver, run);
  });
  file.write(text);
  file.close();
  outputs.commit();
}

/// Returns the end of what SU2 printed, on the root.
std::string printed_end(const std::string& folder) {
  flow::SolverFiles files;
  files.folder = folder;
  return flow::end_of_file(flow::solver_log(files));
}

/// Returns how SU2 ended, as far as its history and its log report this. *Collective.*
flow::Su2End end_of_run(const Communicator& comm, const std::string& folder) {
  std::vector<flow::Su2End> own;
  comm.together([&] {
    if (!comm.is_root()) return;
    const std::string path = (std::filesystem::path(folder) / history_name).string() + ".csv";
    own.emplace_back();
    if (std::filesystem::is_regular_file(path)) own.back() = flow::end_of_history(io::read_input(path));
    own.back().converged = flow::converged_by_log(printed_end(folder));
  });
  return comm.all_gather_values(std::span<const flow::Su2End>(own)).front();
}

/// Returns a warning about a flow that did not converge.
std::string unconverged_warning(const flow::Su2Config& config, const flow::Su2End& end) {
  std::string text = "SU2 reached its limit of iterations";
  if (const auto limit = config.value("ITER")) text += fmt::format(" (ITER= {})", *limit);
  text += " before it converged";
  if (end.log_residual) text += fmt::format("; its residual is 10^{:.2f}", *end.log_residual);
  if (const auto goal = config.value("CONV_RESIDUAL_MINVAL"))
    text += fmt::format(", and CONV_RESIDUAL_MINVAL= {}", *goal);
  return text +
         ". The forces and the next mesh depend on this unfinished flow: increase ITER, or change the "
         "settings of the scheme";
}

/// Adds how SU2 ended to its flow. *Collective.*
void add_end(const Communicator& comm, const Su2Solver& solver, const flow::Su2End& end,
             flow::SolvedFlow& flow) {
  flow.cl = end.cl;
  flow.cd = end.cd;
  flow.residual = end.residual;
  flow.log_residual = end.log_residual;
  flow.converged = end.converged;
  comm.together([&] {
    if (end.converged == false && comm.is_root())
      flow.warnings.push_back(unconverged_warning(read_config(solver.config), end));
  });
}

/// Whether SU2 stopped in the folder because its flow diverged. *Collective.*
bool stopped_diverging(const Communicator& comm, const std::string& folder) {
  std::vector<char> diverged(1, 0);
  if (comm.is_root()) diverged[0] = flow::diverged_by_log(printed_end(folder)) ? 1 : 0;
  comm.broadcast(diverged);
  return diverged[0] != 0;
}

/// Whether a run of SU2 that ended by itself shows a diverging flow. The second run of a cycle starts from a
/// converged flow, so that its residual grows less before it is too large for results.
bool is_diverging(const flow::Su2End& end, Run run) {
  const double most_growth = run.finishing ? 10 : 100;  // of the residual
  return end.converged == false && end.residual && *end.residual > most_growth;
}

/// SU2 in the folders of the cycles.
class Su2Runs {
 public:
  Su2Runs(Su2Solver solver, std::function<std::string(int cycle)> folder_of)
      : solver_{std::move(solver)},
        command_{command_solver(solver_.command, folder_of)},
        folder_of_{std::move(folder_of)} {}

  /// Solves once, and a second time with the keys of `finish` if there are any.
  flow::SolvedFlow operator()(const Communicator& comm, const Mesh& mesh, const Field& start,
                              int cycle) const {
    const Field state = flow::without_primitive_variables(start);
    flow::SolvedFlow flow = solved(comm, mesh, state, cycle, {.restarts = state.width() > 0});
    if (!solver_.finish.empty()) finish(comm, mesh, cycle, flow);
    flow.solution = flow::with_primitive_variables(std::move(flow.solution), solver_.command.gamma);
    return flow;
  }

 private:
  /// Solves once, and once more with lower CFL numbers if the flow diverged.
  flow::SolvedFlow solved(const Communicator& comm, const Mesh& mesh, const Field& state, int cycle,
                          Run run) const {
    std::optional<flow::SolvedFlow> flow = attempt(comm, mesh, state, cycle, run);
    if (flow) return std::move(*flow);
    run.careful = true;
    flow = attempt(comm, mesh, state, cycle, run);
    flow->warnings.push_back(
        "SU2 diverged in this cycle and was run again with a tenth of the CFL numbers (su2.cfg in the "
        "folder of the cycle); reduce CFL_NUMBER or the growth in CFL_ADAPT_PARAM, or remove them from "
        "solver.warm");
    return std::move(*flow);
  }

  /// Replaces a flow by that of the second run, which starts from it. If the second run diverges, the flow of
  /// the first one stays.
  void finish(const Communicator& comm, const Mesh& mesh, int cycle, flow::SolvedFlow& flow) const {
    std::optional<flow::SolvedFlow> finished =
        attempt(comm, mesh, flow.solution, cycle, {.restarts = true, .finishing = true});
    if (!finished) {
      flow.warnings.push_back(
          "SU2 diverged in the second run of this cycle, with the keys of solver.finish; the cycle keeps the "
          "flow of the first run: let the first run converge further, or reduce the CFL numbers in "
          "solver.finish");
      return;
    }
    finished->warnings.insert(finished->warnings.begin(), flow.warnings.begin(), flow.warnings.end());
    flow = std::move(*finished);
  }

  /// Runs SU2. Empty if the flow diverged, unless the run is careful.
  std::optional<flow::SolvedFlow> attempt(const Communicator& comm, const Mesh& mesh, const Field& state,
                                          int cycle, Run run) const {
    const std::string folder = folder_of_(cycle);
    write_config(comm, solver_, folder, run);
    flow::SolvedFlow flow;
    try {
      flow = command_(comm, mesh, state, cycle);
    } catch (const SolverError&) {
      if (run.careful || !stopped_diverging(comm, folder)) throw;
      return std::nullopt;
    }
    const flow::Su2End end = end_of_run(comm, folder);
    if (!run.careful && is_diverging(end, run)) return std::nullopt;
    add_end(comm, solver_, end, flow);
    return flow;
  }

  Su2Solver solver_;
  flow::FlowSolver command_;
  std::function<std::string(int cycle)> folder_of_;
};

}  // namespace

bool is_set_by_loop(const std::string& key) {
  const Entries entries = entries_of_loop({}, false);
  return std::ranges::any_of(entries, [&](const auto& entry) { return entry.first == flow::su2_key(key); });
}

Su2Solver su2_solver_of(const std::string& config, CommandSolver command, Entries warm, Entries finish) {
  const flow::Su2Config given = read_config(config);
  command.mesh = "mesh.su2";
  command.solution = restart_name(given, config);
  command.gamma = gamma_of(given, config, command.gamma);
  if (command.command.arguments.empty()) {
    command.command.arguments = {"SU2_CFD", su2_config_name};
    const std::vector<std::string> launcher{"mpirun", "-n", "{ranks}"};
    if (command.ranks > 1)
      command.command.arguments.insert(command.command.arguments.begin(), launcher.begin(), launcher.end());
    command.command.name = "SU2_CFD";
    command.command.where = "[solver] has no command, so SU2_CFD is run";
  }
  return {config, std::move(warm), std::move(finish), std::move(command)};
}

flow::FlowSolver su2_solver(Su2Solver solver, std::function<std::string(int cycle)> folder_of) {
  return Su2Runs(std::move(solver), std::move(folder_of));
}

}  // namespace quadloop::adapt
