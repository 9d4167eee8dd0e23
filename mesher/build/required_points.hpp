#pragma once

#include <vector>

#include "mesher/build/build_mesh.hpp"

namespace quadloop {

/// Returns the options with sizes for which each required point is at least 1.5 leaves away from the geometry
/// and from the other points, and without the points that are feature points of the geometry: these are nodes
/// anyway. Throws InputError for a point outside the domain, and for one so near that this needs leaves
/// smaller than options.size.min.
MeshOptions with_room_for_points(const Geometry& geometry, const MeshOptions& options);

std::vector<Point> positions_of(const std::vector<RequiredPoint>& points);

/// Returns the points that are no feature points of `whole`; feature points of the outline may have layers
/// over them. Throws InputError for a point in the boundary layers: in the domain of `whole`, but not in that
/// of `outer`, the outer edge of the layers.
std::vector<RequiredPoint> points_outside_layers(const Geometry& whole, const Geometry& outer,
                                                 const std::vector<RequiredPoint>& points);

/// Returns the nodes at the required points; of several nodes at one place, as on the two sides of a baffle,
/// the first. Throws InputError on all ranks for a point without a node. *Collective.*
std::vector<NamedNode> nodes_at(const Communicator& comm, const std::vector<RequiredPoint>& points,
                                const Mesh& mesh);

}  // namespace quadloop
