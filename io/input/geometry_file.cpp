#include "io/input/geometry_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "io/input/airfoil_dat.hpp"
#include "io/input/geom_text.hpp"
#include "io/input/ogr_reader.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

std::vector<Chain> read_geometry(const std::string& path, std::vector<std::string>& warnings) {
  std::string suffix = std::filesystem::path(path).extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (suffix == ".geom") return read_geom(path);
  if (suffix == ".dat") return read_airfoil(path, warnings);
  for (const char* known : {".dxf", ".geojson", ".shp", ".gpkg"}) {
    if (suffix == known) return read_ogr(path, warnings);
  }
  throw InputError(fmt::format(
      "{}: '{}' is not the suffix of a geometry file; known: .geom, .dat, .dxf, .geojson, .shp, .gpkg", path,
      suffix));
}

}  // namespace quadloop
