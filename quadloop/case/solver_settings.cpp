#include "quadloop/case/solver_settings.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "flow/euler/solve_euler.hpp"
#include "flow/postprocess/goal_value.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/nearest_word.hpp"
#include "quadloop/case/goal_settings.hpp"

namespace quadloop {

using flow::EulerOptions;

namespace {

/// The name of a file in the cycle's folder.
ValueForm<std::string> file_name() {
  ValueForm<std::string> form = text();
  form.read = [](const io::CaseTable& table, const std::string& key) {
    const std::string name = *table.text(key);
    if (name.empty() || name.find('/') != std::string::npos)
      table.refuse(key, "must be the name of a file in the cycle's folder");
    return name;
  };
  return form;
}

/// Keys of SU2's configuration, each with a number or a text as it stands there.
ValueForm<std::vector<std::pair<std::string, std::string>>> su2_entries() {
  const auto read = [](const io::CaseTable& table, const std::string& key) {
    if (!table.is_table(key)) table.refuse(key, "must be a table, as in { CFL_NUMBER = 1000 }");
    const io::CaseTable entries = *table.table(key);
    std::vector<std::pair<std::string, std::string>> result;
    for (const std::string& entry : entries.keys()) {
      if (adapt::is_set_by_loop(entry)) entries.refuse(entry, "is set by quadloop in each cycle");
      result.emplace_back(
          entry, entries.is_text(entry) ? *entries.text(entry) : fmt::format("{}", *entries.number(entry)));
    }
    return result;
  };
  return {"table", "{ CFL_NUMBER = 1000 }", read};
}

/// A need without which the key has no effect.
KeyNeed only_with(const std::string& condition) { return {condition, "", "", true}; }

/// Keys of the free stream and the equations.
std::vector<Key<EulerOptions>> model_keys() {
  using enum EulerOptions::Limiter;
  return {
      key<&EulerOptions::mach>(
          "mach", number({0, 100}),
          "Free-stream Mach number. Mach 0 requires another driving force; see [free stream](#solver)."),
      key<&EulerOptions::alpha>("alpha", number({-360, 360}), "Angle of attack.", {.unit = "degrees"}),
      key<&EulerOptions::viscosity>("viscosity", number({0}),
                                    "Dynamic viscosity in units of free-stream density, speed of sound and "
                                    "length. Above 0: laminar flow, no-slip walls."),
      key<&EulerOptions::prandtl>("prandtl", number(io::Range::positive()),
                                  "Prandtl number of a viscous flow.",
                                  {.needs = {only_with("viscosity > 0 or reynolds")}}),
      key<&EulerOptions::reference_length>(
          "reference_length", number(io::Range::positive()),
          "Reference length of the force coefficients, which include all walls and are in wind axes.",
          {.unit = "length"}),
      key<&EulerOptions::limiter>(
          "limiter", choice<EulerOptions::Limiter>({{"venkatakrishnan", venkatakrishnan}, {"none", none}}),
          "Limiter; `none` for flows without shocks."),
      key<&EulerOptions::far_field>(
          "far_field",
          choice<EulerOptions::FarField>(
              {{"uniform", EulerOptions::FarField::uniform}, {"vortex", EulerOptions::FarField::vortex}}),
          "Far-field condition: the free stream, or the free stream with point-vortex correction for "
          "subsonic flow.",
          {.needs = {{"mach < 1", "a point vortex requires a subsonic free stream",
                      "far_field = \"vortex\""}}}),
      key<&EulerOptions::initial>(
          "initial",
          choice<EulerOptions::Initial>(
              {{"freestream", EulerOptions::Initial::freestream}, {"vortex", EulerOptions::Initial::vortex}}),
          "Initial state: the free stream, or an isentropic vortex in the middle of the mesh. A flow in the "
          "mesh file has priority over both.")};
}

/// Keys of the solution method, steady or unsteady.
std::vector<Key<EulerOptions>> march_keys() {
  using enum EulerOptions::Unsteady;
  const std::string carries_on = "unsteady = \"carry_on\"";
  return {
      key<&EulerOptions::time>("time",
                               choice<EulerOptions::Time>({{"steady", EulerOptions::Time::steady},
                                                           {"accurate", EulerOptions::Time::accurate}}),
                               "`steady`, or `accurate` up to `end_time`."),
      key<&EulerOptions::end_time>(
          "end_time", number({0}),
          "End of a flow with `time = \"accurate\"`, in units of length over free-stream speed of sound.",
          {.example = "10",
           .needs = {only_with("time = \"accurate\"")},
           .required = {{"the time at which a flow with time = \"accurate\" ends", "time = \"accurate\""}}}),
      key<&EulerOptions::average_from>(
          "average_from", number({0}),
          "Start of averaging: the stored flow and forces are means from then on ([unsteady "
          "flows](../how-to/unsteady-flows.md)).",
          {.fallback = "none",
           .needs = {{"time = \"accurate\"",
                      "a steady flow that continues in time is averaged over its second half"}}}),
      key<&EulerOptions::unsteady>(
          "unsteady", choice<EulerOptions::Unsteady>({{"stop", stop}, {"carry_on", continue_in_time}}),
          "What happens if a steady flow does not converge: keep the best state, or continue in time "
          "and average over the second half.",
          {.needs = {{"time = \"steady\"", "a time-accurate flow always continues in time", carries_on},
                     {"mach > 0", "its length is counted in flow-through times", carries_on}}}),
      key<&EulerOptions::flow_throughs>(
          "flow_throughs", number({0, 1e6, true, false}),
          "Duration in convective times L/U, with L the longer side of the bounding box of the walls. More "
          "than ten million steps in total are rejected.",
          {.needs = {{carries_on}}}),
      key<&EulerOptions::time_step>(
          "time_step", number(io::Range::positive()),
          "Size of second-order implicit steps, in units of length over speed of sound. Default: explicit "
          "steps.",
          {.fallback = "none", .needs = {{"time = \"accurate\" or " + carries_on}}}),
      key<&EulerOptions::cfl>(
          "cfl", number(io::Range::positive()),
          "Steady: initial CFL number; it grows as the residual falls. Explicit time steps use at most 0.8."),
      key<&EulerOptions::iterations>(
          "iterations", whole({0, std::numeric_limits<int>::max()}),
          "Largest number of steps; steps of a flow continued in time do not count.", {.example = "50"}),
      key<&EulerOptions::tolerance>("tolerance", number({0, 1}),
                                    "Steady: tolerance of the density residual, relative to the larger of "
                                    "the initial residual and that of the undisturbed free stream.")};
}

std::vector<Key<SolverSettings>> command_keys() {
  const std::string runs = "kind = \"euler\" or kind = \"command\"";
  const KeyNeed of_command = only_with("kind = \"command\""),
                of_program = only_with("kind = \"command\" or kind = \"su2\""),
                of_all = only_with("kind = \"command\" or kind = \"su2\" or kind = \"openfoam\"");
  const std::string own_names = "with the others both files have names of their own";
  return {key<&SolverSettings::command, &adapt::CommandSolver::command, &flow::SolverCommand::arguments>(
              "command", texts(), "Program and arguments ([interface](solver-interface.md)).",
              {.example = "[\"flow\", \"{mesh}\"]",
               .needs = {of_program},
               .required = {{"kind = \"command\" needs the program to run and its arguments, as in command = "
                             "[\"my_solver\", \"{mesh}\"]",
                             "kind = \"command\""}}}),
          key<&SolverSettings::command, &adapt::CommandSolver::ranks>(
              "ranks", whole({0, std::numeric_limits<int>::max()}),
              "Number of ranks of the program; 0: as many as quadloop.", {.example = "3", .needs = {of_all}}),
          key<&SolverSettings::command, &adapt::CommandSolver::mesh>(
              "mesh", file_name(), "Input file of the program.",
              {.example = "\"m.su2\"", .needs = {of_command, {runs, own_names}}}),
          key<&SolverSettings::command, &adapt::CommandSolver::solution>(
              "solution", file_name(), "Output file of the program.",
              {.example = "\"s.cgns\"", .needs = {of_command, {runs, own_names}}}),
          key<&SolverSettings::command, &adapt::CommandSolver::command, &flow::SolverCommand::timeout>(
              "timeout", number(io::Range::positive()), "Time limit of the program.",
              {.unit = "seconds", .needs = {of_all}}),
          key<&SolverSettings::case_template>(
              "template", text(),
              "Configuration file of [SU2](../how-to/su2.md), or folder of an "
              "[OpenFOAM](../how-to/openfoam.md) case, relative to the case file.",
              {.fallback = "none",
               .needs = {{"kind = \"su2\" or kind = \"openfoam\""}},
               .required = {{"kind = \"su2\" needs the configuration to run, relative to the case file",
                             "kind = \"su2\""},
                            {"kind = \"openfoam\" needs the folder of a case, relative to the case file",
                             "kind = \"openfoam\""}}}),
          key<&SolverSettings::warm>(
              "warm", su2_entries(),
              "Keys of SU2's configuration, with their values for runs that restart from a transferred "
              "solution: a number, or text as in the configuration.",
              {.fallback = "none", .needs = {{"kind = \"su2\""}}}),
          key<&SolverSettings::finish>(
              "finish", su2_entries(),
              "Keys of SU2's configuration, with their values for a second run in each cycle, which starts "
              "from the solution of the first one.",
              {.fallback = "none", .example = "{ MUSCL_TURB = \"YES\" }", .needs = {{"kind = \"su2\""}}})};
}

/// Checks the time steps, and combinations of several keys.
void check_times(const io::CaseTable& table, const EulerOptions& options) {
  const bool accurate = options.time == EulerOptions::Time::accurate;
  if (accurate && options.time_step && options.end_time / *options.time_step > flow::most_steps_in_time)
    table.refuse(
        "time_step",
        fmt::format(
            "would take {:.2g} steps to the end_time {}, of which there may be {:.0f}; give {:.2g} or more",
            options.end_time / *options.time_step, options.end_time, flow::most_steps_in_time,
            options.end_time / flow::most_steps_in_time));
  if (options.average_from && *options.average_from >= options.end_time)
    table.refuse("average_from", "must be below end_time, so that there is something to take means over");
}

/// Requires something that drives the flow if the free stream is at rest.
void require_driven_flow(const io::CaseTable& table, const SolverSettings& settings) {
  const EulerOptions& options = settings.euler;
  if (settings.kind != SolverSettings::Kind::euler || options.mach > 0) return;
  const bool is_heated = options.viscosity > 0 && !settings.wall_temperatures.empty();
  if (options.initial == EulerOptions::Initial::vortex || is_heated || !settings.pressures.empty()) return;
  table.refuse(
      "mach",
      "is 0, so nothing moves the gas and forces have no coefficients; set it above 0, or drive the flow "
      "by initial = \"vortex\", the pressure of an outflow or, with viscosity, a wall_temperature");
}

}  // namespace

const KeyTable<SolverSettings>& solver_keys() {
  const std::vector<Key<SolverSettings>> general{
      key<&SolverSettings::kind>("kind", choice(SolverSettings::kind_words),
                                 "Built-in solver, [your program](../how-to/own-solver.md), "
                                 "[SU2](../how-to/su2.md) or [OpenFOAM](../how-to/openfoam.md)."),
      key<&SolverSettings::euler, &EulerOptions::gamma>(
          "gamma", number({1, 10, true, false}), "Ratio of specific heats.",
          {.needs = {only_with("kind = \"euler\" or kind = \"command\" or kind = \"su2\"")}})};
  std::vector<Key<SolverSettings>> of_euler = joined<SolverSettings>(
      {KeyTable("", model_keys()).keys_of<&SolverSettings::euler>(),
       {key<&SolverSettings::reynolds>(
           "reynolds", number(io::Range::positive()),
           "Alternative to `viscosity`, which becomes `mach` times `reference_length` / "
           "`reynolds`.",
           {.fallback = "none",
            .needs = {{"no viscosity", "which it decides; give one of the two"},
                      {"mach > 0", "give viscosity instead"}}})},
       KeyTable("", march_keys()).keys_of<&SolverSettings::euler>()});
  for (Key<SolverSettings>& key : of_euler) key.text.needs.push_back(only_with("kind = \"euler\""));
  static const KeyTable<SolverSettings> keys{
      "solver", joined<SolverSettings>({general, of_euler, goal_keys(), command_keys()})};
  return keys;
}

void read_solver_table(const io::CaseTable& table, SolverSettings& settings) {
  settings.given = true;
  solver_keys().read(table, settings);
  EulerOptions& euler = settings.euler;
  if (settings.reynolds) euler.viscosity = euler.mach * euler.reference_length / *settings.reynolds;
  if (table.has("template") && settings.case_template.empty())
    table.refuse("template", "is empty; give a path relative to the case file");
  if (table.has("command") && settings.command.command.arguments.empty())
    table.refuse("command", "is empty; give the program to run and its arguments");
  check_times(table, euler);
  place_goals(table, settings);
  require_driven_flow(table, settings);
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
    if (rule.condition == BoundaryCondition::outflow && !has_pressure)
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
    flow::BoundaryChoice choice{boundary.name, boundary.condition, {}, {}};
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
    if (std::find(flow::euler_names.begin(), flow::euler_names.end(), name) != flow::euler_names.end())
      continue;
    if (name == flow::error_name && !settings.euler.goals.empty()) continue;
    if (name == flow::error_name)
      throw InputError(fmt::format(
          "{}: 'adapt.variable' names '{}', which the built-in solver writes where it knows what of; set "
          "solver.goal, as in goal = \"drag\"",
          case_path, name));
    throw InputError(fmt::format(
        "{}: 'adapt.variable' names '{}', which the built-in solver does not write; it may be {}{}",
        case_path, name, fmt::join(flow::euler_names, ", "),
        guess_for(name, {flow::euler_names.begin(), flow::euler_names.end()})));
  }
}

adapt::ChosenSolver chosen_solver(const SolverSettings& settings, const std::vector<BoundaryRule>& rules,
                                  const Geometry& geometry, const std::string& case_path) {
  if (settings.kind == SolverSettings::Kind::euler) {
    Mesh named;
    for (const Boundary& boundary : geometry.boundaries())
      named.boundaries.push_back({boundary.name, boundary.condition, {}});
    return euler_options(settings, rules, named);
  }
  const std::filesystem::path case_folder = std::filesystem::absolute(case_path).parent_path();
  if (settings.kind == SolverSettings::Kind::openfoam) {
    return adapt::OpenfoamSolver{(case_folder / settings.case_template).lexically_normal().string(),
                                 settings.command.ranks, settings.command.command.timeout};
  }
  adapt::CommandSolver solver = settings.command;
  solver.gamma = settings.euler.gamma;
  solver.case_folder = case_folder.string();
  if (settings.kind == SolverSettings::Kind::su2)
    return adapt::su2_solver_of((case_folder / settings.case_template).string(), std::move(solver),
                                settings.warm, settings.finish);
  return solver;
}

}  // namespace quadloop
