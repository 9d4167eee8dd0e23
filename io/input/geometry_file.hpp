#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Names of layers of a drawing or map, with the wildcards * and ?. None: all layers, of a drawing those that
/// are visible.
using LayerNames = std::vector<std::string>;

/// The unit of length that a file declares for its coordinates.
struct FileUnit {
  std::string name;   ///< empty where it declares none
  double metres = 0;  ///< in one of it; 0: not known
};

/// Reads the polylines of a geometry file, told by its suffix: .geom, .dat (airfoil), and those of
/// gis_suffixes where add_geometry_reader() has brought a reader for them; of those the layers given. On the
/// calling rank alone. Throws InputError "file:line: ..." where the file is not what its suffix says. What
/// was left out of the file is told by a warning each. `unit` is set where the file declares one.
std::vector<Chain> read_geometry(const std::string& path, std::vector<std::string>& warnings,
                                 const LayerNames& layers = {}, FileUnit* unit = nullptr);

/// Whether the suffix is that of a file of airfoil coordinates, which outline a body.
bool is_airfoil_file(const std::string& path);

/// The same as an outline, whose domain is known from a mesh on it: nobody is told of loops that were turned,
/// nor of several domains. Throws InputError as assemble() does too.
Geometry read_outline(const std::string& path, std::vector<std::string>& warnings);

/// Drawings and maps, read by a library of their own (io/gis).
inline const std::array<std::string, 4> gis_suffixes{".dxf", ".geojson", ".shp", ".gpkg"};

/// Those of all geometry files, whether or not this program reads drawings and maps.
std::vector<std::string> geometry_suffixes();

/// Whether files of this suffix have layers.
bool has_layers_of_drawings(const std::string& path);

using GeometryReader = std::vector<Chain> (*)(const std::string& path, const LayerNames& layers,
                                              std::vector<std::string>& warnings, FileUnit& unit);

/// From here on files of this suffix are read by `reader`, in the whole process.
void add_geometry_reader(const std::string& suffix, GeometryReader reader);

}  // namespace quadloop
