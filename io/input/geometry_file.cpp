#include "io/input/geometry_file.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "io/dxf/dxf_reader.hpp"
#include "io/input/airfoil_dat.hpp"
#include "io/input/geom_text.hpp"
#include "io/step/step_reader.hpp"
#include "io/text/clean_names.hpp"
#include "io/text/length_units.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/suffix.hpp"
#include "mesher/geometry/assemble/assemble.hpp"

namespace quadloop::io {

namespace {

std::map<std::string, GeometryReader>& readers() {
  static std::map<std::string, GeometryReader> all{
      {".geom", [](const std::string& path, const DrawingChoice&, std::vector<std::string>&,
                   FileUnit&) { return read_geom(path); }},
      {".dat", [](const std::string& path, const DrawingChoice&, std::vector<std::string>& warnings,
                  FileUnit&) { return read_airfoil(path, warnings); }},
      {".dxf", io::read_dxf},
      {".stp", io::read_step},
      {".step", io::read_step}};
  return all;
}

}  // namespace

bool is_airfoil_file(const std::string& path) { return suffix_of(path) == ".dat"; }

std::vector<std::string> geometry_suffixes() {
  std::vector<std::string> all{".geom", ".dat", ".dxf", ".stp", ".step"};
  all.insert(all.end(), gis_suffixes.begin(), gis_suffixes.end());
  return all;
}

void add_geometry_reader(const std::string& suffix, GeometryReader reader) { readers()[suffix] = reader; }

bool has_layers_of_drawings(const std::string& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".dxf" || suffix == ".stp" || suffix == ".step" ||
         std::ranges::count(gis_suffixes, suffix) > 0;
}

std::vector<Chain> read_geometry(const std::string& path, std::vector<std::string>& warnings,
                                 const DrawingChoice& choice, FileUnit* unit) {
  const std::string suffix = suffix_of(path);
  const auto reader = readers().find(suffix);
  if (reader != readers().end()) {
    FileUnit declared;
    std::vector<Chain> chains = reader->second(path, choice, warnings, declared);
    if (declared.metres == 0) declared.metres = metres_in(declared.name).value_or(0);
    if (unit != nullptr) *unit = declared;
    std::vector<std::string*> names;
    for (Chain& chain : chains) names.push_back(&chain.name);
    std::ranges::move(clean_names(names, path), std::back_inserter(warnings));
    return chains;
  }
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

}  // namespace quadloop::io
