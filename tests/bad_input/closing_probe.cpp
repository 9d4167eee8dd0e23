// Ends as main() does, with errors on the ranks that the arguments name; the other ranks wait in a barrier
// that never completes, or, with "go on" as the first argument, come to their end.
#include <mpi.h>

#include <algorithm>
#include <string>

#include "app/collective_exit.hpp"
#include "mesher/base/parallel/communicator.hpp"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int status = 0;
  {
    const quadloop::Communicator comm(MPI_COMM_WORLD), closing(MPI_COMM_WORLD);
    const bool others_wait = std::string(argv[1]) == "wait";
    const bool fails =
        std::any_of(argv + 2, argv + argc, [&](const char* rank) { return std::stoi(rank) == comm.rank(); });
    quadloop::app::Outcome outcome;
    if (fails)
      outcome = {quadloop::ExitStatus::output_failed, "rank " + std::to_string(comm.rank()) + "\nfailed"};
    else if (others_wait)
      comm.barrier();
    status = static_cast<int>(quadloop::app::close_together(closing.raw(), outcome));
  }
  MPI_Finalize();
  return status;
}
