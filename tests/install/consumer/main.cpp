// Meshes a square through the installed package, on as many ranks as there are.

#include <mpi.h>

#include <cstdio>

#include "mesher/build/build_mesh.hpp"
#include "mesher/geometry/assemble/assemble.hpp"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  std::int64_t cells = 0;
  {
    const quadloop::Communicator comm(MPI_COMM_WORLD);
    quadloop::Chain side{"side", false, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, "consumer"};
    quadloop::Warnings warnings;
    const quadloop::Geometry geometry = quadloop::assemble({std::move(side)}, {}, warnings);
    quadloop::MeshOptions options;
    options.size.min = options.size.max = 0.125;
    const quadloop::Mesh mesh = quadloop::build_mesh(comm, geometry, options).mesh;
    cells = comm.sum(static_cast<std::int64_t>(mesh.triangles.size() + mesh.quads.size()));
    if (comm.is_root()) std::printf("%lld cells\n", static_cast<long long>(cells));
  }
  MPI_Finalize();
  return cells == 64 ? 0 : 1;
}
