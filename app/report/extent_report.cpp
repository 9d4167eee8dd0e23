#include "app/report/extent_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "mesher/base/counted.hpp"

namespace quadloop::app {

namespace {

std::string line_of(const FileExtent& extent) {
  const auto& [low, high] = extent.box;
  const std::string unit = extent.declared.name.empty() ? "no unit declared" : "in " + extent.declared.name;
  const std::string taken =
      extent.metres > 0 ? fmt::format("meshed in metres (unit: {:.6g} m)", extent.metres) : "meshed as given";
  const std::string plane =
      extent.declared.plane.empty() ? "" : " in the " + extent.declared.plane + " plane";
  return fmt::format("{}: coordinates from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}){}, {}, {}",
                     std::filesystem::path(extent.path).filename().string(), low.x, low.y, high.x, high.y,
                     plane, unit, taken);
}

JsonObject json_of_extent(const FileExtent& extent) {
  JsonObject json;
  json.add("file", extent.path);
  json.add("extent", std::vector{extent.box.low.x, extent.box.low.y, extent.box.high.x, extent.box.high.y});
  json.add_raw("unit", extent.declared.name.empty() ? "null" : json_of(extent.declared.name));
  if (!extent.declared.plane.empty()) json.add("plane", extent.declared.plane);
  json.add_raw("metres", extent.metres > 0 ? json_of(extent.metres) : "null");
  return json;
}

}  // namespace

std::vector<std::string> extent_lines(const std::vector<FileExtent>& extents) {
  std::vector<std::string> lines;
  const std::size_t listed = std::min(extents.size(), most_listed);
  for (std::size_t i = 0; i < listed; ++i) lines.push_back(line_of(extents[i]));
  if (extents.size() > listed)
    lines.push_back(
        fmt::format("{}; --json shows them", counted(extents.size() - listed, "more geometry file")));
  return lines;
}

void add_extents(Statistics& statistics, const std::vector<FileExtent>& extents) {
  std::vector<JsonObject> json;
  for (const FileExtent& extent : extents) json.push_back(json_of_extent(extent));
  for (const std::string& line : extent_lines(extents)) statistics.add_lines("  " + line + "\n");
  statistics.add_member("geometry", json_of(json));
}

}  // namespace quadloop::app
