#include "adapt/loop/case_settings.hpp"

#include <fmt/format.h>

#include <map>

#include "mesher/generate/digests.hpp"

namespace quadloop {

std::vector<ChangedSetting> changed_settings(const CaseSettings& before, const CaseSettings& now) {
  std::map<std::string, ChangedSetting> all;
  for (const auto& [key, value] : before) all[key] = {key, value, ""};
  for (const auto& [key, value] : now) all[key].now = value;
  std::vector<ChangedSetting> changed;
  for (const auto& [key, setting] : all) {
    if (setting.before != setting.now) changed.push_back({key, setting.before, setting.now});
  }
  return changed;
}

bool may_change_in_a_run(const std::string& key) {
  return key == "solver.command" || key == "solver.template" || key == "solver.iterations" ||
         key == "output.formats" || key == "output.fields";
}

std::uint64_t run_digest(const CaseSettings& settings, std::uint64_t geometry_digest) {
  std::string text = fmt::format("geometry {:x}", geometry_digest);
  for (const auto& [key, value] : settings) {
    if (!may_change_in_a_run(key)) text += "\n" + key + " = " + value;
  }
  return text_digest(text);
}

std::string text_of(const std::vector<ChangedSetting>& changes) {
  constexpr std::size_t most = 4;
  const auto shown = [](const std::string& value) { return value.empty() ? std::string("not set") : value; };
  std::string text;
  for (std::size_t i = 0; i < changes.size() && i < most; ++i) {
    const auto& [key, before, now] = changes[i];
    text += fmt::format("{}{} was {}, is now {}", i == 0 ? "" : ", ", key, shown(before), shown(now));
  }
  return changes.size() > most ? text + fmt::format(", and {} more", changes.size() - most) : text;
}

}  // namespace quadloop
