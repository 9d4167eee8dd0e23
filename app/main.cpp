#include <fmt/format.h>
#include <malloc.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <limits>
#include <new>
#include <sstream>

#include "app/closing.hpp"
#include "app/command.hpp"
#include "mesher/base/communicator.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/log.hpp"

namespace quadloop {

namespace {

/// MPI from its beginning to its end.
class MpiGuard {
 public:
  MpiGuard(int& argc, char**& argv) { MPI_Init(&argc, &argv); }
  ~MpiGuard() { MPI_Finalize(); }
  MpiGuard(const MpiGuard&) = delete;
  MpiGuard& operator=(const MpiGuard&) = delete;
};

/// Lets CLI11 say what it has to say (help, version) on the root rank; what is wrong becomes our own one line.
void answer(const CLI::App& app, const CLI::ParseError& request, const Communicator& comm) {
  if (request.get_exit_code() == 0) {
    if (comm.is_root()) app.exit(request, std::cout, std::cerr);
    return;
  }
  std::string command = "quadloop";
  for (const CLI::App* subcommand : app.get_subcommands()) command += " " + subcommand->get_name();
  throw UsageError(fmt::format("{}; see '{} --help'", request.what(), command));
}

void run(int argc, char** argv, const Communicator& comm) {
  CLI::App app("quadloop: parallel 2D mesh generation from named outlines", "quadloop");
  CommandContext context{comm, false, false, {}};
  app.fallthrough();
  app.require_subcommand(1);
  app.set_version_flag("--version", "quadloop " QUADLOOP_VERSION);
  app.add_flag("-q,--quiet", context.quiet, "print nothing but warnings and errors");
  app.add_flag("-v,--verbose", context.verbose, "print details, those of each rank too");
  add_mesh_command(app, context);
  add_smooth_command(app, context);
  add_solve_command(app, context);
  add_check_command(app, context);
  add_plot_command(app, context);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& request) {
    answer(app, request, comm);
    return;
  }
  log::configure({comm.rank(), comm.size(), context.quiet, context.verbose});
  context.run();
}

Outcome guarded_run(int argc, char** argv, const Communicator& comm) {
  try {
    run(argc, argv, comm);
    std::cout.flush();
    if (!std::cout) return {ExitStatus::output_failed, "standard output cannot be written"};
    return {};
  } catch (const Error& error) {
    return {error.status(), error.what()};
  } catch (const std::bad_alloc&) {
    return {ExitStatus::fault, "out of memory; use more ranks on more machines, or a larger spacing"};
  } catch (const std::exception& error) {
    return {ExitStatus::fault, fmt::format("a fault of the program itself: {}", error.what())};
  }
}

/// Arrays of many megabytes come and go between the stages: kept, their pages need not be asked for and cleared again each time (a seventh of the
/// run for a million cells).
void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_TOP_PAD, 1 << 26);
#endif
}

}  // namespace

}  // namespace quadloop

int main(int argc, char** argv) {
  quadloop::keep_freed_memory();
  const quadloop::MpiGuard mpi(argc, argv);
  const quadloop::Communicator comm(MPI_COMM_WORLD), closing(MPI_COMM_WORLD);
  return static_cast<int>(close_together(closing.raw(), quadloop::guarded_run(argc, argv, comm)));
}
