#include "app/report/smooth_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesher/mesh/check/layer_statistics.hpp"

namespace quadloop::app {

namespace {

std::string row(const std::string& name, const std::string& before, const std::string& after) {
  return fmt::format("  {:<24}{:>14}{:>14}\n", name, before, after);
}
std::string row(const std::string& name, double before, double after) {
  return row(name, fmt::format("{:.3f}", before), fmt::format("{:.3f}", after));
}

std::string range_of(const smoother::Histogram& h, std::size_t i) {
  if (i == 0) return fmt::format("    below {:g}", h.limits[0]);
  if (i == h.limits.size()) return fmt::format("    {:g} and more", h.limits.back());
  return fmt::format("    {:g} to {:g}", h.limits[i - 1], h.limits[i]);
}

}  // namespace

ShapeReport report_shapes(const Communicator& comm, const Mesh& mesh) {
  std::optional<QualitySummary> outside;
  if (has_layers(mesh)) outside = quality_by_layers(comm, mesh, layer_places(comm, mesh)).others;
  return {summarise_quality(comm, mesh), outside, smoother::shape_histograms(comm, mesh),
          area_ratios(comm, mesh)};
}

JsonObject record_of(const ShapeReport& report) {
  JsonObject json;
  json.add("worst_quality", report.quality.worst);
  json.add("mean_quality", report.quality.mean);
  json.add("min_angle", report.quality.smallest_degrees);
  json.add("max_angle", report.quality.largest_degrees);
  json.add("area_ratio_max", report.areas.largest);
  json.add("area_ratio_p99", report.areas.of_99_percent);
  for (const smoother::Histogram& histogram : report.histograms) {
    JsonObject bins;
    bins.add("limits", histogram.limits);
    bins.add("counts", histogram.counts);
    std::string key = histogram.name;
    std::replace(key.begin(), key.end(), ' ', '_');
    json.add(key, bins);
  }
  return json;
}

std::string comparison_table(const ShapeReport& before, const ShapeReport& after) {
  const QualitySummary b = before.outside.value_or(before.quality), a = after.outside.value_or(after.quality);
  std::string text = row(before.outside ? "outside layers" : "", "before", "after");
  text += row("worst quality", b.worst, a.worst) + row("mean quality", b.mean, a.mean);
  text += row("smallest angle, degrees", b.smallest_degrees, a.smallest_degrees);
  text += row("largest angle, degrees", b.largest_degrees, a.largest_degrees);
  text += row("largest area ratio", before.areas.largest, after.areas.largest);
  text += row("area ratio, 99 %", before.areas.of_99_percent, after.areas.of_99_percent);
  for (std::size_t k = 0; k < before.histograms.size(); ++k) {
    const smoother::Histogram &was = before.histograms[k], &is = after.histograms[k];
    text += fmt::format("  {}\n", was.name);
    for (std::size_t i = 0; i < was.counts.size(); ++i) {
      if (was.counts[i] == 0 && is.counts[i] == 0) continue;
      text += row(range_of(was, i), std::to_string(was.counts[i]), std::to_string(is.counts[i]));
    }
  }
  return text;
}

}  // namespace quadloop::app
