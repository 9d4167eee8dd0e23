#include "app/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "mesher/mesh/mesh_estimate.hpp"
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
  double slowest = 0, mean = 0;
};

StageRow over_ranks(const Communicator& comm, double seconds) {
  const auto microseconds = static_cast<std::int64_t>(std::llround(seconds * 1e6));  // there is no floating-point sum, on purpose
  return {comm.maximum(seconds), static_cast<double>(comm.sum(microseconds)) * 1e-6 / comm.size()};
}

std::string row(const std::string& name, const std::string& value) { return fmt::format("  {:<16}{:>14}\n", name, value); }
std::string row(const std::string& name, std::int64_t value) { return row(name, std::to_string(value)); }

std::string vanished_text(const std::vector<std::string>& boundaries) {
  constexpr std::size_t most_named = 10;
  if (boundaries.empty()) return {};
  const std::size_t named = std::min(most_named, boundaries.size());
  const std::string more = named < boundaries.size() ? fmt::format(" and {} more", boundaries.size() - named) : "";
  return fmt::format("  boundaries that vanished, smaller than spacing.min: {}{}\n",
                     fmt::join(boundaries.begin(), boundaries.begin() + static_cast<std::ptrdiff_t>(named), ", "), more);
}

}  // namespace

std::string stage_table(const Communicator& comm, const StageSeconds& seconds) {
  std::string text = "  seconds              slowest          mean\n";
  for (const auto& [stage, of_rank] : seconds) {
    const StageRow row_of_stage = over_ranks(comm, of_rank);
    text += fmt::format("    {:<14}{:>14.3f}{:>14.3f}\n", stage, row_of_stage.slowest, row_of_stage.mean);
  }
  return text;
}

std::string summary_table(const Communicator& comm, const MeshResult& result, const StageSeconds& seconds, const std::vector<std::string>& files) {
  const std::string stages = stage_table(comm, seconds);
  const QualitySummary quality = summarise_quality(comm, result.mesh);
  const double memory = comm.maximum(peak_memory_mib());
  if (!comm.is_root()) return {};

  const TreeAttributes& counts = result.tree.attributes;
  const MeshReport& report = result.report;
  std::string text = row("nodes", counts.nodes) + row("triangles", counts.triangles) + row("quads", counts.quads);
  text += row("cells, estimated", text_of_cells(report.estimate.cells));
  text += row("leaves", report.leaves) + row("cut leaves", report.cut_leaves);
  text += row("levels", fmt::format("{} to {}", report.coarsest_level, report.finest_level));
  text += row("worst quality", fmt::format("{:.3f}", quality.worst)) + row("mean quality", fmt::format("{:.3f}", quality.mean));
  text += row("smallest angle", fmt::format("{:.2f} degrees", quality.smallest_degrees));
  text += row("peak memory", fmt::format("{:.0f} MiB", memory)) +
          row("estimated", text_of_bytes(report.estimate.bytes / comm.size() + report.estimate.bytes_of_rank)) +
          row("imbalance", fmt::format("{:.3f}", report.imbalance));
  text += stages;
  for (const std::string& file : files) text += fmt::format("  wrote {}\n", file);
  return text + vanished_text(report.boundaries_vanished);
}

}  // namespace quadloop
