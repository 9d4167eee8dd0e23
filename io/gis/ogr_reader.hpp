#pragma once

#include <string>
#include <vector>

#include "io/input/geometry_file.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop::io {

/// Reads the lines and polygons of every layer, or of the named layers, of a file supported by GDAL/OGR (DXF,
/// GeoJSON, shapefile, GeoPackage), with unchanged coordinates. A line with coincident ends is a loop. The
/// boundary is named by the feature's attribute "name", "boundary" or (DXF) "Layer", else by the layer;
/// blanks become underscores. Other features are omitted, with a warning. In a drawing only model space is
/// read, and only layers that are neither off nor frozen unless they are named; dimensions, texts, hatches,
/// leaders and points are ignored. A spline has a point at each of its knots.
std::vector<Chain> read_ogr(const std::string& path, const LayerNames& layers,
                            std::vector<std::string>& warnings, FileUnit& unit);

}  // namespace quadloop::io
