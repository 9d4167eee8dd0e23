#pragma once

namespace quadloop::io {

/// Names of field data with a number for each boundary: its number of layers, and their requested thickness.
inline constexpr const char *vtu_layer_counts = "boundary_layers",
                            *vtu_layer_thicknesses = "boundary_layers_thickness";

/// Name of the field data with strips, one text each, in the format of comments_of().
inline constexpr const char *vtu_strips = "strips";

/// Names of point data written with a solution if the mesh has layers: requested and actual height of the
/// layers above wall nodes. They belong to the mesh and are not variables.
inline constexpr const char *vtu_layer_height_asked = "layer_height_asked",
                            *vtu_layer_height = "layer_height";

}  // namespace quadloop::io
