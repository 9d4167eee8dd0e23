#include "quadloop/case/adaptive_input.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <variant>

#include "adapt/solvers/openfoam_template.hpp"
#include "io/formats.hpp"
#include "io/input/case_file.hpp"
#include "io/input/geom_text.hpp"
#include "mesher/base/error.hpp"
#include "mesher/build/islands.hpp"
#include "quadloop/case/solver_settings.hpp"

namespace quadloop {

namespace {

/// Checks for errors that would stop the loop after the initial mesh.
void require_solver_files(const CaseArguments& arguments, const adapt::CommandSolver& solver) {
  const io::CaseTable table = *io::read_case(arguments.source, arguments.assignments).table("solver");
  const io::FileFormat *const mesh = io::format_of(solver.mesh), *const solution =
                                                                     io::format_of(solver.solution);
  if (mesh == nullptr || !mesh->holds(io::Content::mesh))
    table.refuse("mesh", "is '" + solver.mesh + "', but meshes are written as " +
                             io::suffixes_for({io::Content::mesh}) + "; end the name in one of these");
  if (solution == nullptr || !solution->holds(io::Content::solution) || !solution->is_read())
    table.refuse("solution", "is '" + solver.solution + "', but solutions are read from " +
                                 io::read_suffixes_for({io::Content::solution}, "and") +
                                 "; end the name in one of these");
  if (solver.solution == solver.mesh ||
      std::filesystem::path(solver.solution).stem() == adapt::CyclePaths::mesh_stem)
    table.refuse("solution",
                 "is '" + solver.solution + "', the name of a mesh file; give the solution another name");
  if (solver.solution == solver.state())
    table.refuse("solution", "is '" + solver.solution + "', the file of the initial state for " +
                                 solver.mesh + "; give the solution another name");
}

/// Returns what makes the geometry text to store with each cycle, if the next design's mesh is to be morphed
/// from it.
std::function<std::string()> outline_to_keep(const CaseInput& input) {
  if (!input.settings.morph_to) return {};
  MeshReport told_of_the_mesh;
  const Geometry meshed =
      without_small_islands(input.mesh->geometry, input.mesh->mesh.size.min, told_of_the_mesh);
  return [meshed] { return io::geom_text(meshed); };
}

/// Returns the solver of the case, if it can work.
adapt::ChosenSolver usable_solver(const CaseInput& input, const CaseArguments& arguments) {
  const Settings& settings = input.settings;
  const std::string& path = arguments.source.path;
  require_known_variables(settings.solver, settings.adapt->variables, path);
  adapt::ChosenSolver solver =
      chosen_solver(settings.solver, settings.outline.rules, input.mesh->geometry, path);
  if (const adapt::CommandSolver* const command = adapt::command_of(solver))
    require_solver_files(arguments, *command);
  if (const auto* openfoam = std::get_if<adapt::OpenfoamSolver>(&solver))
    adapt::read_openfoam_template(openfoam->case_template);  // rejects errors that would end the first cycle
  return solver;
}

}  // namespace

AdaptiveInput adaptive_input(CaseInput input, const CaseArguments& arguments, SolvedBy by) {
  const Settings& settings = input.settings;
  const adapt::AdaptOptions& adapt = adapt_options(settings, arguments.source.path);
  adapt::ChosenSolver solver;
  if (by == SolvedBy::solver_of_case) solver = usable_solver(input, arguments);
  std::function<std::string()> outline = outline_to_keep(input);
  AdaptiveInput prepared{
      {std::move(*input.mesh), adapt, std::move(solver), settings.formats, settings.values, settings.fields},
      settings.morph_to,
      std::move(input.extents),
      {}};
  prepared.adaptive.stream = settings.stream;
  prepared.adaptive.partitions = settings.partitions;
  prepared.adaptive.outline = std::move(outline);
  const flow::EulerOptions& flow = settings.solver.euler;
  if (!settings.solver.given && by == SolvedBy::solver_of_case)
    prepared.note = fmt::format("no table [solver]: the built-in solver runs at Mach {} and {} degrees",
                                flow.mach, flow.alpha);
  return prepared;
}

}  // namespace quadloop
