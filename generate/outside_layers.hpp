#pragma once

#include "generate/generate.hpp"
#include "mesher/geometry/measured_flow.hpp"
#include "mesher/layers/front/layer_front.hpp"

namespace quadloop {

/// Whether any wall or line has layers.
bool has_layers(const MeshInput& input);

/// Whether any wall specifies a y+, so that its first heights can follow a computed flow.
bool wants_y_plus(const Geometry& geometry);

/// Whether any wall's layers have the thickness of the boundary layer of a computed flow.
bool wants_thickness_of_flow(const Geometry& geometry);

/// Whether any wake, with layers or without, follows the flow.
bool wants_streamlines(const MeshInput& input);

/// Returns the geometry without islands that are too small for any quadtree cell to resolve; the mesh would
/// lose them without layers too. They are recorded in `dropped`. Throws InputError if a boundary that must be
/// kept is lost.
Geometry geometry_with_layers(const MeshInput& input, MeshReport& dropped);

/// Returns the outer edge of an input's layers on such a geometry, which must outlive it. `demanded`: the
/// requests of adaptation, which layers and the columns of wakes and layer lines follow. Throws TooManyCells,
/// naming the line, if strips would have more cells than the input allows. *Collective.*
LayerFront front_of(const Communicator& comm, const MeshInput& input, const Geometry& geometry,
                    const MeasuredFlow& measured, const DemandedSplits& demanded);

/// Returns the same input for the domain outside the layers, with the same root.
MeshInput outside(const MeshInput& input, const LayerFront& front);

}  // namespace quadloop
