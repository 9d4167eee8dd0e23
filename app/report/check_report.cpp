#include "app/report/check_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "app/report/layer_table.hpp"
#include "app/report/statistics.hpp"

namespace quadloop::app {

namespace {

void add_count(Statistics& statistics, const char* name, std::int64_t count, const char* key) {
  statistics.add_raw(name, std::to_string(count), json_of(count), key);
}

void add_fit(Statistics& statistics, const GeometryFit& fit) {
  statistics.add("boundaries dropped", fit.boundaries_dropped);
  statistics.add("loops dropped", fit.loops_dropped);
  statistics.add("sharp corners", fit.sharp_corners);
  statistics.add("sharp corners lost", fit.sharp_corners_lost);
  statistics.add("boundary node distance", fit.boundary_node_distance, number_pattern);
  statistics.add("geometry distance", fit.geometry_distance, number_pattern);
  statistics.add("geometry area error", fit.area_error, number_pattern);
}

std::string places_json(const std::vector<SharpPlace>& places) {
  std::vector<std::string> rows;
  for (const auto& [place, degrees] : places) rows.push_back(json_of(std::vector{place.x, place.y, degrees}));
  return json_list(rows);
}

std::vector<JsonObject> faults_json(const std::vector<MeshFault>& faults) {
  std::vector<JsonObject> rows;
  for (const MeshFault& fault : faults) {
    JsonObject& row = rows.emplace_back();
    row.add("rule", name_of(fault.rule));
    row.add("what", fault.what);
    row.add("place", std::vector{fault.place.x, fault.place.y});
  }
  return rows;
}

template <class Value>
std::string inner_row(std::string_view name, const Value& value) {
  return fmt::format("    {:<22}{:>16}\n", name, value);
}

std::string boundaries_text(const CheckReport::Edges& boundaries, std::size_t most) {
  std::string text;
  const std::size_t listed = std::min(boundaries.size(), most);
  for (std::size_t b = 0; b < listed; ++b) text += inner_row(boundaries[b].first, boundaries[b].second);
  if (listed < boundaries.size())
    text += fmt::format("    {} more; --verbose or --json shows them\n", boundaries.size() - listed);
  return text;
}

std::string places_text(const std::vector<SharpPlace>& places) {
  std::string text;
  for (const auto& [place, degrees] : places)
    text += inner_row(fmt::format("({:.6g}, {:.6g})", place.x, place.y), fmt::format("{:.6g}", degrees));
  return text;
}

/// These are meaningful only if the geometry is known.
void add_outline_corners(Statistics& statistics, const ShapeStatistics& shape, bool with_geometry,
                         bool verbose) {
  if (!with_geometry) {
    statistics.add_member("corners_of_outline", json_of(shape.corners_of_outline));
    statistics.add_member("corners_in_passages", json_of(shape.corners_in_passages));
    return;
  }
  add_count(statistics, "corners of geometry", shape.corners_of_outline, "corners_of_outline");
  if (verbose) statistics.add_lines(places_text(shape.sharp_places));
  statistics.add("corners in passages", shape.corners_in_passages);
  if (verbose) statistics.add_lines(places_text(shape.passages));
}

void add_shape(Statistics& statistics, const CheckReport& report, bool verbose) {
  const ShapeStatistics& shape = report.shape;
  const SolverStatistics& shares = report.statistics;
  statistics.add_member("corners", json_of(shape.corners));
  add_count(statistics, "corners below 15 degrees", shape.corners_below_15, "corners_below_15");
  statistics.add_member("corners_below_25", json_of(shape.corners_below_25));
  add_count(statistics, "corners below 26 degrees", shape.corners_below_26, "corners_below_26");
  add_count(statistics, "corners above 150 degrees", shape.corners_above_150, "corners_above_150");
  add_outline_corners(statistics, shape, report.fit.has_value(), verbose);
  statistics.add_member("min_angle_made", json_of(shape.smallest_degrees));
  statistics.add_member("max_angle_made", json_of(shape.largest_degrees));
  statistics.add("largest area ratio", shape.area_ratio_max, number_pattern, "area_ratio_max");
  if (shape.area_ratio_max > 0) statistics.add_place(report.largest_area_ratio, "area_ratio_max_at");
  statistics.add("area ratio, 99 %", shape.area_ratio_p99, number_pattern, "area_ratio_p99");
  statistics.add("share of quads", shape.quad_share, number_pattern, "quad_share");
  statistics.add("parallelograms", shares.parallelogram_share(), number_pattern, "parallelogram_share");
  statistics.add("inexact nodes", shares.inexact_share(), number_pattern, "inexact_node_share");
  statistics.add("passage cells", shares.passage_cells);
  statistics.add_member("sharp_places", places_json(shape.sharp_places));
  statistics.add_member("passages", places_json(shape.passages));
}

std::string boundaries_json(const CheckReport::Edges& boundaries) {
  JsonObject counts;
  for (const auto& [name, edges] : boundaries) counts.add(name, edges);
  return counts.text();
}

/// Adds the inner lines and the periodic pairs, if there are any.
void add_lines_and_pairs(Statistics& statistics, const CheckReport& report, std::size_t most) {
  if (!report.inner_lines.empty()) {
    statistics.add("inner lines", std::ssize(report.inner_lines));
    statistics.add_member("edges_of_inner_lines", boundaries_json(report.inner_lines));
    statistics.add_lines(boundaries_text(report.inner_lines, most));
  }
  if (report.pairs.empty()) return;
  statistics.add("periodic pairs", std::ssize(report.pairs));
  const bool match = std::ranges::none_of(
      report.faults, [](const MeshFault& fault) { return fault.rule == MeshRule::pairs; });
  for (const std::string& pair : report.pairs)
    statistics.add_lines(inner_row(pair, match ? "nodes match" : ""));
}

/// Adds the number of blocks; if there are several, also cells and area of each, and the error of the area if
/// the geometry is known.
void add_blocks(Statistics& statistics, const CheckReport& report) {
  statistics.add("blocks", std::ssize(report.blocks));
  if (report.blocks.size() < 2) return;
  JsonObject figures;
  for (std::size_t b = 0; b < report.blocks.size(); ++b) {
    const BlockStatistics& block = report.blocks[b];
    statistics.add_lines(inner_row(block.name, fmt::format("{} cells", block.cells)));
    statistics.add_lines(inner_row("  area", fmt::format("{:.6g}", block.area)));
    JsonObject row;
    row.add("cells", block.cells);
    row.add("area", block.area);
    if (report.fit && b < report.fit->block_area_errors.size()) {
      const double error = report.fit->block_area_errors[b];
      statistics.add_lines(inner_row("  geometry area error", fmt::format("{:.6g}", error)));
      row.add("geometry_area_error", error);
    }
    figures.add(block.name, row);
  }
  statistics.add_member("block_figures", figures.text());
  statistics.add("interface edges", report.interfaces.all);
  if (report.interfaces.unnamed > 0) statistics.add("unnamed interface edges", report.interfaces.unnamed);
}

/// All but the errors.
Statistics statistics_of(const CheckReport& report, bool verbose, std::size_t most) {
  const QualitySummary& quality = report.quality;
  Statistics statistics;
  statistics.add("nodes", quality.counts.nodes);
  statistics.add("triangles", quality.counts.triangles);
  statistics.add("quads", quality.counts.quads);
  add_blocks(statistics, report);
  statistics.add("regions", report.regions.count);
  statistics.add("boundary edges", quality.counts.boundary_edges);
  statistics.add_member("boundaries", boundaries_json(report.boundaries));
  statistics.add_lines(boundaries_text(report.boundaries, most));
  add_lines_and_pairs(statistics, report, most);
  statistics.add("area", report.area, number_pattern);
  add_quality(statistics, quality, report.by_layers, report.faces, &report.worst);
  add_shape(statistics, report, verbose);
  statistics.add("pinched nodes", report.pinched_nodes);
  add_objections(statistics, report.faces, report.statistics);
  add_layers(statistics, report.layers, most);
  if (report.fit) add_fit(statistics, *report.fit);
  return statistics;
}

std::string faults_text(const std::vector<MeshFault>& faults, std::size_t most) {
  std::string text;
  std::map<MeshRule, std::size_t> found;
  for (const MeshFault& fault : faults) {
    if (++found[fault.rule] > most) continue;
    text += fmt::format("  BROKEN {}: {} at ({}, {})\n", name_of(fault.rule), fault.what, fault.place.x,
                        fault.place.y);
  }
  for (const auto& [rule, count] : found) {
    if (count > most)
      text += fmt::format("  BROKEN {}: {} more faults; --verbose or --json shows them\n", name_of(rule),
                          count - most);
  }
  return text;
}

}  // namespace

std::string report_text(const CheckReport& report, bool verbose) {
  const std::size_t most = verbose ? std::numeric_limits<std::size_t>::max() : most_listed;
  return statistics_of(report, verbose, most).table(24, 16) + faults_text(report.faults, most) +
         (report.faults.empty() ? "  valid\n" : "  INVALID\n");
}

JsonObject report_record(const CheckReport& report) {
  JsonObject json;
  json.add("valid", report.faults.empty());
  json.add("file", report.file);
  json.add("faults", faults_json(report.faults));
  json.append(statistics_of(report, false, most_listed).record());
  return json;
}

}  // namespace quadloop::app
