// Adapts a mesh to a field in memory: the case file says how, the "solver" is the function height() below.
//
//     mpirun -n 3 adapt_in_memory ../cases/ring/case.toml adapted.vtu
#include <mpi.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "quadloop/quadloop.hpp"

namespace {

/// A step across a circle of radius 0.6: what a solver would compute.
double height(quadloop::Point p) { return std::tanh((std::hypot(p.x, p.y) - 0.6) / 0.01); }

quadloop::Field solve(const quadloop::Mesh& mesh) {
  quadloop::Field field{{"height"}, {}, {}};
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node)
    field.values.push_back(height(mesh.point(quadloop::NodeId{node})));
  return field;
}

/// They are the same on all ranks.
void show(const quadloop::Communicator& comm, const std::vector<std::string>& warnings) {
  if (!comm.is_root()) return;
  for (const std::string& warning : warnings) std::fprintf(stderr, "adapt_in_memory: %s\n", warning.c_str());
}

void adapt(const quadloop::Communicator& comm, const std::string& case_file, const std::string& output) {
  const quadloop::Case ring(comm, case_file);
  show(comm, ring.warnings());
  quadloop::NewMesh made = quadloop::make_mesh(comm, ring);
  show(comm, made.warnings);
  quadloop::SolvedMesh now = std::move(made.solved);
  now.solution = solve(now.mesh);
  for (int cycle = 0; cycle < ring.cycles(); ++cycle) {
    const quadloop::RefinementFlags flags = quadloop::sense(comm, ring, now);
    if (comm.is_root()) std::printf("%lld leaves to be split\n", static_cast<long long>(flags.refined()));
    show(comm, flags.warnings());
    if (!flags.changes_mesh()) break;
    made = quadloop::remesh(comm, ring, flags, now);  // with the old solution on the new mesh
    show(comm, made.warnings);
    now = std::move(made.solved);
    now.solution = solve(now.mesh);
  }
  if (!quadloop::check(comm, now.mesh).empty()) throw quadloop::Fault("the mesh is not valid");
  show(comm, quadloop::write(comm, now.mesh, output, now.solution));
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int status = argc == 3 ? 0 : 2;
  try {
    const quadloop::Communicator comm(MPI_COMM_WORLD);
    if (status == 0) adapt(comm, argv[1], argv[2]);
  } catch (const quadloop::Error& error) {  // the same on all ranks
    std::fprintf(stderr, "adapt_in_memory: %s\n", error.what());
    status = 1;
  }
  MPI_Finalize();
  return status;
}
