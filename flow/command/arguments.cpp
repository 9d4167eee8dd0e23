// How the placeholders of a solver's command are filled in.
#include <cctype>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "flow/command/solver_command.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

using Values = std::vector<std::pair<std::string_view, std::string>>;

Values values_of(const SolverFiles& files) {
  return {{"mesh", files.mesh},
          {"state", files.state},
          {"solution", files.solution},
          {"case", files.case_folder},
          {"ranks", std::to_string(files.ranks)},
          {"cycle", std::to_string(files.cycle)}};
}

bool of_a_name(unsigned char c) { return std::isalnum(c) != 0 || c == '_'; }

/// The name that `text` begins with where it begins with {name}; empty where it does not.
std::string_view braced_name(std::string_view text) {
  if (text.empty() || text.front() != '{') return {};
  std::size_t end = 1;
  while (end < text.size() && of_a_name(text[end])) ++end;
  return end < text.size() && text[end] == '}' ? text.substr(1, end - 1) : std::string_view{};
}

/// The name that `text` begins with where it begins with {{name}}.
std::string_view escaped_name(std::string_view text) {
  if (!text.starts_with("{{")) return {};
  const std::string_view name = braced_name(text.substr(1));
  return !name.empty() && text.substr(name.size() + 3).starts_with("}") ? name : std::string_view{};
}

const std::string& value_of(const Values& values, std::string_view name, const std::string& argument) {
  std::string known;
  for (const auto& [placeholder, value] : values) {
    if (placeholder == name) return value;
    known += (known.empty() ? "{" : ", {") + std::string(placeholder) + "}";
  }
  const std::string braced = "{" + std::string(name) + "}";
  throw InputError("[solver] command: " + braced + " in the argument '" + argument +
                   "' is unknown; there are " + known + ", and {" + braced + "} stands for " + braced +
                   " itself");
}

std::string filled_argument(const std::string& argument, const Values& values) {
  if (argument.find('\0') != std::string::npos)
    throw InputError("[solver] command: an argument holds a zero byte; no program can be given one");
  std::string result;
  for (std::string_view rest = argument; !rest.empty();) {
    if (const std::string_view escaped = escaped_name(rest); !escaped.empty()) {
      result.append("{").append(escaped).append("}");
      rest.remove_prefix(escaped.size() + 4);
    } else if (const std::string_view name = braced_name(rest); !name.empty()) {
      result += value_of(values, name, argument);
      rest.remove_prefix(name.size() + 2);
    } else {
      result += rest.front();
      rest.remove_prefix(1);
    }
  }
  return result;
}

}  // namespace

std::vector<std::string> filled(const SolverCommand& command, const SolverFiles& files) {
  if (command.arguments.empty())
    throw InputError("[solver] command is empty; name the program to run and its arguments");
  const Values values = values_of(files);
  std::vector<std::string> arguments;
  for (const std::string& argument : command.arguments)
    arguments.push_back(filled_argument(argument, values));
  return arguments;
}

}  // namespace quadloop
