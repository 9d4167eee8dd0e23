#pragma once

namespace quadloop::io {

/// Enables geometry files in .geojson, .shp and .gpkg formats, read by GDAL, for the whole process.
/// Further calls have no effect.
void add_gis_formats();

}  // namespace quadloop::io
