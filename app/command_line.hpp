#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"

namespace CLI {
class App;
class ParseError;
class Validator;
}  // namespace CLI

namespace quadloop {

/// The commands that an app knows.
std::vector<CLI::App*> commands_of(CLI::App& app);

/// The command line, last word first as CLI11 takes it, with --set before each of the assignments that follow
/// one: an option of many values would take the case file for one of them. A word that names a file is the
/// case file, whatever it looks like.
std::vector<std::string> words_of(int argc, char** argv);

/// Lets CLI11 say what it has to say (help, version) on the root rank; what is wrong becomes our own one
/// line, a UsageError: an option or a command that is not known comes first, with the one that is nearest.
void answer(CLI::App& app, const CLI::ParseError& request, const Communicator& comm);

/// An option's value must be one of these words.
CLI::Validator one_of(const std::vector<std::string>& words);

/// It must be a finite number above 0.
CLI::Validator positive_number();

/// The argument CASE.toml of the commands that read a case, and the option --set, which comes last of theirs;
/// `example` is an assignment that suits the command.
void add_case_argument(CLI::App& command, std::string& case_path);
void add_set_option(CLI::App& command, std::vector<std::string>& assignments, const std::string& example);

/// The option --max-cells of the commands that mesh.
void add_max_cells_option(CLI::App& command, std::optional<double>& max_cells);

}  // namespace quadloop
