#include "app/report/solid_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "app/report/figures.hpp"
#include "app/report/refusals.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

std::vector<double> coordinates(Point3 p) { return {p.x, p.y, p.z}; }

std::string place_text(Point3 p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z); }

std::string patches_text(const std::vector<PatchFigures>& patches, std::size_t most) {
  std::string text;
  for (std::size_t n = 0; n < std::min(patches.size(), most); ++n)
    text +=
        fmt::format("    {:<22}{:>12}  area {:.6g}\n", patches[n].name, patches[n].faces, patches[n].area);
  if (patches.size() > most)
    text += fmt::format("    {} more; --verbose or --json shows them\n", patches.size() - most);
  return text;
}

std::string blocks_text(const std::vector<BlockFigures>& blocks, std::size_t most) {
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

Figures figures_of(const FileMesh& mesh, const SolidFigures& found, std::size_t most) {
  Figures figures;
  figures.add("nodes", std::ssize(mesh.points));
  figures.add("prisms", std::ssize(mesh.prisms));
  figures.add("hexahedra", std::ssize(mesh.hexahedra));
  if (!mesh.tetrahedra.empty()) figures.add("tetrahedra", std::ssize(mesh.tetrahedra));
  if (!mesh.pyramids.empty()) figures.add("pyramids", std::ssize(mesh.pyramids));
  figures.add("volume", found.volume, number_pattern);
  figures.add("least cell volume", found.least_volume, number_pattern);
  figures.add_member("least_place", json_of(coordinates(found.least_place)));
  if (!found.blocks.empty()) {
    figures.add("blocks", std::ssize(found.blocks));
    figures.add_lines(blocks_text(found.blocks, most));
    figures.add_member("block_figures", rows_json(found.blocks, "cells", &BlockFigures::cells, "volume",
                                                  &BlockFigures::volume));
  }
  figures.add("patches", std::ssize(mesh.boundaries));
  figures.add_lines(patches_text(found.patches, most));
  figures.add_member("patch_figures",
                     rows_json(found.patches, "faces", &PatchFigures::faces, "area", &PatchFigures::area));
  return figures;
}

std::string fault_text(const SolidFault& fault) {
  return fmt::format("{}: {} at {}", name_of(fault.rule), fault.what, place_text(fault.place));
}

}  // namespace

std::string solid_text(const FileMesh& mesh, const SolidFigures& figures, bool verbose) {
  const std::size_t most = verbose ? std::numeric_limits<std::size_t>::max() : most_listed;
  std::string text = figures_of(mesh, figures, most).table(24, 16);
  for (const SolidFault& fault : figures.faults) text += "  BROKEN " + fault_text(fault) + "\n";
  const std::int64_t more = figures.all_faults - std::ssize(figures.faults);
  if (more > 0) text += fmt::format("  BROKEN: {} more faults\n", more);
  return text + (figures.faults.empty() ? "  valid\n" : "  INVALID\n");
}

JsonObject solid_record(const std::string& file, const FileMesh& mesh, const SolidFigures& figures) {
  JsonObject json;
  json.add("valid", figures.faults.empty());
  json.add("file", file);
  json.add("dimensions", std::int64_t{3});
  std::vector<JsonObject> faults;
  for (const SolidFault& fault : figures.faults) {
    JsonObject& row = faults.emplace_back();
    row.add("rule", name_of(fault.rule));
    row.add("what", fault.what);
    row.add("place", coordinates(fault.place));
  }
  json.add("faults", faults);
  json.append(figures_of(mesh, figures, most_listed).record());
  return json;
}

void refuse_invalid_solid(const std::string& file, const SolidFigures& figures) {
  throw InputError(fmt::format("{}: invalid mesh: {}{}", file, fault_text(figures.faults.front()),
                               more_faults(figures.all_faults - 1)));
}

std::vector<std::string> doubts_about(const FileMesh& mesh, const std::string& file) {
  const SolidFigures figures = check_solid(mesh);
  if (figures.faults.empty()) return {};
  return {fmt::format("{}: is not valid, and is written unchanged: {}{}", file,
                      fault_text(figures.faults.front()), more_faults(figures.all_faults - 1))};
}

}  // namespace quadloop
