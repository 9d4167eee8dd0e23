#pragma once

#include <string>
#include <vector>

#include "app/closing.hpp"
#include "app/command_line.hpp"
#include "mesher/base/json.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop {

/// What `--json` prints of a command: one object on one line. A failure has it too, with what was known by
/// then.
struct CommandRecord {
  std::string command;
  JsonObject figures;                        ///< what the table says, on the root rank
  std::vector<std::string> warnings, files;  ///< all warnings; the files that were written
  /// Warnings that the work has noted so far, which the user has not yet been told of. On every rank.
  std::vector<std::string> noted = {};
};

/// The record of a command that ended so: {"command", "status", "error", figures ..., "warnings", "files"};
/// "error" is null where there is none.
std::string record_text(const CommandRecord& record, const Outcome& outcome);

/// What every command is given, and where it leaves its work.
///
///     add_x_command(line, context)     adds the command `x` with its options
///     line.parse(...)                  returns the work of the chosen command
///     work()                           does it, *collectively*, and throws an Error of mesher/base/error.hpp
///
/// Options live in a shared_ptr that the work captures. `quiet` and `verbose` are known when the work is
/// done, not before. Results for the user go to stdout from the rank and in the manner that `shows_table`
/// says, and into `record` always; logs go through mesher/base/log.hpp, warnings through `warn`.
struct CommandContext {
  const Communicator& comm;
  bool quiet = false;
  bool verbose = false;
  bool json = false;
  CommandRecord& record;

  /// Whether this rank prints the table for people.
  bool shows_table() const { return comm.is_root() && !quiet && !json; }
  /// From the root rank, after those noted: the first few, unless `verbose`; all of them into the record,
  /// which with `quiet` is the only place. What the record has already is passed over.
  void warn(const std::vector<std::string>& warnings) const;
  /// Those noted join the record. Returns the lines to print of them before the error that ends the command.
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
void add_help_command(CommandLine& line, CommandContext& context);

}  // namespace quadloop
