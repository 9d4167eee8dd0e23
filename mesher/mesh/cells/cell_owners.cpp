#include "mesher/mesh/cells/cell_owners.hpp"

namespace quadloop {

CellOwners::CellOwners(const Communicator& comm, const Mesh& mesh)
    : own_triangles_{std::ssize(mesh.triangles)},
      all_triangles_{comm.sum(own_triangles_)},
      first_triangle_{comm.exclusive_sum(own_triangles_)},
      first_quad_{all_triangles_ + comm.exclusive_sum(std::ssize(mesh.quads))},
      triangles_(comm, first_triangle_),
      quads_(comm, first_quad_) {}

}  // namespace quadloop
