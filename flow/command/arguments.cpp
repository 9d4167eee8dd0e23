// Replaces the placeholders of a solver's command.
#include <regex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "flow/command/solver_command.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::flow {

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
  static const std::regex placeholder(R"(\{\{(\w+)\}\}|\{(\w+)\})");  // {{name}} becomes {name}
  std::string result;
  auto rest = argument.begin();
  for (std::sregex_iterator found(argument.begin(), argument.end(), placeholder), none; found != none;
       ++found) {
    result.append(rest, (*found)[0].first);
    result += (*found)[1].matched ? "{" + found->str(1) + "}" : value_of(values, found->str(2), argument);
    rest = (*found)[0].second;
  }
  return result.append(rest, argument.end());
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

}  // namespace quadloop::flow
