#include <iostream>
#include <memory>

#include "app/command.hpp"
#include "quadloop/case/case_keys.hpp"

namespace quadloop::app {

namespace {

struct HelpArguments {
  std::string topic;
  bool reference = false;
};

}  // namespace

void add_help_command(CommandLine& line, CommandContext& context) {
  Command command = line.add_command("help", "Describe a key of the case file, or a table of keys");
  auto arguments = std::make_shared<HelpArguments>();
  command
      .add_option(
          "topic", arguments->topic,
          "a key (spacing.max), a table (spacing), or nothing for all tables; `quadloop COMMAND --help` "
          "describes a command")
      .value_name("KEY");
  command.add_flag("--reference", arguments->reference, "print all tables of keys as Markdown");
  command.set_work([arguments, &context] {
    const std::string text = arguments->reference ? key_reference() : key_help(arguments->topic);
    context.record.statistics.add("help", text);
    if (context.shows_table()) std::cout << text;
  });
}

}  // namespace quadloop::app
