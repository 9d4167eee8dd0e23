#include "app/report/estimate_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/report/summary.hpp"
#include "io/formats.hpp"
#include "io/tree/tree_file.hpp"
#include "mesher/base/json.hpp"
#include "mesher/build/mesh_estimate.hpp"

namespace quadloop::app {

namespace {

/// Returns the estimated size of a file of the mesh; empty if it is unknown.
std::optional<double> bytes_of_file(const std::string& path, MeshType type, const MeshEstimate& estimate,
                                    int variables) {
  constexpr double of_leaf = 33;  // in a tree file
  if (path.ends_with(io::tree_suffix)) return of_leaf * estimate.leaves;
  const io::FileFormat* const format = io::format_of(path);
  if (format == nullptr || format->bytes_of_cell.quad == 0) return {};
  const auto [of_quad, of_triangle] = format->bytes_of_cell;
  return (has_triangles_alone(type) ? of_triangle : of_quad) * estimate.cells +
         format->bytes_of_value * variables * nodes_of(estimate, type);
}

std::string text_of_size(double bytes) {
  constexpr double megabyte = 1e6, gigabyte = 1e9;
  return bytes < gigabyte ? fmt::format("{:.1f} MB", bytes / megabyte)
                          : fmt::format("{:.1f} GB", bytes / gigabyte);
}

}  // namespace

FileSizes::FileSizes(const std::vector<std::string>& files, MeshType type, const MeshEstimate& estimate,
                     int variables) {
  for (const std::string& file : files) {
    const std::optional<double> bytes = bytes_of_file(file, type, estimate, variables);
    if (!bytes) continue;
    sizes_.emplace_back(file, *bytes);
    sum_ += *bytes;
  }
}

void FileSizes::add_to(Statistics& statistics) const {
  JsonObject record;
  for (const auto& [file, bytes] : sizes_) {
    statistics.add_lines(fmt::format("  {:<24}{:>14}\n", file, text_of_size(bytes)));
    record.add(file, std::llround(bytes));
  }
  statistics.add_member("file_bytes", record.text());
}

void add_run_estimate(Statistics& statistics, const MeshEstimate& estimate, int ranks) {
  add_estimate(statistics, estimate, ranks);
  statistics.add_raw("of all ranks", text_of_bytes(total_bytes(estimate, ranks)),
                     json_of(std::round(total_bytes(estimate, ranks) / (1 << 20))), "total_memory_mib");
}

void add_file_sum(Statistics& statistics, const std::string& name, double bytes, const std::string& key) {
  statistics.add_raw(name, text_of_size(bytes), json_of(std::round(bytes)), key);
}

/// By Euler's formula a mesh has as many nodes as quads and half of its triangles.
double nodes_of(const MeshEstimate& estimate, MeshType type) {
  constexpr double hybrid_cells_of_node = 1.1, triangles_of_node = 2;
  return estimate.cells / (has_triangles_alone(type) ? triangles_of_node : hybrid_cells_of_node);
}

MeshEstimate grown_to(const MeshEstimate& estimate, MeshType type, double nodes) {
  const double factor = std::max(1.0, nodes / nodes_of(estimate, type));
  MeshEstimate grown = estimate;
  for (double* const part : {&grown.leaves, &grown.cells, &grown.bytes, &grown.layer_cells}) *part *= factor;
  return grown;
}

}  // namespace quadloop::app
