#include "app/report/layer_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesher/base/counted.hpp"

namespace quadloop::app {

namespace {

std::string heading(const std::vector<const char*>& columns) {
  std::string text = fmt::format("  {:<16}", "layers of");
  for (const char* column : columns) text += fmt::format("{:>11}", column);
  return text + "\n";
}

std::string name_cell(const std::string& name) { return fmt::format("    {:<13} ", name); }

std::string cell(double value) { return fmt::format("{:>11.4g}", value); }

std::string cell(std::int64_t value) { return fmt::format("{:>11}", value); }

std::string line_of(const BoundaryLayerReport& row) {
  return name_cell(row.boundary) + cell(std::int64_t{row.reached}) + cell(row.first_least) +
         cell(row.first_median) + cell(row.share_least) + cell(row.share_full) + cell(row.growth_least) +
         fmt::format("  ({:.5g}, {:.5g})\n", row.least.x, row.least.y);
}

std::string line_of(const LayerStatistics& row) {
  const double asked = row.asked > 0 ? row.thickness.least / row.asked : 0;
  return name_cell(row.boundary) + cell(std::int64_t{row.count}) + cell(row.columns) + cell(row.first.least) +
         cell(row.first.median) + cell(row.first.largest) + cell(row.growth.least) +
         cell(row.growth.largest) + cell(row.thickness.least) + cell(row.thickness.largest) +
         (asked > 0 ? cell(asked) : "") +
         (row.cut_columns > 0 ? fmt::format("  ({} more, at other parts)", row.cut_columns) : "") + "\n";
}

JsonObject json_of_row(const BoundaryLayerReport& row) {
  JsonObject json;
  json.add("boundary", row.boundary);
  json.add("count_asked", row.asked);
  json.add("count", row.reached);
  json.add("columns", row.columns);
  json.add("first_asked", row.first_asked);
  if (row.y_plus > 0) json.add("first_asked_most", row.first_asked_most);
  json.add("first_least", row.first_least);
  json.add("first_median", row.first_median);
  json.add("growth_asked", row.growth_asked);
  json.add("growth_least", row.growth_least);
  json.add("thickness_asked", row.thickness_asked);
  if (row.follows_flow) json.add("thickness_asked_most", row.thickness_asked_most);
  json.add("thickness_share_least", row.share_least);
  json.add("wall_share_full", row.share_full);
  json.add("least_at", std::vector{row.least.x, row.least.y});
  return json;
}

std::vector<double> listed(const Spread& spread) { return {spread.least, spread.median, spread.largest}; }

JsonObject json_of_row(const LayerStatistics& row) {
  JsonObject json;
  json.add("boundary", row.boundary);
  json.add("count", row.count);
  json.add("columns", row.columns);
  if (row.cut_columns > 0) json.add("cut_columns", row.cut_columns);
  json.add("first", listed(row.first));
  json.add("growth", listed(row.growth));
  json.add("thickness", listed(row.thickness));
  json.add("thickness_asked", row.asked);
  return json;
}

template <class Row>
void add_rows(Statistics& statistics, const std::vector<Row>& rows, const std::vector<const char*>& columns,
              std::size_t most) {
  if (rows.empty()) return;
  std::string text = heading(columns);
  std::vector<JsonObject> json;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i < most) text += line_of(rows[i]);
    json.push_back(json_of_row(rows[i]));
  }
  if (rows.size() > most)
    text += fmt::format("    {} more; --verbose or --json shows them\n", rows.size() - most);
  statistics.add_lines(text);
  statistics.add_member("layers", json_of(json));
}

void add_count(Statistics& statistics, const char* name, const MeshCounts& counts, const char* key) {
  const std::int64_t cells = counts.triangles + counts.quads;
  statistics.add_raw(name, std::to_string(cells), json_of(cells), key);
}

void add_shapes(Statistics& statistics, const QualitySummary& quality, const std::string& indent,
                const std::string& key, const WorstPlaces* worst) {
  if (quality.counts.triangles + quality.counts.quads == 0) worst = nullptr;
  statistics.add(indent + "worst quality", quality.worst, "{:.3f}", key + "worst_quality");
  if (worst != nullptr) statistics.add_place(worst->worst_quality, key + "worst_quality_at");
  statistics.add(indent + "mean quality", quality.mean, "{:.3f}", key + "mean_quality");
  statistics.add(indent + "smallest angle", quality.smallest_degrees, "{:.2f} degrees", key + "min_angle");
  if (worst != nullptr) statistics.add_place(worst->smallest_angle, key + "min_angle_at");
  statistics.add(indent + "largest angle", quality.largest_degrees, "{:.2f} degrees", key + "max_angle");
  if (worst != nullptr) statistics.add_place(worst->largest_angle, key + "max_angle_at");
}

}  // namespace

void add_layers(Statistics& statistics, const LayerReport& report, std::size_t most) {
  add_rows(statistics, report,
           {"count", "min first", "med first", "t/t_req", "full t", "growth", "minimum at"}, most);
}

void add_layers(Statistics& statistics, const std::vector<LayerStatistics>& layers, std::size_t most) {
  std::vector<const char*> columns{"count",  "columns", "first", "median", "largest",
                                   "growth", "to",      "thick", "to"};
  if (std::ranges::any_of(layers, [](const LayerStatistics& row) { return row.asked > 0; }))
    columns.push_back("t/t_req");
  add_rows(statistics, layers, columns, most);
}

void add_quality(Statistics& statistics, const QualitySummary& all, const QualityByLayers& by_layers,
                 const FaceStatisticsByLayers& faces, const WorstPlaces* worst) {
  const MeshCounts& counts = by_layers.layers.counts;
  const bool has_layers = counts.triangles + counts.quads > 0;
  if (!has_layers) return add_shapes(statistics, all, "", "", worst);
  statistics.add_member("worst_quality", json_of(all.worst));
  statistics.add_member("mean_quality", json_of(all.mean));
  statistics.add_member("min_angle", json_of(all.smallest_degrees));
  statistics.add_member("max_angle", json_of(all.largest_degrees));
  add_count(statistics, "cells in layers", counts, "layer_cells");
  statistics.add("  aspect ratio", faces.layers.aspect_ratio, "{:.4g}", "layer_aspect_ratio");
  statistics.add("  non-orthog.", faces.layers.non_orthogonality, "{:.2f} degrees",
                 "layer_non_orthogonality");
  statistics.add("  skewness", faces.layers.skewness, "{:.3f}", "layer_skewness");
  statistics.add_member("layer_min_angle", json_of(by_layers.layers.smallest_degrees));
  statistics.add_member("layer_max_angle", json_of(by_layers.layers.largest_degrees));
  statistics.add_member("layer_worst_quality", json_of(by_layers.layers.worst));
  add_count(statistics, "outside layers", by_layers.others.counts, "outer_cells");
  add_shapes(statistics, by_layers.others, "  ", "outer_", worst);
}

void add_objections(Statistics& statistics, const FaceStatisticsByLayers& faces,
                    const SolverStatistics& shape) {
  const auto& [layers, others] = faces;
  const double angle = std::max(layers.non_orthogonality, others.non_orthogonality),
               skewness = std::max(layers.skewness, others.skewness);
  const std::int64_t non_orthogonal = layers.non_orthogonal + others.non_orthogonal,
                     skew = layers.skew + others.skew, flat = layers.flat + others.flat;
  statistics.add_member("non_orthogonality", json_of(angle));
  statistics.add_member("skewness", json_of(skewness));
  statistics.add_member("aspect_ratio", json_of(std::max(layers.aspect_ratio, others.aspect_ratio)));
  statistics.add_member("non_orthogonal_edges", json_of(non_orthogonal));
  statistics.add_member("skew_edges", json_of(skew));
  statistics.add_member("flat_cells", json_of(flat));
  std::vector<std::string> objections;
  if (non_orthogonal > 0)
    objections.push_back(fmt::format("{} of non-orthogonality above {} degrees",
                                     counted(non_orthogonal, "face"), FaceStatistics::severe_degrees));
  if (skew > 0)
    objections.push_back(
        fmt::format("{} of skewness above {}", counted(skew, "face"), FaceStatistics::severe_skewness));
  if (flat > 0)
    objections.push_back(fmt::format("{} of aspect ratio above {}", counted(flat, "cell"),
                                     FaceStatistics::severe_aspect_ratio));
  if (objections.empty())
    objections.push_back(fmt::format(
        "all criteria satisfied (non-orthogonality {:.1f} degrees, skewness {:.2f})", angle, skewness));
  const std::string su2 = shape.inexact_nodes == 0
                              ? "linear fields are exact at all interior nodes"
                              : fmt::format("{:.2g} % of the quads are not parallelograms",
                                            100 * (1 - shape.parallelogram_share()));
  statistics.add_lines(fmt::format("  checkMesh: {}; SU2: {}\n", fmt::join(objections, ", "), su2));
}

}  // namespace quadloop::app
