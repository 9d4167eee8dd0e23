#pragma once

#include <functional>

#include "mesher/base/communicator.hpp"

namespace CLI {
class App;
}

namespace quadloop {

/// What every command is given, and where it leaves its work.
///
///     add_x_command(app, context)      adds the subcommand `x` with its options
///     app.parse(...)                   the subcommand's callback only sets `context.run`
///     context.run()                    does the work, *collectively*, and throws an Error of mesher/base/error.hpp
///
/// Options live in a shared_ptr that the callback captures. `quiet` and `verbose` are known when `run` is called, not before.
/// Results for the user go to stdout from the root rank, and not with `quiet`; logs go through mesher/base/log.hpp.
struct CommandContext {
  const Communicator& comm;
  bool quiet = false;
  bool verbose = false;
  std::function<void()> run;
};

void add_mesh_command(CLI::App& app, CommandContext& context);
void add_adapt_command(CLI::App& app, CommandContext& context);
void add_solve_command(CLI::App& app, CommandContext& context);
void add_remesh_command(CLI::App& app, CommandContext& context);
void add_smooth_command(CLI::App& app, CommandContext& context);
void add_solve_command(CLI::App& app, CommandContext& context);
void add_check_command(CLI::App& app, CommandContext& context);
void add_plot_command(CLI::App& app, CommandContext& context);

}  // namespace quadloop
