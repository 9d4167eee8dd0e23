#include "adapt/loop/loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "adapt/loop/cycle_folders.hpp"
#include "adapt/loop/resume.hpp"
#include "adapt/transfer/transfer.hpp"
#include "io/cgns/cgns_file.hpp"
#include "io/files/output_file.hpp"
#include "io/mesh_file.hpp"
#include "io/native/native_file.hpp"
#include "io/tree/tree_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/progress.hpp"
#include "mesher/base/timer.hpp"
#include "mesher/mesh/check/quality.hpp"

namespace quadloop {

namespace {

/// What a cycle leaves to the next one, as its files have it.
struct Left {
  SolvedMesh solved;
  AdaptationPlan plan;
};

/// From the root rank. *Collective.*
void write_text(const Communicator& comm, const std::string& path, const std::string& text) {
  OutputSet outputs(comm);
  const StagedFile staged = outputs.stage(path);
  comm.together([&] {
    if (!comm.is_root()) return;
    OutputFile file(staged);
    file.write(text);
    file.close();
  });
  outputs.commit();
}

class AdaptiveRun {
 public:
  AdaptiveRun(const Communicator& comm, const AdaptiveCase& adaptive, const std::string& folder,
              const RunReport& report)
      : comm_{comm}, case_{adaptive}, folders_{comm, folder}, report_{report} {}

  RunEnd run(bool resume) {
    const int first = folders_.open(resume);
    if (resume && first == 0)
      report_.warning(folders_.folder() +
                      ": holds no whole cycle to go on after; the run begins with cycle 0");
    std::optional<Left> left;
    if (first > 0) left = left_by_earlier_run(first - 1);
    int next = first;
    const auto stands = [&] { return left && next <= case_.adapt.cycles && !left->plan.changes_mesh(); };
    for (; next <= case_.adapt.cycles && !stands(); ++next) left = run_cycle(next, left);
    return {first, next - 1, stands()};
  }

 private:
  /// A finished run is looked at too: whoever resumes it is told of damage.
  Left left_by_earlier_run(int cycle) const {
    const std::string folder = folders_.whole(cycle);
    for (const std::string& warning : require_same_run(comm_, folder, record_of_case()))
      report_.warning(warning);
    Left left{read_earlier_cycle(comm_, folder), {}};
    if (cycle >= case_.adapt.cycles) return left;
    left.plan = plan_adaptation(comm_, case_.mesh, case_.adapt, left.solved);
    if (left.plan.changes_mesh()) return left;
    for (const std::string& warning : left.plan.warnings) report_.warning(warning);
    return left;
  }

  Left left_in(const std::string& folder) const {
    Left left{read_cycle(comm_, folder), {}};
    left.plan = plan_adaptation(comm_, case_.mesh, case_.adapt, left.solved);
    return left;
  }

  CycleRecord record_of_case() const {
    CycleRecord record;
    record.geometry_digest = case_.mesh.geometry.digest();
    record.case_digest = run_digest(case_.settings, record.geometry_digest);
    record.settings = case_.settings;
    return record;
  }

  Left run_cycle(int cycle, const std::optional<Left>& before) {
    StageTimes times;
    const std::string folder = folders_.under_way(cycle);
    folders_.begin(cycle);
    progress::set_prefix(fmt::format("cycle {} of {}", cycle, case_.adapt.cycles));
    times.begin("mesh");
    const CarriedMesh carried = before ? carry_over(comm_, case_.mesh, before->plan, before->solved)
                                       : CarriedMesh{generate_mesh(comm_, case_.mesh), {}, {}, 0, {}};
    const MeshResult& result = carried.generated.result;
    times.begin("write");
    std::optional<Solution> start;
    if (before) start = carried.start;
    write_start(folder, result, start);
    times.begin("solve");
    const SolvedFlow flow = solve_flow(comm_, case_.solver, result.mesh, start, folder, cycle);
    times.begin("write");
    write_solved(folder, result.mesh, flow.solution);
    times.begin("adapt");
    Left left = left_in(folder);
    times.end();
    const CycleRecord record = record_of(cycle, carried, flow, left.plan, times);
    std::vector<std::string> warnings = result.report.warnings;
    if (!before) append_renames(result.mesh, warnings);
    warnings.insert(warnings.end(), flow.warnings.begin(), flow.warnings.end());
    warnings.insert(warnings.end(), left.plan.warnings.begin(), left.plan.warnings.end());
    write_text(comm_, folder + "/log.txt", log_text(record, flow.notes, warnings));
    write_text(comm_, folder + "/record.json", json_text(record));
    folders_.finish(cycle);
    progress::set_prefix("");
    report_.cycle(record, warnings);
    return left;
  }

  void write_start(const std::string& folder, const MeshResult& result,
                   const std::optional<Solution>& start) const {
    OutputSet outputs(comm_);
    write_native(outputs, result.mesh, folder + "/mesh.mesh", start ? &*start : nullptr);
    write_tree(outputs, result.tree, folder + "/mesh.tree.h5");
    outputs.commit();
  }

  void write_solved(const std::string& folder, const Mesh& mesh, const Solution& solution) const {
    OutputSet outputs(comm_);
    write_native(outputs, mesh, folder + "/mesh.mesh", &solution);
    write_cgns(outputs, mesh, folder + "/mesh.cgns", &solution);
    for (const std::string& format : case_.formats) {
      if (format != "mesh" && format != "cgns")
        write_mesh(outputs, mesh, folder + "/mesh." + format, &solution, gamma_of(case_.solver));
    }
    outputs.commit();
  }

  /// Of every file that a cycle's mesh is written to; said of the first cycle alone.
  void append_renames(const Mesh& mesh, std::vector<std::string>& warnings) const {
    std::vector<std::string> files{"mesh.cgns"};
    for (const std::string& format : case_.formats) files.push_back("mesh." + format);
    if (const auto* command = std::get_if<CommandSolver>(&case_.solver)) files.push_back(command->mesh);
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end()), files.end());
    for (const std::string& file : files) {
      for (std::string& line : renames_in(mesh, file)) warnings.push_back(std::move(line));
    }
  }

  CycleRecord record_of(int cycle, const CarriedMesh& carried, const SolvedFlow& flow,
                        const AdaptationPlan& plan, const StageTimes& times) const {
    const QualitySummary quality = summarise_quality(comm_, carried.generated.result.mesh);
    CycleRecord record = record_of_case();
    record.cycle = cycle;
    record.nodes = quality.counts.nodes;
    record.triangles = quality.counts.triangles;
    record.quads = quality.counts.quads;
    record.leaves = carried.generated.result.report.leaves;
    record.worst_angle = quality.smallest_degrees;
    record.mean = plan.mean;
    record.deviation = plan.deviation;
    record.refined = plan.refined;
    record.coarsened = plan.coarsened;
    record.outside = carried.outside;
    record.drift = carried.drift;
    record.cl = flow.cl;
    record.cd = flow.cd;
    record.residual = flow.residual;
    for (const auto& [stage, seconds] : times.stages())
      add_seconds(record.seconds, stage, comm_.maximum(seconds));
    return record;
  }

  static void add_seconds(std::vector<std::pair<std::string, double>>& all, const std::string& stage,
                          double seconds) {
    for (auto& [name, sum] : all) {
      if (name != stage) continue;
      sum += seconds;
      return;
    }
    all.emplace_back(stage, seconds);
  }

  static std::string log_text(const CycleRecord& record, const std::vector<std::string>& notes,
                              const std::vector<std::string>& warnings) {
    std::string text =
        fmt::format("cycle {}: {} nodes, {} triangles, {} quads, smallest angle {:.1f}\n", record.cycle,
                    record.nodes, record.triangles, record.quads, record.worst_angle);
    for (const std::string& line : notes) text += line + "\n";
    for (const std::string& line : warnings) text += "warning: " + line + "\n";
    text += fmt::format("marks for the next cycle: {} leaves to be split, {} to go\n", record.refined,
                        record.coarsened);
    for (const auto& [stage, seconds] : record.seconds) text += fmt::format("{} {:.2f} s\n", stage, seconds);
    return text;
  }

  const Communicator& comm_;
  const AdaptiveCase& case_;
  CycleFolders folders_;
  const RunReport& report_;
};

}  // namespace

RunEnd run_adaptation(const Communicator& comm, const AdaptiveCase& adaptive, const std::string& folder,
                      bool resume, const RunReport& report) {
  return AdaptiveRun(comm, adaptive, folder, report).run(resume);
}

}  // namespace quadloop
