#pragma once

#include <string>
#include <vector>

#include "io/input/geometry_file.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Reads the lines and polygons of every layer of a file that GDAL/OGR knows (DXF, GeoJSON, shapefile,
/// GeoPackage), or of the layers named, coordinates as they are. A line whose ends coincide is a loop. The
/// boundary is named by the feature's attribute "name", "boundary" or (DXF) "Layer", else by the layer;
/// blanks become underscores. Features of other kinds are left out, with a warning. Of a drawing, model space
/// alone is read, and layers that are neither off nor frozen unless they are named; dimensions, texts,
/// hatches, leaders and points are no outline. A spline has a point at each of its knots.
std::vector<Chain> read_ogr(const std::string& path, const LayerNames& layers,
                            std::vector<std::string>& warnings, FileUnit& unit);

}  // namespace quadloop
