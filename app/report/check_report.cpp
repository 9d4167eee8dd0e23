#include "app/report/check_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

namespace quadloop {

namespace {

constexpr std::size_t most_listed = 20;

void add_fit(JsonObject& json, const GeometryFit& fit) {
  json.add("boundaries_dropped", fit.boundaries_dropped);
  json.add("loops_dropped", fit.loops_dropped);
  json.add("sharp_corners", fit.sharp_corners);
  json.add("sharp_corners_lost", fit.sharp_corners_lost);
  json.add("boundary_node_distance", fit.boundary_node_distance);
  json.add("geometry_distance", fit.geometry_distance);
  json.add("geometry_area_error", fit.area_error);
}

std::string places_json(const std::vector<SharpPlace>& places) {
  std::vector<std::string> rows;
  for (const auto& [place, degrees] : places) rows.push_back(json_of(std::vector{place.x, place.y, degrees}));
  return json_list(rows);
}

void add_shape(JsonObject& json, const ShapeStatistics& shape, const ShapeFigures& figures) {
  json.add("corners", shape.corners);
  json.add("corners_below_15", shape.corners_below_15);
  json.add("corners_below_25", shape.corners_below_25);
  json.add("corners_below_26", shape.corners_below_26);
  json.add("corners_above_150", shape.corners_above_150);
  json.add("corners_of_outline", shape.corners_of_outline);
  json.add("corners_in_passages", shape.corners_in_passages);
  json.add("min_angle_made", shape.smallest_degrees);
  json.add("max_angle_made", shape.largest_degrees);
  json.add("area_ratio_max", shape.area_ratio_max);
  json.add("area_ratio_p99", shape.area_ratio_p99);
  json.add("quad_share", shape.quad_share);
  json.add("parallelogram_share", figures.parallelogram_share());
  json.add("inexact_node_share", figures.inexact_share());
  json.add("passage_cells", figures.passage_cells);
  json.add_raw("sharp_places", places_json(shape.sharp_places));
  json.add_raw("passages", places_json(shape.passages));
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
std::string row(const char* name, const Value& value) {
  return fmt::format("  {:<24}{:>16}\n", name, value);
}
std::string row(const char* name, double value) { return row(name, fmt::format("{:.6g}", value)); }

template <class Value>
std::string inner_row(std::string_view name, const Value& value) {
  return fmt::format("    {:<22}{:>16}\n", name, value);
}

std::string boundaries_text(const std::vector<std::pair<std::string, std::int64_t>>& boundaries,
                            std::size_t most) {
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
    text += inner_row(fmt::format("({}, {})", place.x, place.y), fmt::format("{:.6g}", degrees));
  return text;
}

std::string outline_corners_text(const ShapeStatistics& shape, bool verbose) {
  return row("corners of the outline", shape.corners_of_outline) +
         (verbose ? places_text(shape.sharp_places) : "") +
         row("corners in passages", shape.corners_in_passages) + (verbose ? places_text(shape.passages) : "");
}

std::string shape_text(const ShapeStatistics& shape, const ShapeFigures& figures, bool with_geometry,
                       bool verbose) {
  return row("corners below 15 degrees", shape.corners_below_15) +
         row("corners below 26", shape.corners_below_26) + row("corners above 150", shape.corners_above_150) +
         (with_geometry ? outline_corners_text(shape, verbose) : "") +
         row("largest area ratio", shape.area_ratio_max) + row("area ratio, 99 %", shape.area_ratio_p99) +
         row("share of quads", shape.quad_share) + row("parallelograms", figures.parallelogram_share()) +
         row("inexact nodes", figures.inexact_share()) + row("passage cells", figures.passage_cells);
}

std::string fit_text(const GeometryFit& fit) {
  return row("boundaries dropped", fit.boundaries_dropped) + row("loops dropped", fit.loops_dropped) +
         row("sharp corners", fit.sharp_corners) + row("sharp corners lost", fit.sharp_corners_lost) +
         row("boundary node distance", fit.boundary_node_distance) +
         row("geometry distance", fit.geometry_distance) + row("geometry area error", fit.area_error);
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
  const QualitySummary& quality = report.quality;
  std::string text = row("nodes", quality.counts.nodes) + row("triangles", quality.counts.triangles) +
                     row("quads", quality.counts.quads);
  text += row("blocks", report.blocks) + row("boundary edges", quality.counts.boundary_edges);
  text += boundaries_text(report.boundaries, most);
  text += row("area", report.area) + row("smallest angle", quality.smallest_degrees) +
          row("largest angle", quality.largest_degrees);
  text += shape_text(report.shape, report.figures, report.fit.has_value(), verbose);
  text += row("worst quality", quality.worst) + row("mean quality", quality.mean) +
          row("pinched nodes", report.pinched_nodes);
  if (report.fit) text += fit_text(*report.fit);
  return text + faults_text(report.faults, most) + (report.faults.empty() ? "  valid\n" : "  INVALID\n");
}

JsonObject report_record(const CheckReport& report) {
  JsonObject boundaries, json;
  for (const auto& [name, edges] : report.boundaries) boundaries.add(name, edges);
  const QualitySummary& quality = report.quality;
  json.add("valid", report.faults.empty());
  json.add("file", report.file);
  json.add("faults", faults_json(report.faults));
  json.add("nodes", quality.counts.nodes);
  json.add("triangles", quality.counts.triangles);
  json.add("quads", quality.counts.quads);
  json.add("blocks", report.blocks);
  json.add("boundary_edges", quality.counts.boundary_edges);
  json.add("boundaries", boundaries);
  json.add("area", report.area);
  json.add("min_angle", quality.smallest_degrees);
  json.add("max_angle", quality.largest_degrees);
  add_shape(json, report.shape, report.figures);
  json.add("worst_quality", quality.worst);
  json.add("mean_quality", quality.mean);
  json.add("pinched_nodes", report.pinched_nodes);
  if (report.fit) add_fit(json, *report.fit);
  return json;
}

}  // namespace quadloop
