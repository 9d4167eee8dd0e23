// A program that does nothing but run a solver: solver_probe FOLDER runs FOLDER/solver.sh.
#include <mpi.h>

#include <string>

#include "flow/command/solver_command.hpp"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  if (argc == 2) {
    const quadloop::Communicator comm(MPI_COMM_WORLD);
    const std::string folder = argv[1];
    quadloop::flow::run_solver(comm, {{"{case}/solver.sh", "{solution}"}, 60},
                               {folder, folder + "/mesh.mesh", folder + "/solution.mesh", folder, 1, 0});
  }
  MPI_Finalize();
}
