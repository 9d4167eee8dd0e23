#include "io/input/geometry_file.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>

#include "io/input/airfoil_dat.hpp"
#include "io/input/geom_text.hpp"
#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/assemble.hpp"

namespace quadloop {

namespace {

std::map<std::string, GeometryReader>& readers() {
  static std::map<std::string, GeometryReader> all{
      {".geom", [](const std::string& path, std::vector<std::string>&) { return read_geom(path); }},
      {".dat", read_airfoil}};
  return all;
}

/// In small letters.
std::string suffix_of_geometry(const std::string& path) {
  std::string suffix = std::filesystem::path(path).extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

}  // namespace

bool is_airfoil_file(const std::string& path) { return suffix_of_geometry(path) == ".dat"; }

std::vector<std::string> geometry_suffixes() {
  std::vector<std::string> all{".geom", ".dat"};
  all.insert(all.end(), gis_suffixes.begin(), gis_suffixes.end());
  return all;
}

void add_geometry_reader(const std::string& suffix, GeometryReader reader) { readers()[suffix] = reader; }

std::vector<Chain> read_geometry(const std::string& path, std::vector<std::string>& warnings) {
  const std::string suffix = suffix_of_geometry(path);
  const auto reader = readers().find(suffix);
  if (reader != readers().end()) return reader->second(path, warnings);
  if (std::find(gis_suffixes.begin(), gis_suffixes.end(), suffix) != gis_suffixes.end())
    throw InputError(
        fmt::format("{}: this program was linked without GDAL, which reads {} files", path, suffix));
  throw InputError(fmt::format("{}: '{}' is not the suffix of a geometry file; known: {}", path, suffix,
                               fmt::join(geometry_suffixes(), ", ")));
}

Geometry read_outline(const std::string& path, std::vector<std::string>& warnings) {
  AssembleOptions options;
  options.domain_is_known = true;
  return assemble(read_geometry(path, warnings), options, warnings);
}

}  // namespace quadloop
