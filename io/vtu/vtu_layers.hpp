#pragma once

namespace quadloop {

/// Names of field data, a number for each boundary: of its layers, and how thick they were asked to be.
inline constexpr const char *vtu_layer_counts = "boundary_layers",
                            *vtu_layer_thicknesses = "boundary_layers_thickness";

/// And of the texts that tell of strips, one each, as comments_of() gives it.
inline constexpr const char *vtu_strips = "strips";

/// Names of point data that a mesh with layers has beside a solution: what they were asked to reach above the
/// wall's nodes, and what they do. They are the mesh's, and no variables.
inline constexpr const char *vtu_layer_height_asked = "layer_height_asked",
                            *vtu_layer_height = "layer_height";

}  // namespace quadloop
