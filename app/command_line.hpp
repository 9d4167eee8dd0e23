#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace quadloop::app {

/// An option or a positional argument of a command. Only command_line.cpp includes CLI11, which is slow to
/// compile.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_{option} {}

  Option& required();
  /// Sets the name of the value in the help text.
  Option& value_name(const std::string& name);
  /// Sets the number of values of the option.
  Option& count(int values);
  Option& one_of(const std::vector<std::string>& words);
  Option& between(std::int64_t low, std::int64_t high);
  /// A finite, positive number.
  Option& positive();
  Option& excludes(const Option& other);

 private:
  CLI::Option* option_;  ///< owned by its command
};

/// A command with its options. Values are set when the command line is parsed.
class Command {
 public:
  Command(CLI::App& app, std::function<void()>& chosen) : app_{app}, chosen_{chosen} {}

  /// `names` e.g. "-o,--output"; without a dash it is a positional argument. Value: std::string, int,
  /// std::int64_t, double, the last two or int as std::optional, or std::vector<std::string>.
  template <class Value>
  Option add_option(const std::string& names, Value& value, const std::string& help);
  Option add_flag(const std::string& names, bool& value, const std::string& help);

  /// Add the argument CASE.toml and the option --set for commands that read a case; --set must be the last
  /// option. `example` is an assignment that suits the command.
  void add_case_argument(std::string& case_path);
  void add_set_option(std::vector<std::string>& assignments, const std::string& example);
  /// Adds the option --max-cells of commands that generate a mesh.
  void add_max_cells_option(std::optional<double>& max_cells);

  /// Sets what CommandLine::parse returns if the user selects this command.
  void set_work(std::function<void()> work);

 private:
  CLI::App& app_;
  std::function<void()>& chosen_;
};

/// All commands of a program, and the options common to all.
class CommandLine {
 public:
  CommandLine(const std::string& description, const std::string& name, const std::string& version);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Adds a flag to every command.
  void add_flag(const std::string& names, bool& value, const std::string& help);
  Command add_command(const std::string& name, const std::string& help);
  /// Sets the last lines of the help text of each command.
  void set_footer(const std::string& text);

  /// Returns the work of the selected command, and its name in `command`. Empty if help or version was
  /// requested, which the root rank prints. Throws UsageError with one line, first of all for an unknown
  /// option or command, with the nearest known one; `command` is then set too, if one was named.
  std::function<void()> parse(int argc, char** argv, const Communicator& comm, std::string& command);

 private:
  std::unique_ptr<CLI::App> app_;
  std::function<void()> chosen_;
};

}  // namespace quadloop::app
