#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include "adapt/loop/run_in_folder.hpp"
#include "adapt/solvers/cycle_paths.hpp"
#include "app/command.hpp"
#include "app/command_line.hpp"
#include "app/report/estimate_report.hpp"
#include "app/report/extent_report.hpp"
#include "generate/mesh_trial.hpp"
#include "io/files/interruption.hpp"
#include "io/formats.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/log.hpp"
#include "mesher/build/mesh_estimate.hpp"
#include "quadloop/case/adaptive_input.hpp"
#include "quadloop/case/case_input.hpp"
#include "quadloop/case/design_start.hpp"

namespace quadloop::app {

namespace {

struct AdaptArguments {
  std::string case_path, folder, from, geometry;
  std::optional<int> cycles;
  bool resume = false, dry_run = false;
  std::vector<std::string> assignments;
  std::optional<double> max_cells;
};

std::string line_of(const adapt::CycleRecord& record) {
  std::string line =
      fmt::format("cycle {:>2}  {:>8} nodes  {}", record.cycle, record.nodes, adapt::quality_text(record));
  if (record.morphed) line += *record.morphed ? "  morphed" : "  remeshed";
  if (record.cl) line += fmt::format("  cl {:.5f}  cd {:.5f}", *record.cl, *record.cd);
  if (record.residual) line += fmt::format("  residual {:.1e}", *record.residual);
  if (record.log_residual) line += fmt::format(" (10^{:.2f})", *record.log_residual);
  if (record.converged == false) line += "  not converged";
  if (record.estimate) line += fmt::format("  error {:.3e}", *record.estimate);
  if (record.order) line += fmt::format("  order {:.2f}", *record.order);
  if (!record.passes.empty()) line += fmt::format("  after {} passes", record.passes.size());
  double seconds = 0;
  for (const auto& stage : record.seconds) seconds += stage.second;
  line += fmt::format("  {:.1f} s", seconds);
  for (const auto& [boundary, least, largest] : record.first_heights)
    line += fmt::format("\n          target first heights on {}: {:.4g} to {:.4g}", boundary, least, largest);
  for (const auto& [boundary, least, largest] : record.thickness)
    line += fmt::format("\n          target thickness of layers on {}: {:.4g} to {:.4g}", boundary, least,
                        largest);
  return line;
}

/// Adds a cycle's data and files to those of the run.
void keep(const adapt::CycleRecord& record, const std::string& folder, std::vector<JsonObject>& cycles,
          CommandRecord& of_run) {
  cycles.push_back(adapt::statistics_of(record));
  cycles.back().add("seconds", adapt::seconds_of(record));
  of_run.statistics = {};
  of_run.statistics.add("folder", folder);
  of_run.statistics.add("cycles", cycles);
  std::vector<std::string> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(folder + "/" + adapt::cycle_name(record.cycle)))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  of_run.files.insert(of_run.files.end(), files.begin(), files.end());
}

/// Returns a line if the run ended before its last cycle; else empty.
std::string why_ended(const adapt::LoopEnd& end) {
  if (end.settled) return fmt::format("  cycle {} satisfies adapt.until, so the run ends\n", end.last);
  if (!end.nothing_to_change) return {};
  return fmt::format("  after cycle {} no cell is refined or coarsened, so the run ends: {}\n", end.last,
                     end.left->plan.reason_for_no_change);
}

std::string closing_line(const std::string& folder, const adapt::LoopEnd& end) {
  const int first = end.first, last = end.last;
  if (first > last && end.stopped) return {};
  if (first > last)
    return fmt::format("  all cycles exist already: {}/{} to {}\n", folder, adapt::cycle_name(0),
                       adapt::cycle_name(last));
  if (first == last) return fmt::format("  wrote {}/{}\n", folder, adapt::cycle_name(last));
  return fmt::format("  wrote {}/{} to {}\n", folder, adapt::cycle_name(first), adapt::cycle_name(last));
}

std::string stop_message(const std::string& folder, const adapt::LoopEnd& end) {
  const std::string when = end.last < 0 ? "before the first cycle" : "after " + adapt::cycle_name(end.last);
  return fmt::format("{}: ended {} by SIGUSR1; continue with --resume", folder, when);
}

std::string extents_text(const std::vector<FileExtent>& extents) {
  std::string text;
  for (const std::string& line : extent_lines(extents)) text += "  " + line + "\n";
  return text;
}

std::string folder_of(const AdaptArguments& arguments) {
  if (!arguments.folder.empty()) return arguments.folder;
  return std::filesystem::path(arguments.case_path).stem().string() + ".adapt";
}

/// For messages.
const std::string& outline_file(const AdaptArguments& arguments) {
  return arguments.geometry.empty() ? arguments.case_path : arguments.geometry;
}

/// Returns the files of a cycle with the mesh.
std::vector<std::string> cycle_mesh_files(const std::vector<std::string>& formats) {
  const adapt::CyclePaths paths{"cycle_NN"};
  std::vector<std::string> files;
  for (const std::string& format : adapt::cycle_formats(formats)) files.push_back(paths.mesh(format));
  files = io::with_files_beside(files);
  files.push_back(paths.tree());
  return files;
}

/// Reports the estimated cells, memory and file sizes of a run, whose cycles have at most adapt.max_nodes
/// nodes. Nothing is generated.
void report_estimate(const CommandContext& context, const AdaptArguments& arguments,
                     const AdaptiveInput& input) {
  constexpr int variables = 4;          // of a flow
  constexpr double of_flow_node = 2e3;  // bytes of the built-in solver
  const adapt::AdaptiveCase& adaptive = input.adaptive;
  const MeshType type = adaptive.mesh.mesh.type;
  const DemandedSplits none(context.comm, {});
  const MeshEstimate first = MeshTrial(context.comm, adaptive.mesh).estimate(none);
  if (arguments.max_cells) require_within(first, adaptive.mesh.geometry, adaptive.mesh.mesh, none);
  const auto& most = adaptive.adapt.max_nodes;
  MeshEstimate largest = most ? grown_to(first, type, static_cast<double>(*most)) : first;
  if (!adapt::is_external(adaptive.solver)) largest.bytes += of_flow_node * nodes_of(largest, type);
  Statistics statistics;
  statistics.add_raw("cells of cycle_00", text_of_cells(first.cells), json_of(std::round(first.cells)),
                     "first_cells_estimated");
  add_run_estimate(statistics, largest, context.comm.size());
  const FileSizes sizes(cycle_mesh_files(adaptive.formats), type, largest, variables);
  sizes.add_to(statistics);
  const int cycles = adaptive.adapt.cycles + 1;
  add_file_sum(statistics, "files of a cycle", sizes.sum(), "bytes_of_cycle");
  add_file_sum(statistics, fmt::format("of {} cycles", cycles), cycles * sizes.sum(), "bytes_of_run");
  context.record.statistics = statistics.record();
  if (!most)
    context.warn(
        {"adapt.max_nodes is not set: the sizes of later meshes are not known, and are taken as "
         "those of the first one"});
  if (context.shows_table()) std::cout << statistics.table(24) << "  nothing was written\n";
}

void run_adapt(const CommandContext& context, const AdaptArguments& arguments) {
  const Communicator& comm = context.comm;
  const io::StopRequest stop;
  std::optional<AdaptiveInput> input;
  std::optional<FormerMesh> former;
  if (!arguments.from.empty()) former = find_former_mesh(comm, arguments.from);
  CaseArguments of_case{arguments.case_path, arguments.assignments, arguments.geometry, {}};
  if (former) of_case.saved = former->tree.attributes;
  CaseInput loaded = load_case(comm, of_case, context.record.noted);
  comm.together([&] { input = adaptive_input(std::move(loaded), of_case); });
  adapt::AdaptiveCase& adaptive = input->adaptive;
  if (arguments.cycles) adaptive.adapt.cycles = *arguments.cycles;
  adaptive.mesh.mesh.limit = mesh_limit(comm, arguments.max_cells);
  if (comm.is_root() && !input->note.empty()) log::information(input->note);
  if (arguments.dry_run) return report_estimate(context, arguments, *input);
  std::string extents = extents_text(input->extents);
  const std::string folder = folder_of(arguments);
  context.warn(former ? former->warnings : Warnings{});
  std::vector<JsonObject> cycles;
  adapt::RunReport report;
  report.warning = [&](const std::string& warning) { context.warn({warning}); };
  report.cycle = [&](const adapt::CycleRecord& record, const std::vector<std::string>& of_cycle) {
    if (context.shows_table()) std::cout << std::exchange(extents, {}) << line_of(record) << std::endl;
    if (comm.is_root()) keep(record, folder, cycles, context.record);
    context.warn(of_cycle);
  };
  report.stop_requested = [&stop] { return stop.has_come(); };
  context.record.statistics.add("folder", folder);
  context.record.statistics.add("cycles", cycles);
  std::optional<adapt::DesignStart> start;
  if (former) start = read_start(comm, *former, input->morph_to, outline_file(arguments), adaptive.settings);
  const adapt::LoopEnd end = adapt::run_in_folder(comm, adaptive, folder, arguments.resume, report, start);
  if (comm.is_root()) context.record.statistics.add("nothing_to_change", end.nothing_to_change);
  if (comm.is_root()) context.record.statistics.add("stopped", end.stopped);
  if (comm.is_root() && !adaptive.adapt.until.empty()) context.record.statistics.add("settled", end.settled);
  if (context.shows_table()) std::cout << why_ended(end) << closing_line(folder, end) << std::flush;
  if (end.stopped) throw Stopped(stop_message(folder, end));
}

}  // namespace

void add_adapt_command(CommandLine& line, CommandContext& context) {
  auto arguments = std::make_shared<AdaptArguments>();
  Command command = line.add_command("adapt", "run the adaptive loop of a case file: mesh, solve, adapt");
  command.add_case_argument(arguments->case_path);
  command.add_option("-o,--output", arguments->folder, "folder of the cycles (default: CASE.adapt)")
      .value_name("DIR");
  command
      .add_option("--from", arguments->from,
                  "start from mesh and flow of another run, on the current geometry: its folder, that of a "
                  "cycle, or a mesh beside its tree")
      .value_name("RUN");
  command.add_option("--geometry", arguments->geometry, "changed geometry, instead of that of the case")
      .value_name("NEW.geom");
  command.add_option("--cycles", arguments->cycles, "number of adaptation cycles, instead of adapt.cycles")
      .value_name("N")
      .between(0, 10000);
  command.add_flag("--resume", arguments->resume, "continue after the last complete cycle in the folder");
  command.add_max_cells_option(arguments->max_cells);
  command.add_flag("--dry-run", arguments->dry_run,
                   "report the estimated cells, memory of a rank and file sizes for adapt.max_nodes; "
                   "generate and write nothing");
  command.add_set_option(arguments->assignments, "solver.mach=0.7");
  command.set_work([&context, arguments] { run_adapt(context, *arguments); });
}

}  // namespace quadloop::app
