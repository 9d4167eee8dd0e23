#pragma once

#include "generate/generate.hpp"
#include "mesher/geometry/measured_wall.hpp"
#include "mesher/layers/front/layer_front.hpp"

namespace quadloop {

/// Whether any wall or line asks for layers.
bool has_layers(const MeshInput& input);

/// Whether any wall wants a y+, so that its first heights can follow a measured flow.
bool wants_y_plus(const Geometry& geometry);

/// The geometry without islands that no leaf can tell, as they would go without layers; they are noted in
/// `dropped`. Throws InputError where a boundary that may not vanish does.
Geometry geometry_with_layers(const MeshInput& input, MeshReport& dropped);

/// The front of an input's layers on such a geometry, which must outlive it. Throws TooManyCells, naming the
/// line, where strips would have more cells than the input allows.
LayerFront front_of(const MeshInput& input, const Geometry& geometry, const MeasuredWall& measured);

/// The same input for the domain outside the layers, in the same root.
MeshInput outside(const MeshInput& input, const LayerFront& front);

}  // namespace quadloop
