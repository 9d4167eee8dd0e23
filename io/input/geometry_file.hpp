#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop::io {

/// Names of layers of a drawing or map, with the wildcards * and ?. Empty: all layers; in a drawing the
/// visible ones.
using LayerNames = std::vector<std::string>;

/// Whether the layer has this name, in upper or lower case.
bool matches_layer(const std::string& pattern, const std::string& layer);

/// What a file declares: the unit of length of its coordinates, and its layers.
struct FileUnit {
  std::string name;                 ///< empty where it declares none
  double metres = 0;                ///< in one of it; 0: not known
  std::vector<std::string> layers;  ///< of a drawing or map; ascending
};

/// Reads the polylines of a geometry file. The suffix selects the format: .geom, .dat (airfoil), and those of
/// gis_suffixes if add_geometry_reader() has registered a reader; only the given layers are read from these.
/// On the calling rank only. Throws InputError "file:line: ..." if the content does not match the suffix. A
/// warning reports each kind of content that is left out. `unit` receives the unit that the file declares.
std::vector<Chain> read_geometry(const std::string& path, std::vector<std::string>& warnings,
                                 const LayerNames& layers = {}, FileUnit* unit = nullptr);

/// Whether the suffix is that of airfoil coordinates, which describe a body.
bool is_airfoil_file(const std::string& path);

/// Reads the same as a geometry whose domain is known from a mesh: without warnings about reversed loops or
/// several domains. Throws InputError as assemble() does too.
Geometry read_outline(const std::string& path, std::vector<std::string>& warnings);

/// Drawings and maps, read by a separate library (io/gis).
inline const std::array<std::string, 4> gis_suffixes{".dxf", ".geojson", ".shp", ".gpkg"};

/// Returns the suffixes of all geometry files, whether or not this program can read drawings and maps.
std::vector<std::string> geometry_suffixes();

/// Whether files of this suffix have layers.
bool has_layers_of_drawings(const std::string& path);

using GeometryReader = std::vector<Chain> (*)(const std::string& path, const LayerNames& layers,
                                              std::vector<std::string>& warnings, FileUnit& unit);

/// Registers `reader` for files of this suffix, in the whole process.
void add_geometry_reader(const std::string& suffix, GeometryReader reader);

}  // namespace quadloop::io
