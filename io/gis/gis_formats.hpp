#pragma once

namespace quadloop {

/// From here on geometry may stand in .dxf, .geojson, .shp and .gpkg files too; GDAL reads them. In the whole
/// process; calls beyond the first do nothing new.
void add_gis_formats();

}  // namespace quadloop
