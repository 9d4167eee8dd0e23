#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Reads the lines and polygons of every layer of a file that GDAL/OGR knows (DXF, GeoJSON, shapefile,
/// GeoPackage), coordinates as they are. A line whose ends coincide is a loop. The boundary is named by the
/// feature's attribute "boundary", "name" or (DXF) "Layer", else by the layer; blanks become underscores.
/// Features of other kinds are left out, with a warning.
std::vector<Chain> read_ogr(const std::string& path, std::vector<std::string>& warnings);

}  // namespace quadloop
