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

namespace quadloop {

/// An option or a positional argument of a command. Only command_line.cpp includes CLI11, which takes the
/// compiler longer than all else in this folder.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_{option} {}

  Option& required();
  /// The name of the value in the help text.
  Option& value_name(const std::string& name);
  /// The number of values that follow the option.
  Option& count(int values);
  Option& one_of(const std::vector<std::string>& words);
  Option& between(std::int64_t low, std::int64_t high);
  /// A finite number above 0.
  Option& positive();
  Option& excludes(const Option& other);

 private:
  CLI::Option* option_;  ///< belongs to its command
};

/// A command with its options. Values are written when the command line is parsed.
class Command {
 public:
  Command(CLI::App& app, std::function<void()>& chosen) : app_{app}, chosen_{chosen} {}

  /// `names` as in "-o,--output"; without a dash it is a positional argument. Value: std::string, int,
  /// std::int64_t, double, the last two or int as std::optional, or std::vector<std::string>.
  template <class Value>
  Option add_option(const std::string& names, Value& value, const std::string& help);
  Option add_flag(const std::string& names, bool& value, const std::string& help);

  /// The argument CASE.toml of the commands that read a case, and the option --set, which is the last of
  /// their options; `example` is an assignment that suits the command.
  void add_case_argument(std::string& case_path);
  void add_set_option(std::vector<std::string>& assignments, const std::string& example);
  /// The option --max-cells of the commands that mesh.
  void add_max_cells_option(std::optional<double>& max_cells);

  /// What CommandLine::parse returns where the user chose this command.
  void set_work(std::function<void()> work);

 private:
  CLI::App& app_;
  std::function<void()>& chosen_;
};

/// All commands of a program, and the options that every command has.
class CommandLine {
 public:
  CommandLine(const std::string& description, const std::string& name, const std::string& version);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// A flag of every command.
  void add_flag(const std::string& names, bool& value, const std::string& help);
  Command add_command(const std::string& name, const std::string& help);
  /// The last lines of the help text of each command.
  void set_footer(const std::string& text);

  /// The work of the chosen command, and its name in `command`. Nothing where help or the version was
  /// requested, which the root rank prints. Throws UsageError with one line on what is wrong, first of all an
  /// unknown option or command, with the nearest known one; `command` is set then too, if one was named.
  std::function<void()> parse(int argc, char** argv, const Communicator& comm, std::string& command);

 private:
  std::unique_ptr<CLI::App> app_;
  std::function<void()> chosen_;
};

}  // namespace quadloop
