#include "app/command.hpp"

#include <set>
#include <utility>

#include "mesher/base/log.hpp"

namespace quadloop::app {

std::string record_text(const CommandRecord& record, const Outcome& outcome) {
  JsonObject json;
  json.add_raw("command", record.command.empty() ? "null" : json_of(record.command));
  json.add("status", static_cast<int>(outcome.status));
  json.add_raw("error", outcome.status == ExitStatus::done ? "null" : json_of(outcome.message));
  json.append(record.statistics);
  json.add("warnings", record.warnings);
  json.add("files", record.files);
  return json.text() + "\n";
}

namespace {

/// Adds warnings to the record, each once. Returns those of them that are new and to be shown.
std::vector<std::string> recorded(const CommandContext& context, std::vector<std::string> warnings) {
  constexpr std::size_t most_shown = 10;
  std::vector<std::string>& all = context.record.warnings;
  std::set<std::string> known(all.begin(), all.end());
  std::erase_if(warnings, [&](const std::string& warning) { return !known.insert(warning).second; });
  all.insert(all.end(), warnings.begin(), warnings.end());
  if (context.quiet && context.json) return {};
  if (context.verbose || warnings.size() <= most_shown) return warnings;
  const std::size_t more = warnings.size() - most_shown;
  warnings.resize(most_shown);
  warnings.push_back(std::to_string(more) + " more warnings; --verbose shows them");
  return warnings;
}

}  // namespace

void CommandContext::warn(const std::vector<std::string>& warnings) const {
  if (!comm.is_root()) return;
  for (const std::string& line : recorded(*this, std::exchange(record.noted, {}))) log::warning(line);
  for (const std::string& line : recorded(*this, warnings)) log::warning(line);
}

std::vector<std::string> CommandContext::warnings_before_error() const {
  return recorded(*this, std::exchange(record.noted, {}));
}

}  // namespace quadloop::app
