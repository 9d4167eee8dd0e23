#pragma once

#include <string>
#include <vector>

#include "io/input/geometry_file.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop::io {

/// Reads the lines and polygons of every layer, or of the named layers, of a file supported by GDAL/OGR
/// (GeoJSON, shapefile, GeoPackage), with unchanged coordinates. A line with coincident ends is a loop. The
/// boundary is named by the feature's attribute "name" or "boundary", else by the layer, or as the choice
/// says; blanks become underscores. Other features are omitted, with a warning.
std::vector<Chain> read_ogr(const std::string& path, const DrawingChoice& choice,
                            std::vector<std::string>& warnings, FileUnit& unit);

}  // namespace quadloop::io
