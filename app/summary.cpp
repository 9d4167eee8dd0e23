#include "app/summary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "mesher/mesh/quality.hpp"

namespace quadloop {

namespace {

/// The most memory this process has ever held, in MiB; 0 where the system does not tell.
double peak_memory_mib() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != "VmHWM:") continue;
    double kib = 0;
    status >> kib;
    return kib / 1024;
  }
  return 0;
}

struct StageRow {
  std::string stage;
  double slowest = 0, mean = 0;
};

StageRow over_ranks(const Communicator& comm, const std::string& stage, double seconds) {
  const auto microseconds = static_cast<std::int64_t>(std::llround(seconds * 1e6));  // there is no floating-point sum, on purpose
  return {stage, comm.maximum(seconds), static_cast<double>(comm.sum(microseconds)) * 1e-6 / comm.size()};
}

std::string row(const std::string& name, const std::string& value) { return fmt::format("  {:<16}{:>14}\n", name, value); }
std::string row(const std::string& name, std::int64_t value) { return row(name, std::to_string(value)); }

}  // namespace

std::string summary_table(const Communicator& comm, const MeshResult& result, const StageSeconds& seconds, const std::vector<std::string>& files) {
  std::vector<StageRow> stages;
  for (const auto& [stage, of_rank] : seconds) stages.push_back(over_ranks(comm, stage, of_rank));
  const QualitySummary quality = summarise_quality(comm, result.mesh);
  const double memory = comm.maximum(peak_memory_mib());
  if (!comm.is_root()) return {};

  const TreeAttributes& counts = result.tree.attributes;
  const MeshReport& report = result.report;
  std::string text = row("nodes", counts.nodes) + row("triangles", counts.triangles) + row("quads", counts.quads);
  text += row("leaves", report.leaves) + row("cut leaves", report.cut_leaves);
  text += row("levels", fmt::format("{} to {}", report.coarsest_level, report.finest_level));
  text += row("worst quality", fmt::format("{:.3f}", quality.worst)) + row("mean quality", fmt::format("{:.3f}", quality.mean));
  text += row("smallest angle", fmt::format("{:.2f} degrees", quality.smallest_degrees));
  text += row("peak memory", fmt::format("{:.0f} MiB", memory)) + row("imbalance", fmt::format("{:.3f}", report.imbalance));
  text += "  seconds              slowest          mean\n";
  for (const StageRow& stage : stages) text += fmt::format("    {:<14}{:>14.3f}{:>14.3f}\n", stage.stage, stage.slowest, stage.mean);
  for (const std::string& file : files) text += fmt::format("  wrote {}\n", file);
  return text;
}

}  // namespace quadloop
