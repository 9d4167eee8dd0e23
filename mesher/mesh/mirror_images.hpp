#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/base/parallel/partners.hpp"
#include "mesher/geometry/mirror_axis.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Throws the InputError for a node or cell, `what`, without a mirror image.
[[noreturn]] void refuse_without_image(MirrorAxis axis, const char* what, Point place);

using NodeImages = IdVector<NodeId, GlobalNodeId>;

/// The mirror image of each of this rank's owned nodes, by its number over all ranks: the node that lies at
/// the node's place, mirrored, to the last bit; no node where there is none. *Collective.*
NodeImages node_images(const Communicator& comm, std::int64_t first_node, std::span<const Point> owned,
                       MirrorAxis axis);

/// The same for each of the mesh's points, owned and copies. Throws InputError, naming the first place, where
/// a node has none. *Collective.*
NodeImages find_node_images(const Communicator& comm, const Mesh& mesh, MirrorAxis axis);

/// Where the image of each of this rank's triangles stands, by its index there. Throws InputError, naming the
/// first place, where one has none. *Collective.*
std::vector<Partner> find_triangle_images(const Communicator& comm, const Mesh& mesh,
                                          const NodeImages& images, MirrorAxis axis);

/// Throws InputError, naming the first place, unless each node and each cell has its mirror image.
/// *Collective.*
void require_mirror_images(const Communicator& comm, const Mesh& mesh, MirrorAxis axis);

}  // namespace quadloop
