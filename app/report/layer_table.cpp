#include "app/report/layer_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace quadloop {

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

std::string line_of(const LayerFigures& row) {
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
  json.add("thickness_share_least", row.share_least);
  json.add("wall_share_full", row.share_full);
  json.add("least_at", std::vector{row.least.x, row.least.y});
  return json;
}

std::vector<double> listed(const Spread& spread) { return {spread.least, spread.median, spread.largest}; }

JsonObject json_of_row(const LayerFigures& row) {
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
void add_rows(Figures& figures, const std::vector<Row>& rows, const std::vector<const char*>& columns,
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
  figures.add_lines(text);
  figures.add_member("layers", json_of(json));
}

void add_count(Figures& figures, const char* name, const MeshCounts& counts, const char* key) {
  const std::int64_t cells = counts.triangles + counts.quads;
  figures.add_raw(name, std::to_string(cells), json_of(cells), key);
}

}  // namespace

void add_layers(Figures& figures, const LayerReport& report, std::size_t most) {
  add_rows(figures, report, {"count", "first", "median", "of thick.", "full wall", "growth", "least at"},
           most);
}

void add_layers(Figures& figures, const std::vector<LayerFigures>& layers, std::size_t most) {
  std::vector<const char*> columns{"count",  "columns", "first", "median", "largest",
                                   "growth", "to",      "thick", "to"};
  if (std::ranges::any_of(layers, [](const LayerFigures& row) { return row.asked > 0; }))
    columns.push_back("of asked");
  add_rows(figures, layers, columns, most);
}

void add_quality(Figures& figures, const QualityByLayers& quality) {
  const MeshCounts& counts = quality.layers.counts;
  if (counts.triangles + counts.quads == 0) return;
  add_count(figures, "cells in layers", counts, "layer_cells");
  figures.add("  smallest angle", quality.layers.smallest_degrees, "{:.2f} degrees", "layer_min_angle");
  figures.add("  largest angle", quality.layers.largest_degrees, "{:.2f} degrees", "layer_max_angle");
  figures.add("  worst quality", quality.layers.worst, "{:.3g}", "layer_worst_quality");
  add_count(figures, "outside layers", quality.others.counts, "outer_cells");
  figures.add("  smallest angle", quality.others.smallest_degrees, "{:.2f} degrees", "outer_min_angle");
  figures.add("  largest angle", quality.others.largest_degrees, "{:.2f} degrees", "outer_max_angle");
  figures.add("  worst quality", quality.others.worst, "{:.3f}", "outer_worst_quality");
}

}  // namespace quadloop
