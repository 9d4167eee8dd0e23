#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adapt/solvers/chosen_solver.hpp"
#include "mesher/base/word_table.hpp"
#include "mesher/geometry/assemble/boundary_rules.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"
#include "quadloop/case/key_table.hpp"

namespace quadloop {

/// Back pressure of outflow boundaries whose name matches, in units of the free-stream pressure.
struct OutflowPressure {
  std::string pattern;
  double pressure = 1;
};

/// Temperature of walls whose name matches, in units of the free-stream temperature.
struct WallTemperature {
  std::string pattern;
  double temperature = 1;
};

/// Output functionals, each with the weight of its error.
using GoalWeights = std::vector<std::pair<flow::Goal::Quantity, double>>;

/// The case's table [solver], and the solver's keys of its boundary tables.
struct SolverSettings {
  enum class Kind { euler, command, su2, openfoam };
  static constexpr WordTable<Kind, 4> kind_words{
      {{"euler", Kind::euler}, {"command", Kind::command}, {"su2", Kind::su2}, {"openfoam", Kind::openfoam}}};

  Kind kind = Kind::euler;
  bool given = false;        ///< whether the case has the table
  flow::EulerOptions euler;  ///< without the boundaries
  std::optional<double> reynolds;
  GoalWeights goals = {};
  std::vector<std::string> goal_on = {};  ///< patterns of boundaries
  std::optional<Point> goal_about = {};
  adapt::CommandSolver command;  ///< without the case's folder
  /// Keys of SU2's configuration, with their values in runs that restart.
  std::vector<std::pair<std::string, std::string>> warm;
  /// Keys of SU2's configuration, with their values in the second run of a cycle.
  std::vector<std::pair<std::string, std::string>> finish;
  std::string case_template;  ///< path of SU2's configuration or OpenFOAM's case, as written in the case
  std::vector<OutflowPressure> pressures;
  std::vector<WallTemperature> wall_temperatures;
};

const KeyTable<SolverSettings>& solver_keys();

/// Reads [solver]. Throws InputError that names key and line.
void read_solver_table(const io::CaseTable& table, SolverSettings& settings);

/// Returns a warning if the free stream is at rest, so that forces have no coefficients.
std::vector<std::string> forces_without_stream(const SolverSettings& settings);

/// Returns a warning for each outflow rule of the built-in solver without back pressure, if the free stream
/// is subsonic.
std::vector<std::string> exits_into_vacuum(const SolverSettings& settings,
                                           const std::vector<BoundaryRule>& rules);

/// Returns the options with the boundary conditions of the case's rules; the mesh's own conditions are the
/// default.
flow::EulerOptions euler_options(const SolverSettings& settings, const std::vector<BoundaryRule>& rules,
                                 const Mesh& mesh);

/// Rejects an adaptation variable that the built-in solver does not write. Throws InputError that names the
/// case.
void require_known_variables(const SolverSettings& settings, const std::vector<std::string>& variables,
                             const std::string& case_path);

/// Returns the solver of an adaptive run on meshes of this geometry. `case_path` names the case file.
adapt::ChosenSolver chosen_solver(const SolverSettings& settings, const std::vector<BoundaryRule>& rules,
                                  const Geometry& geometry, const std::string& case_path);

}  // namespace quadloop
