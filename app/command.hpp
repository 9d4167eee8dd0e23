#pragma once

#include <string>
#include <vector>

#include "app/collective_exit.hpp"
#include "app/command_line.hpp"
#include "mesher/base/json.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::app {

/// Output of `--json` for a command: one object on one line. Also printed on failure, with what is known by
/// then.
struct CommandRecord {
  std::string command;
  JsonObject statistics;                     ///< contents of the table, on the root rank
  std::vector<std::string> warnings, files;  ///< all warnings; the files that were written
  /// Warnings recorded so far that have not been shown to the user. On every rank.
  std::vector<std::string> noted = {};
};

/// Returns the record of a finished command: {"command", "status", "error", figures ..., "warnings",
/// "files"}; "error" is null if there is none.
std::string record_text(const CommandRecord& record, const Outcome& outcome);

/// Context of a command.
///
///     add_x_command(line, context)     adds the command `x` with its options
///     line.parse(...)                  returns the work of the chosen command
///     work()                           does it, *collectively*, and throws an Error of mesher/base/error.hpp
///
/// Options are stored in a shared_ptr that the work captures. `quiet` and `verbose` are valid only when the
/// work runs. Results for the user are printed to stdout if `shows_table` is true, and always added to
/// `record`; logs use mesher/base/log.hpp, warnings `warn`.
struct CommandContext {
  const Communicator& comm;
  bool quiet = false;
  bool verbose = false;
  bool json = false;
  CommandRecord& record;

  /// Whether this rank prints the table.
  bool shows_table() const { return comm.is_root() && !quiet && !json; }
  /// Shows warnings from the root rank, after those recorded earlier: the first few, unless `verbose`. All of
  /// them are added to the record, with `quiet` only there. Those already in the record are skipped.
  void warn(const std::vector<std::string>& warnings) const;
  /// Moves the recorded warnings to the record. Returns the lines to print before the error that ends the
  /// command.
  std::vector<std::string> warnings_before_error() const;
};

void add_mesh_command(CommandLine& line, CommandContext& context);
void add_adapt_command(CommandLine& line, CommandContext& context);
void add_remesh_command(CommandLine& line, CommandContext& context);
void add_morph_command(CommandLine& line, CommandContext& context);
void add_smooth_command(CommandLine& line, CommandContext& context);
void add_solve_command(CommandLine& line, CommandContext& context);
void add_check_command(CommandLine& line, CommandContext& context);
void add_plot_command(CommandLine& line, CommandContext& context);
void add_convert_command(CommandLine& line, CommandContext& context);
void add_extrude_command(CommandLine& line, CommandContext& context);
void add_airfoil_command(CommandLine& line, CommandContext& context);
void add_help_command(CommandLine& line, CommandContext& context);

}  // namespace quadloop::app
