#include "adapt/loop/run_in_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "adapt/loop/passes.hpp"
#include "adapt/loop/resume.hpp"
#include "adapt/loop/template_files.hpp"
#include "adapt/solvers/wall_quantities.hpp"
#include "flow/adjoint/estimate_goals.hpp"
#include "flow/euler/euler_solver.hpp"
#include "io/formats.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::adapt {

namespace {

CycleRecord record_of_case(const AdaptiveCase& adaptive) {
  CycleRecord record;
  record.geometry_digest = adaptive.mesh.geometry.digest();
  record.case_digest = run_digest(adaptive.settings, record.geometry_digest);
  record.settings = adaptive.settings;
  const CaseSettings files = template_files(adaptive.solver);
  if (!files.empty()) record.template_digest = template_digest(files);
  record.settings.insert(record.settings.end(), files.begin(), files.end());
  std::ranges::sort(record.settings);
  return record;
}

/// Returns the file options; `adaptive` must outlive them.
CycleFileOptions file_options(const AdaptiveCase& adaptive) {
  CycleFileOptions options{cycle_formats(adaptive.formats), {}, 1.4, adaptive.fields, [&adaptive] {
                             return record_of_case(adaptive);
                           }};
  options.partitions = adaptive.partitions;
  options.outline = adaptive.outline;
  if (const CommandSolver* const command = command_of(adaptive.solver)) {
    options.read_by_solver = {command->mesh};
    options.gamma = command->gamma;
  } else if (const auto* euler = std::get_if<flow::EulerOptions>(&adaptive.solver)) {
    options.gamma = euler->gamma;
  }
  return options;
}

/// The built-in solver, for which inner lines are no boundaries.
flow::FlowSolver built_in_solver(const flow::EulerOptions& options) {
  return [solver = flow::euler_solver(options, flow::estimate_goals(options))](
             const Communicator& comm, const Mesh& mesh, const Field& start, int cycle) {
    if (std::ranges::none_of(mesh.boundaries, &BoundaryEdges::inner_line))
      return solver(comm, mesh, start, cycle);
    Mesh bounded = mesh;
    std::erase_if(bounded.boundaries, [](const BoundaryEdges& edges) { return edges.inner_line; });
    return solver(comm, bounded, start, cycle);
  };
}

flow::FlowSolver outer_solver_in(const CycleFolders& folders, const ChosenSolver& chosen) {
  const auto folder_of = [&folders](int cycle) { return folders.under_way(cycle); };
  if (const auto* su2 = std::get_if<Su2Solver>(&chosen)) return su2_solver(*su2, folder_of);
  if (const auto* openfoam = std::get_if<OpenfoamSolver>(&chosen))
    return openfoam_solver(*openfoam, folder_of);
  return command_solver(std::get<CommandSolver>(chosen), folder_of);
}

flow::FlowSolver solver_in(const CycleFolders& folders, const AdaptiveCase& adaptive) {
  if (const auto* options = std::get_if<flow::EulerOptions>(&adaptive.solver))
    return built_in_solver(*options);
  flow::FlowSolver solver = outer_solver_in(folders, adaptive.solver);
  return adaptive.stream ? with_wall_quantities(std::move(solver), *adaptive.stream) : solver;
}

/// Returns the built-in solver with a loose convergence tolerance, at which shocks and edges are already in
/// position. Output functionals are estimated only if the meshes follow them.
flow::FlowSolver rough_solver(const AdaptiveCase& adaptive) {
  constexpr double enough = 1e-2;
  const auto* options = std::get_if<flow::EulerOptions>(&adaptive.solver);
  QUADLOOP_REQUIRE(options != nullptr, "passes are for the built-in solver");
  flow::EulerOptions rough = *options;
  rough.tolerance = std::max(rough.tolerance, enough);
  rough.unsteady = flow::EulerOptions::Unsteady::stop;
  if (adaptive.adapt.source != AdaptOptions::Source::error) rough.goals.clear();
  return built_in_solver(rough);
}

/// Returns the initial mesh of a case with passes; without passes an empty function.
FirstMesh mesh_of_passes(const Communicator& comm, const AdaptiveCase& adaptive) {
  if (adaptive.adapt.passes == 0) return {};
  return [&] { return mesh_after_passes(comm, adaptive.mesh, adaptive.adapt, rough_solver(adaptive)); };
}

/// Returns the result of the last complete cycle of an earlier run, from its files. The files of a finished
/// run are checked too, so that damage is reported. *Collective.*
CycleEnd left_by_earlier_run(const Communicator& comm, const AdaptiveCase& adaptive,
                             const CycleFolders& folders, int cycle, const RunReport& report) {
  const std::string folder = folders.whole(cycle);
  for (const std::string& warning : require_same_run(comm, folder, record_of_case(adaptive)))
    report.warning(warning);
  CycleEnd left{read_earlier_cycle(comm, folder), {}};
  left.values = read_earlier_values(comm, folder);
  if (cycle > 0 && !adaptive.adapt.until.empty()) {
    const CycleValues before = read_earlier_values(comm, folders.whole(cycle - 1));
    left.settled = have_settled(adaptive.adapt.until, before, left.values);
  }
  if (cycle >= adaptive.adapt.cycles || left.settled) return left;
  left.plan = plan_adaptation(comm, adaptive.mesh, adaptive.adapt, left.solved);
  if (left.plan.changes_mesh()) return left;
  for (const std::string& warning : left.plan.warnings) report.warning(warning);
  return left;
}

/// Returns a line that identifies the start, for CycleFolders::open().
std::string begun_with(const DesignStart& start) {
  return fmt::format("{:016x} {}", start.solved.tree.attributes.coordinate_digest, start.solved.file);
}

}  // namespace

FolderRun::FolderRun(const Communicator& comm, const AdaptiveCase& adaptive, const std::string& folder,
                     bool resume, const RunReport& report, const std::optional<DesignStart>& start)
    : comm_{comm}, adaptive_{adaptive}, adapt_{adaptive.adapt}, folders_(comm, folder) {
  require_min_in_tree(adaptive.mesh, adaptive.adapt);  // checked before any flow is solved
  LoopStart of_loop = start_of(resume, report, start);
  files_.emplace(comm, folders_, file_options(adaptive), report.cycle);
  loop_.emplace(comm, adaptive.mesh, adapt_, *files_, std::move(of_loop));
  loop_->stop_when(report.stop_requested);
}

LoopStart FolderRun::start_of(bool resume, const RunReport& report, const std::optional<DesignStart>& start) {
  LoopStart of_loop;
  of_loop.first = folders_.open(resume, start ? begun_with(*start) : std::string());
  if (resume && of_loop.first == 0)
    report.warning(folders_.folder() +
                   ": contains no complete cycle to continue; the run begins with cycle 0");
  if (of_loop.first > 0)
    of_loop.before = std::make_shared<CycleEnd>(
        left_by_earlier_run(comm_, adaptive_, folders_, of_loop.first - 1, report));
  if (start) {
    adapt_.passes = 0;  // the mesh is already adapted
    of_loop.mesh = [this, &start] {
      return continued_mesh(comm_, adaptive_.mesh, start->solved, start->wish, adapt_.transfer);
    };
  } else {
    of_loop.mesh = mesh_of_passes(comm_, adaptive_);
  }
  return of_loop;
}

void FolderRun::discard_unfinished() { folders_.discard(loop_->cycle()); }

flow::FlowSolver FolderRun::solver() const { return solver_in(folders_, adaptive_); }

std::vector<std::string> cycle_formats(const std::vector<std::string>& of_case) {
  std::vector<std::string> formats = io::default_formats();
  for (const std::string& format : of_case) {
    if (std::ranges::find(formats, format) == formats.end()) formats.push_back(format);
  }
  return formats;
}

bool is_external(const ChosenSolver& solver) { return !std::holds_alternative<flow::EulerOptions>(solver); }

LoopStart start_in_memory(const Communicator& comm, const AdaptiveCase& adaptive) {
  require_min_in_tree(adaptive.mesh, adaptive.adapt);
  LoopStart start;
  start.mesh = mesh_of_passes(comm, adaptive);
  return start;
}

flow::FlowSolver solver_in_memory(const AdaptiveCase& adaptive) {
  return built_in_solver(std::get<flow::EulerOptions>(adaptive.solver));
}

LoopEnd run_in_folder(const Communicator& comm, const AdaptiveCase& adaptive, const std::string& folder,
                      bool resume, const RunReport& report, const std::optional<DesignStart>& start) {
  FolderRun run(comm, adaptive, folder, resume, report, start);
  return run_to_end(comm, run.loop(), run.solver());
}

}  // namespace quadloop::adapt
