#pragma once

#include <string>
#include <vector>

#include "adapt/euler/euler_options.hpp"
#include "io/input/case_file.hpp"
#include "mesher/geometry/boundary_rules.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The pressure that the case asks for behind outflow boundaries whose name matches, in units of the free stream's.
struct OutflowPressure {
  std::string pattern;
  double pressure = 1;
};

/// How a flow solver of the user's is run.
struct SolverCommand {
  int ranks = 0;                     ///< 0: as many as quadloop runs on
  std::vector<std::string> command;  ///< program and arguments, with {mesh} and the like still to be filled in
  std::string mesh = "mesh.mesh", solution = "solution.mesh";
  double timeout = 3600;  ///< seconds
};

/// The case's table [solver], and what its boundary tables say to the solver alone.
struct SolverSettings {
  enum class Kind { euler, command };

  Kind kind = Kind::euler;
  EulerOptions euler;  ///< without the boundaries
  SolverCommand command;
  std::vector<OutflowPressure> pressures;
};

/// Reads [solver], where there is one. Throws InputError that names key and line.
void read_solver_table(const CaseTable& root, SolverSettings& settings);

/// The options with what the case's rules say of the mesh's boundaries; where they are silent the mesh's own conditions stand.
EulerOptions euler_options(const SolverSettings& settings, const std::vector<BoundaryRule>& rules, const Mesh& mesh);

}  // namespace quadloop
