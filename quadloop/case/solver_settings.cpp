#include "quadloop/case/solver_settings.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "flow/euler/solve_euler.hpp"
#include "flow/quantities/goal_value.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/nearest_word.hpp"
#include "quadloop/case/goal_settings.hpp"

namespace quadloop {

namespace {

int whole_number(const CaseTable& table, const std::string& key, int absent) {
  const auto value = table.number(key, {0, std::numeric_limits<int>::max()});
  if (!value) return absent;
  if (*value != std::floor(*value)) table.refuse(key, "must be a whole number, 0 or more");
  return static_cast<int>(*value);
}

/// Viscosity may be given or asked for by a Reynolds number.
void read_viscosity(const CaseTable& table, EulerOptions& options) {
  const double length =
      table.number("reference_length", Range::positive()).value_or(options.reference_length);
  options.viscosity = table.number("viscosity", {0}).value_or(options.viscosity);
  if (const auto reynolds = table.number("reynolds", Range::positive())) {
    if (table.has("viscosity"))
      table.refuse("reynolds", "stands beside viscosity, which it decides; give one of the two");
    if (options.mach == 0) table.refuse("reynolds", "needs a mach above 0; give viscosity instead");
    options.viscosity = options.mach * length / *reynolds;
  }
  options.prandtl = table.number("prandtl", Range::positive()).value_or(options.prandtl);
}

/// Of runs in time, and of steady ones that go on in time.
void read_time(const CaseTable& table, EulerOptions& options) {
  const bool accurate = table.choice("time", {"steady", "accurate"}) == "accurate";
  if (accurate) options.time = EulerOptions::Time::accurate;
  options.end_time = table.number("end_time", {0}).value_or(options.end_time);
  if (accurate && !table.has("end_time"))
    table.refuse("end_time", "is missing; time = \"accurate\" needs the time at which it ends");
  const bool carries_on = table.choice("unsteady", {"stop", "carry_on"}) == "carry_on";
  if (carries_on) options.unsteady = EulerOptions::Unsteady::carry_on;
  if (carries_on && accurate)
    table.refuse("unsteady",
                 "does nothing with time = \"accurate\", which goes on in time anyway; leave it out");
  if (carries_on && options.mach == 0)
    table.refuse("unsteady", "needs a mach above 0, as its length is counted in flow-through times");
  options.flow_throughs =
      table.number("flow_throughs", {0, 1e6, true, false}).value_or(options.flow_throughs);
  if (table.has("flow_throughs") && !carries_on)
    table.refuse("flow_throughs", "does nothing without unsteady = \"carry_on\"");
  options.time_step = table.number("time_step", Range::positive());
  if (options.time_step && !accurate && !carries_on)
    table.refuse("time_step",
                 "does nothing in a steady flow; set time = \"accurate\" or unsteady = \"carry_on\"");
  if (accurate && options.time_step && options.end_time / *options.time_step > most_steps_in_time)
    table.refuse(
        "time_step",
        fmt::format(
            "would take {:.2g} steps to the end_time {}, of which there may be {:.0f}; give {:.2g} or more",
            options.end_time / *options.time_step, options.end_time, most_steps_in_time,
            options.end_time / most_steps_in_time));
  options.average_from = table.number("average_from", {0});
  if (options.average_from && !accurate)
    table.refuse("average_from",
                 "belongs to time = \"accurate\"; a flow that is carried on has means over its second half");
  if (options.average_from && *options.average_from >= options.end_time)
    table.refuse("average_from", "must be below end_time, so that there is something to take means over");
}

void read_euler_keys(const CaseTable& table, EulerOptions& options) {
  options.mach = table.number("mach", {0, 100}).value_or(options.mach);
  options.alpha = table.number("alpha", {-360, 360}).value_or(options.alpha);
  options.gamma = table.number("gamma", {1, 10, true, false}).value_or(options.gamma);
  read_viscosity(table, options);
  read_time(table, options);
  options.cfl = table.number("cfl", Range::positive()).value_or(options.cfl);
  options.iterations = whole_number(table, "iterations", options.iterations);
  options.tolerance = table.number("tolerance", {0, 1}).value_or(options.tolerance);
  if (table.choice("limiter", {"venkatakrishnan", "none"}) == "none")
    options.limiter = EulerOptions::Limiter::none;
  if (table.choice("initial", {"freestream", "vortex"}) == "vortex")
    options.initial = EulerOptions::Initial::vortex;
  if (table.choice("far_field", {"uniform", "vortex"}) == "vortex")
    options.far_field = EulerOptions::FarField::vortex;
  if (options.far_field == EulerOptions::FarField::vortex && options.mach >= 1)
    table.refuse("far_field",
                 fmt::format("requires a subsonic free stream; remove it at mach {}", options.mach));
  options.reference_length =
      table.number("reference_length", Range::positive()).value_or(options.reference_length);
}

/// A free stream at rest moves nothing by itself.
void require_driven_flow(const CaseTable& table, const SolverSettings& settings) {
  const EulerOptions& options = settings.euler;
  if (settings.kind != SolverSettings::Kind::euler || options.mach > 0) return;
  const bool is_heated = options.viscosity > 0 && !settings.wall_temperatures.empty();
  if (options.initial == EulerOptions::Initial::vortex || is_heated || !settings.pressures.empty()) return;
  table.refuse(
      "mach",
      "is 0, so nothing moves the gas and forces have no coefficients; set it above 0, or drive the flow "
      "by initial = \"vortex\", the pressure of an outflow or, with viscosity, a wall_temperature");
}

/// The user's case for SU2 or OpenFOAM; mesh and solution have names of ours there.
void read_template(const CaseTable& table, SolverSettings& settings) {
  using enum SolverSettings::Kind;
  settings.case_template = table.text("template").value_or("");
  if (settings.kind != su2 && settings.kind != openfoam) {
    if (table.has("template"))
      table.refuse("template", "does nothing here; it belongs to kind = \"su2\" or \"openfoam\"");
    return;
  }
  if (settings.case_template.empty()) {
    table.refuse(
        "template",
        settings.kind == su2
            ? "is missing; kind = \"su2\" needs the configuration to run, relative to the case file"
            : "is missing; kind = \"openfoam\" needs the folder of a case, relative to the case file");
  }
  for (const char* const key : {"mesh", "solution"}) {
    if (table.has(key)) table.refuse(key, "does nothing here: both files have names of their own");
  }
}

void read_command_keys(const CaseTable& table, SolverSettings& settings) {
  CommandSolver& command = settings.command;
  command.ranks = whole_number(table, "ranks", command.ranks);
  if (table.has("command")) command.command.arguments = table.texts("command");
  command.mesh = table.text("mesh").value_or(command.mesh);
  command.solution = table.text("solution").value_or(command.solution);
  command.command.timeout = table.number("timeout", Range::positive()).value_or(command.command.timeout);
  for (const auto& [key, name] : {std::pair{"mesh", command.mesh}, {"solution", command.solution}}) {
    if (name.empty() || name.find('/') != std::string::npos)
      table.refuse(key, "must be the name of a file in the cycle's folder");
  }
  if (settings.kind == SolverSettings::Kind::command && command.command.arguments.empty()) {
    table.refuse("command",
                 "is missing; kind = \"command\" needs the program to run and its arguments, as in command = "
                 "[\"my_solver\", \"{mesh}\"]");
  }
}

}  // namespace

void read_solver_table(const CaseTable& root, SolverSettings& settings) {
  const auto table = root.table("solver");
  if (!table) return;
  settings.given = true;
  if (const auto word = table->choice("kind", words_of(SolverSettings::kind_words)))
    settings.kind = *value_of(SolverSettings::kind_words, *word);
  read_euler_keys(*table, settings.euler);
  read_goals(*table, settings.kind == SolverSettings::Kind::euler, settings.euler);
  read_command_keys(*table, settings);
  read_template(*table, settings);
  require_driven_flow(*table, settings);
  table->finish();
}

std::vector<std::string> idle_wall_temperatures(const SolverSettings& settings) {
  if (settings.kind != SolverSettings::Kind::euler || settings.euler.viscosity > 0) return {};
  std::vector<std::string> warnings;
  for (const WallTemperature& wall : settings.wall_temperatures)
    warnings.push_back(
        fmt::format("'boundary.{}.wall_temperature' does nothing, as the flow has no "
                    "viscosity: set solver.reynolds or solver.viscosity",
                    wall.pattern));
  return warnings;
}

std::vector<std::string> forces_without_stream(const SolverSettings& settings) {
  if (!settings.given || settings.kind != SolverSettings::Kind::euler || settings.euler.mach > 0) return {};
  return {"solver.mach is 0: coefficients of forces need a free stream, so cl and cd are 0"};
}

std::vector<std::string> exits_into_vacuum(const SolverSettings& settings,
                                           const std::vector<BoundaryRule>& rules) {
  if (!settings.given || settings.kind != SolverSettings::Kind::euler || settings.euler.mach >= 1) return {};
  std::vector<std::string> warnings;
  for (const BoundaryRule& rule : rules) {
    const bool has_pressure = std::ranges::any_of(settings.pressures, [&](const OutflowPressure& outflow) {
      return matches(outflow.pattern, rule.pattern);
    });
    if (rule.condition == "outflow" && !has_pressure)
      warnings.push_back(
          rule.where +
          " is a subsonic outflow without back pressure, where gas leaves as into a vacuum; set "
          "pressure = 1 for the static pressure of the free stream");
  }
  return warnings;
}

EulerOptions euler_options(const SolverSettings& settings, const std::vector<BoundaryRule>& rules,
                           const Mesh& mesh) {
  std::vector<std::string> names;
  for (const BoundaryEdges& boundary : mesh.boundaries) names.push_back(boundary.name);
  std::vector<BoundaryRule> lenient = rules;
  for (BoundaryRule& rule : lenient) rule.must_match = false;  // the mesh may have dropped a small island
  EulerOptions options = settings.euler;
  for (const Boundary& boundary : boundaries_by_rules(names, lenient, 0)) {
    BoundaryChoice choice{boundary.name, boundary.condition == "none" ? "" : boundary.condition, {}, {}};
    for (const bool exact : {false, true}) {
      for (const OutflowPressure& outflow : settings.pressures) {
        if ((outflow.pattern == boundary.name) == exact && matches(outflow.pattern, boundary.name))
          choice.pressure = outflow.pressure;
      }
      for (const WallTemperature& wall : settings.wall_temperatures) {
        if ((wall.pattern == boundary.name) == exact && matches(wall.pattern, boundary.name))
          choice.temperature = wall.temperature;
      }
    }
    options.boundaries.push_back(std::move(choice));
  }
  options.goals = goals_on(options.goals, names);
  return options;
}

void require_known_variables(const SolverSettings& settings, const std::vector<std::string>& variables,
                             const std::string& case_path) {
  if (settings.kind != SolverSettings::Kind::euler) return;
  for (const std::string& name : variables) {
    if (std::find(euler_names.begin(), euler_names.end(), name) != euler_names.end()) continue;
    if (name == error_name && !settings.euler.goals.empty()) continue;
    if (name == error_name)
      throw InputError(fmt::format(
          "{}: 'adapt.variable' names '{}', which the built-in solver writes where it knows what of; set "
          "solver.goal, as in goal = \"drag\"",
          case_path, name));
    throw InputError(fmt::format(
        "{}: 'adapt.variable' names '{}', which the built-in solver does not write; it may be {}{}",
        case_path, name, fmt::join(euler_names, ", "),
        guess_for(name, {euler_names.begin(), euler_names.end()})));
  }
}

ChosenSolver chosen_solver(const SolverSettings& settings, const std::vector<BoundaryRule>& rules,
                           const Geometry& geometry, const std::string& case_path) {
  if (settings.kind == SolverSettings::Kind::euler) {
    Mesh named;
    for (const Boundary& boundary : geometry.boundaries())
      named.boundaries.push_back({boundary.name, boundary.condition, {}});
    return euler_options(settings, rules, named);
  }
  const std::filesystem::path case_folder = std::filesystem::absolute(case_path).parent_path();
  if (settings.kind == SolverSettings::Kind::openfoam) {
    return OpenfoamSolver{(case_folder / settings.case_template).lexically_normal().string(),
                          settings.command.ranks, settings.command.command.timeout};
  }
  CommandSolver solver = settings.command;
  solver.gamma = settings.euler.gamma;
  solver.case_folder = case_folder.string();
  if (settings.kind == SolverSettings::Kind::su2)
    return su2_solver_of((case_folder / settings.case_template).string(), std::move(solver));
  return solver;
}

}  // namespace quadloop
