#include "app/command.hpp"

#include <algorithm>

#include "mesher/base/log.hpp"

namespace quadloop {

std::string record_text(const CommandRecord& record, const Outcome& outcome) {
  JsonObject json;
  json.add_raw("command", record.command.empty() ? "null" : json_of(record.command));
  json.add("status", static_cast<int>(outcome.status));
  json.add_raw("error", outcome.status == ExitStatus::done ? "null" : json_of(outcome.message));
  json.append(record.figures);
  json.add("warnings", record.warnings);
  json.add("files", record.files);
  return json.text() + "\n";
}

void CommandContext::warn(const std::vector<std::string>& warnings) const {
  constexpr std::size_t most_shown = 10;
  if (!comm.is_root()) return;
  record.warnings.insert(record.warnings.end(), warnings.begin(), warnings.end());
  if (quiet && json) return;
  const std::size_t shown = verbose ? warnings.size() : std::min(most_shown, warnings.size());
  for (std::size_t i = 0; i < shown; ++i) log::warning(warnings[i]);
  if (shown < warnings.size())
    log::warning(std::to_string(warnings.size() - shown) + " more warnings; --verbose shows them");
}

}  // namespace quadloop
