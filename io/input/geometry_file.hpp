#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "io/dxf/drawing_choice.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop::io {

/// Reads the chains of a geometry file. The suffix selects the format: .geom, .dat (airfoil), .dxf, .stp
/// and .step, and those of gis_suffixes if add_geometry_reader() has registered a reader. `choice` applies to
/// drawings and maps. On the calling rank only. Throws InputError "file:line: ..." if the content does not
/// match the suffix. A warning reports each kind of content that is left out. `unit` receives the unit that
/// the file declares.
std::vector<Chain> read_geometry(const std::string& path, std::vector<std::string>& warnings,
                                 const DrawingChoice& choice = {}, FileUnit* unit = nullptr);

/// Whether the suffix is that of airfoil coordinates, which describe a body.
bool is_airfoil_file(const std::string& path);

/// Reads the same as a geometry whose domain is known from a mesh: without warnings about reversed loops or
/// several domains. Throws InputError as assemble() does too.
Geometry read_outline(const std::string& path, std::vector<std::string>& warnings);

/// Maps, read by a separate library (io/gis).
inline const std::array<std::string, 3> gis_suffixes{".geojson", ".shp", ".gpkg"};

/// Returns the suffixes of all geometry files, whether or not this program can read maps.
std::vector<std::string> geometry_suffixes();

/// Whether files of this suffix have layers.
bool has_layers_of_drawings(const std::string& path);

using GeometryReader = std::vector<Chain> (*)(const std::string& path, const DrawingChoice& choice,
                                              std::vector<std::string>& warnings, FileUnit& unit);

/// Registers `reader` for files of this suffix, in the whole process.
void add_geometry_reader(const std::string& suffix, GeometryReader reader);

}  // namespace quadloop::io
