#include "app/report/mesh3d_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "app/report/refusals.hpp"
#include "app/report/statistics.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::app {

namespace {

std::vector<double> coordinates(io::Point3 p) { return {p.x, p.y, p.z}; }

std::string place_text(io::Point3 p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z); }

std::string patches_text(const std::vector<io::PatchStatistics>& patches, std::size_t most) {
  std::string text;
  for (std::size_t n = 0; n < std::min(patches.size(), most); ++n)
    text +=
        fmt::format("    {:<22}{:>12}  area {:.6g}\n", patches[n].name, patches[n].faces, patches[n].area);
  if (patches.size() > most)
    text += fmt::format("    {} more; --verbose or --json shows them\n", patches.size() - most);
  return text;
}

std::string blocks_text(const std::vector<io::BlockStatistics>& blocks, std::size_t most) {
  std::string text;
  for (std::size_t n = 0; n < std::min(blocks.size(), most); ++n)
    text +=
        fmt::format("    {:<22}{:>12}  volume {:.6g}\n", blocks[n].name, blocks[n].cells, blocks[n].volume);
  if (blocks.size() > most)
    text += fmt::format("    {} more; --verbose or --json shows them\n", blocks.size() - most);
  return text;
}

/// {name: {count_key: n, size_key: a}}
template <class Row, class Count>
std::string rows_json(const std::vector<Row>& rows, const char* count_key, Count Row::*count,
                      const char* size_key, double Row::*size) {
  JsonObject all;
  for (const Row& row : rows) {
    JsonObject one;
    one.add(count_key, row.*count);
    one.add(size_key, row.*size);
    all.add(row.name, one);
  }
  return all.text();
}

Statistics statistics_of(const io::FileMesh& mesh, const io::Mesh3dStatistics& found, std::size_t most) {
  Statistics statistics;
  statistics.add("nodes", std::ssize(mesh.points));
  statistics.add("prisms", std::ssize(mesh.prisms));
  statistics.add("hexahedra", std::ssize(mesh.hexahedra));
  if (!mesh.tetrahedra.empty()) statistics.add("tetrahedra", std::ssize(mesh.tetrahedra));
  if (!mesh.pyramids.empty()) statistics.add("pyramids", std::ssize(mesh.pyramids));
  statistics.add("volume", found.volume, number_pattern);
  statistics.add("least cell volume", found.least_volume, number_pattern);
  statistics.add_member("least_place", json_of(coordinates(found.least_place)));
  if (!found.blocks.empty()) {
    statistics.add("blocks", std::ssize(found.blocks));
    statistics.add_lines(blocks_text(found.blocks, most));
    statistics.add_member("block_figures", rows_json(found.blocks, "cells", &io::BlockStatistics::cells,
                                                     "volume", &io::BlockStatistics::volume));
  }
  statistics.add("patches", std::ssize(mesh.boundaries));
  statistics.add_lines(patches_text(found.patches, most));
  statistics.add_member("patch_figures", rows_json(found.patches, "faces", &io::PatchStatistics::faces,
                                                   "area", &io::PatchStatistics::area));
  return statistics;
}

std::string fault_text(const io::Mesh3dFault& fault) {
  return fmt::format("{}: {} at {}", io::name_of(fault.rule), fault.what, place_text(fault.place));
}

}  // namespace

std::string mesh3d_text(const io::FileMesh& mesh, const io::Mesh3dStatistics& statistics, bool verbose) {
  const std::size_t most = verbose ? std::numeric_limits<std::size_t>::max() : most_listed;
  std::string text = statistics_of(mesh, statistics, most).table(24, 16);
  for (const io::Mesh3dFault& fault : statistics.faults) text += "  BROKEN " + fault_text(fault) + "\n";
  const std::int64_t more = statistics.all_faults - std::ssize(statistics.faults);
  if (more > 0) text += fmt::format("  BROKEN: {} more faults\n", more);
  return text + (statistics.faults.empty() ? "  valid\n" : "  INVALID\n");
}

JsonObject mesh3d_record(const std::string& file, const io::FileMesh& mesh,
                         const io::Mesh3dStatistics& statistics) {
  JsonObject json;
  json.add("valid", statistics.faults.empty());
  json.add("file", file);
  json.add("dimensions", std::int64_t{3});
  std::vector<JsonObject> faults;
  for (const io::Mesh3dFault& fault : statistics.faults) {
    JsonObject& row = faults.emplace_back();
    row.add("rule", io::name_of(fault.rule));
    row.add("what", fault.what);
    row.add("place", coordinates(fault.place));
  }
  json.add("faults", faults);
  json.append(statistics_of(mesh, statistics, most_listed).record());
  return json;
}

void refuse_invalid_mesh3d(const std::string& file, const io::Mesh3dStatistics& statistics) {
  throw InputError(fmt::format("{}: invalid mesh: {}{}", file, fault_text(statistics.faults.front()),
                               more_faults(statistics.all_faults - 1)));
}

std::vector<std::string> doubts_about(const io::FileMesh& mesh, const std::string& file) {
  const io::Mesh3dStatistics statistics = io::check_mesh3d(mesh);
  if (statistics.faults.empty()) return {};
  return {fmt::format("{}: is not valid, and is written unchanged: {}{}", file,
                      fault_text(statistics.faults.front()), more_faults(statistics.all_faults - 1))};
}

}  // namespace quadloop::app
