#include <fmt/format.h>
#include <malloc.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <exception>
#include <iostream>
#include <limits>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "app/closing.hpp"
#include "app/command.hpp"
#include "mesher/base/communicator.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/free_memory.hpp"
#include "mesher/base/log.hpp"
#include "mesher/base/progress.hpp"

namespace quadloop {

namespace {

/// MPI's own way would be to print a paragraph and to end all ranks.
void throw_mpi_error(MPI_Comm* /*unused*/, int* code, ...) {
  int kind = MPI_SUCCESS, length = 0;
  MPI_Error_class(*code, &kind);
  if (kind == MPI_ERR_NO_MEM) throw std::bad_alloc();
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  MPI_Error_string(*code, text.data(), &length);
  throw Fault(std::string("MPI: ") + text.data());
}

/// MPI from its beginning to its end. Its errors are exceptions, also those of communicators made from the first one.
class MpiGuard {
 public:
  MpiGuard(int& argc, char**& argv) {
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

std::vector<CLI::App*> commands_of(CLI::App& app) {
  return app.get_subcommands([](CLI::App*) { return true; });
}

/// What is wrong where no word of the command line is a command.
std::string without_command(CLI::App& app) {
  std::string commands;
  for (const CLI::App* command : commands_of(app)) commands += (commands.empty() ? "" : ", ") + command->get_name();
  const std::vector<std::string> words = app.remaining();
  const bool names_one = !words.empty() && !words.front().starts_with('-');
  const std::string fault = names_one ? "'" + words.front() + "' is no command" : "a command is missing";
  return fmt::format("{}; the commands are: {}; see 'quadloop --help'", fault, commands);
}

/// Lets CLI11 say what it has to say (help, version) on the root rank; what is wrong becomes our own one line.
void answer(CLI::App& app, const CLI::ParseError& request, const Communicator& comm) {
  if (request.get_exit_code() == 0) {
    if (comm.is_root()) app.exit(request, std::cout, std::cerr);
    return;
  }
  if (app.get_subcommands().empty()) throw UsageError(without_command(app));
  std::string command = "quadloop";
  for (const CLI::App* subcommand : app.get_subcommands()) command += " " + subcommand->get_name();
  throw UsageError(fmt::format("{}; see '{} --help'", request.what(), command));
}

/// Whether a word after an assignment is one more: table.key=value, which no path looks like.
bool is_assignment(std::string_view word) {
  const std::string_view key = word.substr(0, word.find('='));
  return key.size() < word.size() && !key.starts_with('-') && key.find('.') != std::string_view::npos && key.find('/') == std::string_view::npos;
}

/// The command line, last word first as CLI11 takes it, with --set before each of the assignments that follow one: an option of many values would
/// take the case file for one of them.
std::vector<std::string> words_of(int argc, char** argv) {
  std::vector<std::string> words;
  bool in_assignments = false;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool is_value = i > 1 && words.back() == "--set";
    if (in_assignments && !is_value && is_assignment(word)) words.emplace_back("--set");
    in_assignments = is_value || (in_assignments && is_assignment(word));
    words.push_back(word);
  }
  std::reverse(words.begin(), words.end());
  return words;
}

void run(int argc, char** argv, const Communicator& comm) {
  CLI::App app("quadloop: parallel 2D mesh generation from named outlines", "quadloop");
  CommandContext context{comm, false, false, {}};
  app.fallthrough();
  app.require_subcommand(1);
  app.set_version_flag("--version", "quadloop " QUADLOOP_VERSION);
  const char* const quiet = "print nothing but warnings and errors";
  const char* const verbose = "print details, those of each rank too";
  app.add_flag("-q,--quiet", context.quiet, quiet);
  app.add_flag("-v,--verbose", context.verbose, verbose);
  add_mesh_command(app, context);
  add_smooth_command(app, context);
  add_adapt_command(app, context);
  add_solve_command(app, context);
  add_remesh_command(app, context);
  add_check_command(app, context);
  add_plot_command(app, context);
  for (CLI::App* command : commands_of(app)) {
    command->footer(
        fmt::format("With every command:\n  -q,--quiet                  {}\n  -v,--verbose                {}\n  --version", quiet, verbose));
  }
  try {
    app.parse(words_of(argc, argv));
  } catch (const CLI::ParseError& request) {
    answer(app, request, comm);
    return;
  }
  log::configure({comm.rank(), comm.size(), context.quiet, context.verbose});
  if (comm.is_root() && !context.quiet) progress::show();
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
    return {ExitStatus::bad_input, out_of_memory};
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
