#include "app/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>

#include "io/input/case_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/nearest_word.hpp"

namespace quadloop::app {

namespace {

std::vector<CLI::App*> commands_of(CLI::App& app) {
  return app.get_subcommands([](CLI::App*) { return true; });
}

/// Returns the error for a command line without a command.
std::string without_command(CLI::App& app) {
  std::vector<std::string> commands;
  for (const CLI::App* command : commands_of(app)) commands.push_back(command->get_name());
  const std::vector<std::string> words = app.remaining();
  const bool names_one = !words.empty() && !words.front().starts_with('-');
  const std::string fault = names_one ? "'" + words.front() + "' is no command" : "a command is missing";
  return fmt::format("{}; the commands are: {}{}", fault, fmt::join(commands, ", "),
                     names_one ? guess_for(words.front(), commands) : "");
}

void append_options(const CLI::App& app, std::vector<std::string>& names) {
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
}

/// Returns the error for the first word that looks like an option and is none; empty if all are known.
std::string unknown_option(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining(true);
  const auto unknown = std::find_if(words.begin(), words.end(), [](const std::string& word) {
    return word.size() > 1 && word.starts_with('-');
  });
  if (unknown == words.end() || *unknown == "--") return {};
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands()) append_options(*command, names);
  append_options(app, names);
  const std::string name = unknown->substr(0, unknown->find('='));
  return name + ": there is no such option" + guess_for(name, names);
}

bool is_file(const std::string& word) {
  std::error_code ignored;  // a word too long for a path is not a file
  return std::filesystem::exists(word, ignored);
}

/// Returns the words of the command line, last word first as CLI11 expects it, with --set inserted before
/// each further assignment: an option with several values would take the case file as one of them. A word
/// that names a file is the case file, whatever it looks like.
std::vector<std::string> words_of(int argc, char** argv) {
  std::vector<std::string> words;
  bool in_assignments = false;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool is_value = i > 1 && words.back() == "--set";
    const bool is_one_more = in_assignments && !is_value && io::is_assignment(word) && !is_file(word);
    if (is_one_more) words.emplace_back("--set");
    in_assignments = is_value || is_one_more || word.starts_with("--set=");
    words.push_back(word);
  }
  std::reverse(words.begin(), words.end());
  return words;
}

/// Lets CLI11 print help or version on the root rank; anything else is a UsageError.
void answer(CLI::App& app, const CLI::ParseError& request, const Communicator& comm) {
  if (request.get_exit_code() == 0) {
    if (comm.is_root()) app.exit(request, std::cout, std::cerr);
    return;
  }
  std::string command = "quadloop";
  for (const CLI::App* subcommand : app.get_subcommands()) command += " " + subcommand->get_name();
  std::string fault = unknown_option(app);
  if (fault.empty()) fault = app.get_subcommands().empty() ? without_command(app) : request.what();
  throw UsageError(fmt::format("{} '{} --help'", fault + (fault.ends_with('?') ? " See" : "; see"), command));
}

}  // namespace

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::value_name(const std::string& name) {
  option_->type_name(name);
  return *this;
}

Option& Option::count(int values) {
  option_->expected(values);
  return *this;
}

Option& Option::one_of(const std::vector<std::string>& words) {
  const std::string all = fmt::format("{{{}}}", fmt::join(words, ","));
  option_->check(CLI::Validator(
      [words, all](std::string& word) {
        if (std::find(words.begin(), words.end(), word) != words.end()) return std::string();
        return fmt::format("'{}' is not in {}{}", word, all, guess_for(word, words));
      },
      all));
  return *this;
}

Option& Option::between(std::int64_t low, std::int64_t high) {
  option_->check(CLI::Range(low, high));
  return *this;
}

Option& Option::positive() {
  option_->check(CLI::Validator(
      [](std::string& word) {
        double number = 0;
        const bool is_positive =
            CLI::detail::lexical_cast(word, number) && number > 0 && std::isfinite(number);
        return is_positive ? std::string() : fmt::format("'{}' is not a number above 0", word);
      },
      ""));
  return *this;
}

Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}

template <class Value>
Option Command::add_option(const std::string& names, Value& value, const std::string& help) {
  return Option(app_.add_option(names, value, help));
}
template Option Command::add_option(const std::string&, std::string&, const std::string&);
template Option Command::add_option(const std::string&, int&, const std::string&);
template Option Command::add_option(const std::string&, std::int64_t&, const std::string&);
template Option Command::add_option(const std::string&, double&, const std::string&);
template Option Command::add_option(const std::string&, std::optional<int>&, const std::string&);
template Option Command::add_option(const std::string&, std::optional<double>&, const std::string&);
template Option Command::add_option(const std::string&, std::vector<std::string>&, const std::string&);

Option Command::add_flag(const std::string& names, bool& value, const std::string& help) {
  return Option(app_.add_flag(names, value, help));
}

void Command::add_case_argument(std::string& case_path) {
  add_option("case", case_path, "the case file (TOML)").required().value_name("CASE.toml");
}

void Command::add_set_option(std::vector<std::string>& assignments, const std::string& example) {
  app_.add_option("--set", assignments,
                  "set a key of the case file, such as " + example + "; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void Command::add_max_cells_option(std::optional<double>& max_cells) {
  add_option("--max-cells", max_cells, "largest estimated number of cells (default: limited by free memory)")
      .value_name("N")
      .positive();
}

void Command::set_work(std::function<void()> work) {
  app_.callback([&chosen = chosen_, work = std::move(work)] { chosen = work; });
}

CommandLine::CommandLine(const std::string& description, const std::string& name, const std::string& version)
    : app_{std::make_unique<CLI::App>(description, name)} {
  app_->fallthrough();
  app_->require_subcommand(1);
  app_->set_version_flag("--version", version);
}

CommandLine::~CommandLine() = default;

void CommandLine::add_flag(const std::string& names, bool& value, const std::string& help) {
  app_->add_flag(names, value, help);
}

Command CommandLine::add_command(const std::string& name, const std::string& help) {
  return {*app_->add_subcommand(name, help), chosen_};
}

void CommandLine::set_footer(const std::string& text) {
  for (CLI::App* command : commands_of(*app_)) command->footer(text);
}

std::function<void()> CommandLine::parse(int argc, char** argv, const Communicator& comm,
                                         std::string& command) {
  const auto named = [&] {
    const auto commands = app_->get_subcommands();
    return commands.empty() ? std::string() : commands.back()->get_name();
  };
  try {
    app_->parse(words_of(argc, argv));
  } catch (const CLI::ParseError& request) {
    command = named();
    answer(*app_, request, comm);
    command.clear();
    return {};
  }
  command = named();
  return chosen_;
}

}  // namespace quadloop::app
