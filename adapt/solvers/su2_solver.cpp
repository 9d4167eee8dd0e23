#include "adapt/solvers/su2_solver.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

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

/// Returns the user's configuration with the settings of the cycle.
std::string config_text(const Su2Solver& solver, bool restarts) {
  flow::Su2Config config = read_config(solver.config);
  const CommandSolver& command = solver.command;
  config.set("MESH_FILENAME", command.mesh);
  config.set("MESH_FORMAT", "SU2");
  config.set("RESTART_SOL", restarts ? "YES" : "NO");
  config.set("SOLUTION_FILENAME", command.state());
  config.set("RESTART_FILENAME", command.solution);
  config.set("READ_BINARY_RESTART", suffix_of(command.solution) == ".dat" ? "YES" : "NO");
  config.set("CONV_FILENAME", history_name);
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

/// Adds how SU2 ended, if it reports this. *Collective.*
void add_end(const Communicator& comm, const std::string& folder, flow::SolvedFlow& flow) {
  flow::Su2End end;
  comm.together([&] {
    const std::string path = (std::filesystem::path(folder) / history_name).string() + ".csv";
    if (comm.is_root() && std::filesystem::is_regular_file(path))
      end = flow::end_of_history(io::read_input(path));
  });
  const auto from_root = [&](const std::optional<double>& value) {
    std::vector<double> own;
    if (comm.is_root() && value) own.push_back(*value);
    const std::vector<double> all = comm.all_gather_values(std::span<const double>(own));
    return all.empty() ? std::nullopt : std::optional(all.front());
  };
  flow.cl = from_root(end.cl);
  flow.cd = from_root(end.cd);
  flow.residual = from_root(end.residual);
}

}  // namespace

Su2Solver su2_solver_of(const std::string& config, CommandSolver command) {
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
  return {config, std::move(command)};
}

flow::FlowSolver su2_solver(Su2Solver solver, std::function<std::string(int cycle)> folder_of) {
  const flow::FlowSolver command = command_solver(solver.command, folder_of);
  return [solver = std::move(solver), command, folder_of = std::move(folder_of)](
             const Communicator& comm, const Mesh& mesh, const Field& start, int cycle) {
    const std::string folder = folder_of(cycle);
    write_config(comm, solver, folder, start.width() > 0);
    flow::SolvedFlow flow = command(comm, mesh, flow::without_primitive_variables(start), cycle);
    flow.solution = flow::with_primitive_variables(std::move(flow.solution), solver.command.gamma);
    add_end(comm, folder, flow);
    return flow;
  };
}

}  // namespace quadloop::adapt
