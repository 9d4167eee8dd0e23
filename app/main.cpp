#include <fmt/format.h>
#include <malloc.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <exception>
#include <iostream>
#include <limits>
#include <new>
#include <string_view>

#include "app/collective_exit.hpp"
#include "app/command.hpp"
#include "app/command_line.hpp"
#include "app/mpi_singleton.hpp"
#include "io/files/interruption.hpp"
#include "io/files/reading/input_file.hpp"
#include "io/gis/gis_formats.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/log.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/base/parallel/free_memory.hpp"
#include "mesher/base/progress.hpp"

namespace quadloop::app {

namespace {

/// MPI's default would be to print a paragraph and to abort all ranks.
void throw_mpi_error(MPI_Comm* /*unused*/, int* code, ...) {
  int kind = MPI_SUCCESS, length = 0;
  MPI_Error_class(*code, &kind);
  if (kind == MPI_ERR_NO_MEM) throw std::bad_alloc();
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  MPI_Error_string(*code, text.data(), &length);
  throw Fault(std::string("MPI: ") + text.data());
}

/// Initialises and finalises MPI. Its errors become exceptions, also for communicators derived from the first
/// one.
class MpiGuard {
 public:
  MpiGuard(int& argc, char**& argv) {
    const MpiSingleton settings;
    MPI_Init(&argc, &argv);
    MPI_Errhandler handler = MPI_ERRHANDLER_NULL;
    MPI_Comm_create_errhandler(throw_mpi_error, &handler);
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, handler);
    MPI_Errhandler_free(&handler);
  }
  ~MpiGuard() { MPI_Finalize(); }
  MpiGuard(const MpiGuard&) = delete;
  MpiGuard& operator=(const MpiGuard&) = delete;
};

constexpr const char* about_quiet = "print only warnings and errors";
constexpr const char* about_verbose = "print details, also of each rank";
constexpr const char* about_json = "print one JSON record instead of a table";

void add_commands(CommandLine& line, CommandContext& context) {
  line.add_flag("-q,--quiet", context.quiet, about_quiet);
  line.add_flag("-v,--verbose", context.verbose, about_verbose);
  line.add_flag("--json", context.json, about_json);
  add_mesh_command(line, context);
  add_smooth_command(line, context);
  add_adapt_command(line, context);
  add_solve_command(line, context);
  add_remesh_command(line, context);
  add_check_command(line, context);
  add_plot_command(line, context);
  add_convert_command(line, context);
  add_extrude_command(line, context);
  add_morph_command(line, context);
  add_airfoil_command(line, context);
  add_help_command(line, context);
  line.set_footer(
      fmt::format("With every command:\n  -q,--quiet                  {}\n  -v,--verbose                {}\n"
                  "  --json                      {}\n  --version",
                  about_quiet, about_verbose, about_json));
}

/// The command's name is set in the record if a command is to be run.
void run(int argc, char** argv, CommandContext& context) {
  const Communicator& comm = context.comm;
  CommandLine line("quadloop: parallel 2D mesh generation from named boundary curves", "quadloop",
                   "quadloop " QUADLOOP_VERSION);
  add_commands(line, context);
  const auto work = line.parse(argc, argv, comm, context.record.command);
  if (!work) return;
  io::allow_piped_input(comm.size() == 1);
  log::configure({comm.rank(), comm.size(), context.quiet, context.verbose});
  if (comm.is_root() && !context.quiet) progress::show();
  work();
  context.warn({});  // shows the recorded warnings
}

Outcome guarded_run(int argc, char** argv, CommandContext& context) {
  try {
    run(argc, argv, context);
    std::cout.flush();
    if (!std::cout) return {ExitStatus::output_failed, "standard output cannot be written"};
    return {};
  } catch (const Error& error) {
    return {error.status(), error.what()};
  } catch (const std::bad_alloc&) {
    return {ExitStatus::bad_input, out_of_memory};
  } catch (const std::exception& error) {
    return {ExitStatus::fault, fmt::format("internal error: {}", error.what())};
  }
}

/// Runs the command, and creates its record if the command line requests one, even if it is invalid.
Outcome recorded_run(int argc, char** argv, const Communicator& comm) {
  CommandRecord record;
  CommandContext context{comm, false, false, false, record};
  Outcome outcome = guarded_run(argc, argv, context);
  if (outcome.status != ExitStatus::done) outcome.warnings = context.warnings_before_error();
  const bool wanted = std::find(argv + 1, argv + argc, std::string_view("--json")) != argv + argc;
  // neither help nor version
  const bool has_run = !record.command.empty() || outcome.status != ExitStatus::done;
  if (wanted && has_run) outcome.record = record_text(record, outcome);
  return outcome;
}

/// Large arrays are allocated and freed between stages: keeping their pages avoids requesting and clearing
/// them again (a seventh of the run time for a million cells).
void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_TOP_PAD, 1 << 26);
#endif
}

}  // namespace

}  // namespace quadloop::app

int main(int argc, char** argv) {
  quadloop::app::keep_freed_memory();
  const quadloop::app::MpiGuard mpi(argc, argv);
  quadloop::io::remove_temporaries_when_killed();
  quadloop::io::add_gis_formats();
  const quadloop::Communicator comm(MPI_COMM_WORLD), closing(MPI_COMM_WORLD);
  return static_cast<int>(
      quadloop::app::close_together(closing.raw(), quadloop::app::recorded_run(argc, argv, comm)));
}
