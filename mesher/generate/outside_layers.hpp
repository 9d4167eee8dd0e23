#pragma once

#include "mesher/generate/generate.hpp"
#include "mesher/geometry/measured_wall.hpp"
#include "mesher/layers/front/layer_front.hpp"

namespace quadloop {

/// Whether any wall or line asks for layers.
bool has_layers(const MeshInput& input);

/// Whether any wall wants a y+, so that its first heights can follow a measured flow.
bool wants_y_plus(const Geometry& geometry);

/// The front of an input's layers. Islands that no leaf can tell are left out before, and noted in `dropped`;
/// throws InputError where a boundary that may not vanish does.
LayerFront front_of(const MeshInput& input, const MeasuredWall& measured, MeshReport& dropped);

/// The same input for the domain outside the layers, in the same root.
MeshInput outside(const MeshInput& input, const LayerFront& front);

}  // namespace quadloop
