#pragma once

#include <string>

#include "adapt/solvers/command_solver.hpp"

namespace quadloop {

/// SU2 as the loop's solver: the user's configuration, and how its program is run. Its mesh is a .su2 file,
/// its solution a restart file, binary (.dat) or text (.csv).
struct Su2Solver {
  std::string config;  ///< path of the user's configuration; his program runs a copy of it, `su2_config_name`
  CommandSolver command;
};

/// The name of the configuration that SU2 runs, in a cycle's folder.
constexpr const char* su2_config_name = "su2.cfg";

/// What a case leaves open is taken from the configuration: the kind of restart file (OUTPUT_FILES: RESTART
/// or RESTART_ASCII), the ratio of specific heats (GAMMA_VALUE), the program (SU2_CFD, under mpirun where
/// `command.ranks` is above 1). Throws InputError where it cannot be read or asks for no restart file.
Su2Solver su2_solver_of(const std::string& config, CommandSolver command);

/// SU2 as any other solver. In each cycle the configuration stands in its folder with these keys set anew:
/// MESH_FILENAME, MESH_FORMAT, RESTART_SOL, SOLUTION_FILENAME, RESTART_FILENAME, READ_BINARY_RESTART,
/// CONV_FILENAME. The flow has velocity, pressure and Mach number too (with_primitive_variables()). Throws as
/// command_solver() does.
FlowSolver su2_solver(Su2Solver solver, std::function<std::string(int cycle)> folder_of);

}  // namespace quadloop
