#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/base/parallel/partners.hpp"
#include "mesher/geometry/mirror_axis.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Throws the InputError for a node or cell (`what`) without a mirror image.
[[noreturn]] void refuse_without_image(MirrorAxis axis, const char* what, Point place);

using NodeImages = IdVector<NodeId, GlobalNodeId>;

/// Returns the global number of the mirror image of each owned node: the node at the mirrored position,
/// bitwise; invalid if there is none. *Collective.*
NodeImages node_images(const Communicator& comm, std::int64_t first_node, std::span<const Point> owned,
                       MirrorAxis axis);

/// Returns the images of all nodes of the mesh, owned and ghosts. Throws InputError, naming the first
/// location, if a node has none. *Collective.*
NodeImages find_node_images(const Communicator& comm, const Mesh& mesh, MirrorAxis axis);

/// Returns rank and index of the mirror image of each of this rank's triangles. Throws InputError, naming the
/// first location, if one has none. *Collective.*
std::vector<Partner> find_triangle_images(const Communicator& comm, const Mesh& mesh,
                                          const NodeImages& images, MirrorAxis axis);

/// Throws InputError, naming the first location, unless each node and each cell has a mirror image.
/// *Collective.*
void require_mirror_images(const Communicator& comm, const Mesh& mesh, MirrorAxis axis);

}  // namespace quadloop
