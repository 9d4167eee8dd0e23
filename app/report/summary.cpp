#include "app/report/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "app/report/layer_table.hpp"
#include "mesher/build/mesh_estimate.hpp"
#include "mesher/mesh/check/layer_statistics.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/check/solver_statistics.hpp"

namespace quadloop::app {

namespace {

/// Returns the peak memory of this process, in MiB; 0 if the system does not provide it.
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

std::string vanished_text(const std::vector<std::string>& boundaries) {
  constexpr std::size_t most_named = 10;
  if (boundaries.empty()) return {};
  const std::size_t named = std::min(most_named, boundaries.size());
  const std::string more =
      named < boundaries.size() ? fmt::format(" and {} more", boundaries.size() - named) : "";
  return fmt::format("  boundaries dropped, smaller than spacing.min: {}{}\n",
                     fmt::join(boundaries.begin(), boundaries.begin() + named, ", "), more);
}

}  // namespace

std::vector<StageRow> stage_rows(const Communicator& comm, const StageSeconds& seconds) {
  std::vector<StageRow> rows;
  for (const auto& [stage, sum] : added_up(seconds)) {
    const auto microseconds = std::llround(sum * 1e6);  // deliberately, there is no floating-point sum
    rows.push_back(
        {stage, comm.maximum(sum), static_cast<double>(comm.sum(microseconds)) / 1e6 / comm.size()});
  }
  return rows;
}

std::string stage_table(const std::vector<StageRow>& stages) {
  std::string text = "  seconds              slowest          mean\n";
  for (const auto& [stage, slowest, mean] : stages)
    text += fmt::format("    {:<14}{:>14.3f}{:>14.3f}\n", stage, slowest, mean);
  return text;
}

namespace {

void add_estimated_cells(Statistics& statistics, const MeshEstimate& estimate) {
  statistics.add_raw("cells, estimated", text_of_cells(estimate.cells), json_of(std::round(estimate.cells)),
                     "cells_estimated");
}

/// For one of `ranks` ranks.
void add_estimated_memory(Statistics& statistics, const std::string& name, const MeshEstimate& estimate,
                          int ranks) {
  const double estimated = estimate.bytes / ranks + estimate.bytes_of_rank;
  statistics.add_raw(name, text_of_bytes(estimated), json_of(std::round(estimated / (1 << 20))),
                     "estimated_memory_mib");
}

void add_sizes(Statistics& statistics, const MeshResult& result) {
  const TreeAttributes& counts = result.tree.attributes;
  const MeshReport& report = result.report;
  statistics.add("nodes", counts.nodes);
  statistics.add("triangles", counts.triangles);
  statistics.add("quads", counts.quads);
  add_estimated_cells(statistics, report.estimate);
  statistics.add("blocks", std::max<std::int64_t>(1, std::ssize(result.mesh.blocks.names)));
  statistics.add("regions", report.regions);
  statistics.add("leaves", report.leaves);
  statistics.add("cut leaves", report.cut_leaves);
  statistics.add_raw("levels", fmt::format("{} to {}", report.coarsest_level, report.finest_level),
                     json_list({json_of(report.coarsest_level), json_of(report.finest_level)}));
}

void add_shapes(Statistics& statistics, const SolverStatistics& shape) {
  statistics.add("parallelograms", shape.parallelogram_share(), "{:.4f}", "parallelogram_share");
  statistics.add("inexact nodes", shape.inexact_share(), "{:.4f}", "inexact_node_share");
  statistics.add("area ratio", shape.area_ratio_max, "{:.3g}", "area_ratio_max");
  statistics.add("passage cells", shape.passage_cells);
}

/// `peak` in MiB; the estimate is for one of `ranks` ranks.
void add_memory(Statistics& statistics, double peak, const MeshEstimate& estimate, int ranks) {
  statistics.add("peak memory", peak, "{:.0f} MiB", "peak_memory_mib");
  add_estimated_memory(statistics, "estimated", estimate, ranks);
}

}  // namespace

void add_estimate(Statistics& statistics, const MeshEstimate& estimate, int ranks) {
  add_estimated_cells(statistics, estimate);
  add_estimated_memory(statistics, "memory of a rank", estimate, ranks);
}

MeshSummary summarise(const Communicator& comm, const GeneratedMesh& generated, const StageSeconds& seconds,
                      const std::vector<std::string>& files) {
  const MeshResult& result = generated.result;
  MeshSummary summary{{},
                      solver_statistics(comm, result.mesh),
                      stage_rows(comm, seconds),
                      files,
                      result.report.boundaries_vanished};
  const QualitySummary quality = summarise_quality(comm, result.mesh);
  LayerPlaces places;
  QualityByLayers by_layers;
  if (has_layers(result.mesh)) {
    places = layer_places(comm, result.mesh);
    by_layers = quality_by_layers(comm, result.mesh, places);
  }
  const FaceStatisticsByLayers faces = face_statistics(comm, result.mesh, places);
  const double memory = comm.maximum(peak_memory_mib());
  if (!comm.is_root()) return summary;
  Statistics& statistics = summary.statistics;
  add_sizes(statistics, result);
  add_quality(statistics, quality, by_layers, faces);
  add_shapes(statistics, summary.shape);
  add_objections(statistics, faces, summary.shape);
  add_memory(statistics, memory, result.report.estimate, comm.size());
  statistics.add("imbalance", result.report.imbalance, "{:.3f}");
  add_layers(statistics, generated.layers);
  return summary;
}

std::string table_of(const MeshSummary& summary) {
  std::string text = summary.statistics.table() + stage_table(summary.stages);
  for (const std::string& file : summary.files) text += fmt::format("  wrote {}\n", file);
  return text + vanished_text(summary.boundaries_vanished);
}

JsonObject record_of(const MeshSummary& summary) {
  JsonObject json = summary.statistics.record();
  json.add("seconds", record_of(summary.stages));
  json.add("boundaries_vanished", summary.boundaries_vanished);
  return json;
}

JsonObject record_of(const std::vector<StageRow>& stages) {
  JsonObject json;
  for (const auto& [stage, slowest, mean] : stages) {
    JsonObject row;
    row.add("slowest", slowest);
    row.add("mean", mean);
    json.add(stage, row);
  }
  return json;
}

}  // namespace quadloop::app
