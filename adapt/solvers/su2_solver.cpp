#include "adapt/solvers/su2_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "flow/command/log_tail.hpp"
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

/// Returns the user's configuration with the settings of the cycle.
std::string config_text(const Su2Solver& solver, bool restarts) {
  flow::Su2Config config = read_config(solver.config);
  for (const auto& [key, value] : entries_of_loop(solver.command, restarts)) config.set(key, value);
  if (restarts) {
    for (const auto& [key, value] : solver.warm) config.set(flow::su2_key(key), value);
  }
  return config.text();
}

/// *Collective.*
void write_config(const Communicator& comm, const Su2Solver& solver, const std::string& folder,
                  bool restarts) {
  io::OutputSet outputs(comm);
  io::TextOutput file(outputs, (std::filesystem::path(folder) / su2_config_name).string());
  std::string text;
  comm.together([&] {
    if (comm.is_root()) text = config_text(solver, restarts);
  });
  file.write(text);
  file.close();
  outputs.commit();
}

/// Returns how SU2 ended, as far as its history and its log report this. *Collective.*
flow::Su2End end_of_run(const Communicator& comm, const std::string& folder) {
  std::vector<flow::Su2End> own;
  comm.together([&] {
    if (!comm.is_root()) return;
    const std::string path = (std::filesystem::path(folder) / history_name).string() + ".csv";
    flow::SolverFiles files;
    files.folder = folder;
    own.emplace_back();
    if (std::filesystem::is_regular_file(path)) own.back() = flow::end_of_history(io::read_input(path));
    own.back().converged = flow::converged_by_log(flow::end_of_file(flow::solver_log(files)));
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
void add_end(const Communicator& comm, const Su2Solver& solver, const std::string& folder,
             flow::SolvedFlow& flow) {
  const flow::Su2End end = end_of_run(comm, folder);
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

}  // namespace

bool is_set_by_loop(const std::string& key) {
  const Entries entries = entries_of_loop({}, false);
  return std::ranges::any_of(entries, [&](const auto& entry) { return entry.first == flow::su2_key(key); });
}

Su2Solver su2_solver_of(const std::string& config, CommandSolver command, Entries warm) {
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
  return {config, std::move(warm), std::move(command)};
}

flow::FlowSolver su2_solver(Su2Solver solver, std::function<std::string(int cycle)> folder_of) {
  const flow::FlowSolver command = command_solver(solver.command, folder_of);
  return [solver = std::move(solver), command, folder_of = std::move(folder_of)](
             const Communicator& comm, const Mesh& mesh, const Field& start, int cycle) {
    const std::string folder = folder_of(cycle);
    write_config(comm, solver, folder, start.width() > 0);
    flow::SolvedFlow flow = command(comm, mesh, flow::without_primitive_variables(start), cycle);
    flow.solution = flow::with_primitive_variables(std::move(flow.solution), solver.command.gamma);
    add_end(comm, solver, folder, flow);
    return flow;
  };
}

}  // namespace quadloop::adapt
