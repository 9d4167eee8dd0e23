#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Reads the polylines of a geometry file, told by its suffix: .geom, .dat (airfoil), .dxf, .geojson, .shp,
/// .gpkg. On the calling rank alone. Throws InputError "file:line: ..." where the file is not what its suffix
/// says. What was left out of the file is told by a warning each.
std::vector<Chain> read_geometry(const std::string& path, std::vector<std::string>& warnings);

}  // namespace quadloop
