#pragma once

#include <string>
#include <utility>
#include <vector>

#include "adapt/solvers/command_solver.hpp"

namespace quadloop::adapt {

/// SU2 as solver of the loop: the user's configuration, and the command that runs it. The mesh is a .su2
/// file, the solution a restart file, binary (.dat) or text (.csv).
struct Su2Solver {
  std::string config;  ///< path of the user's configuration; SU2 runs a modified copy, `su2_config_name`
  /// Keys and values that replace those of the configuration in every run that restarts from a solution.
  std::vector<std::pair<std::string, std::string>> warm;
  /// Keys and values for a second run in each cycle, which starts from the solution of the first one.
  std::vector<std::pair<std::string, std::string>> finish;
  CommandSolver command;
};

/// Name of that copy in a cycle's folder.
constexpr const char* su2_config_name = "su2.cfg";

/// Whether quadloop sets this key of the configuration in each cycle.
bool is_set_by_loop(const std::string& key);

/// Takes from the configuration what the case leaves open: the type of restart file (OUTPUT_FILES: RESTART or
/// RESTART_ASCII), the ratio of specific heats (GAMMA_VALUE), the program (SU2_CFD, with mpirun if
/// `command.ranks` is above 1). Throws InputError if it cannot be read or requests no restart file.
Su2Solver su2_solver_of(const std::string& config, CommandSolver command,
                        std::vector<std::pair<std::string, std::string>> warm = {},
                        std::vector<std::pair<std::string, std::string>> finish = {});

/// Returns SU2 as a solver. In each cycle's folder a copy of the configuration is written with new values of
/// MESH_FILENAME, MESH_FORMAT, RESTART_SOL, SOLUTION_FILENAME, RESTART_FILENAME, READ_BINARY_RESTART,
/// CONV_FILENAME. A run that diverges is repeated once with lower CFL numbers. With `finish` a second run
/// follows; if it diverges, the cycle has the flow of the first one. The solution also has the variables of
/// with_primitive_variables(). Throws as command_solver() does.
flow::FlowSolver su2_solver(Su2Solver solver, std::function<std::string(int cycle)> folder_of);

}  // namespace quadloop::adapt
