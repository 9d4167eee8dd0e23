#include "adapt/loop/case_settings.hpp"

#include <fmt/format.h>

#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "generate/digests.hpp"

namespace quadloop::adapt {

namespace {

constexpr const char* template_files_key = "solver.template/";

/// Compares JSON values, whose numbers and lists may be written in several ways.
bool is_same_value(const std::string& a, const std::string& b) {
  if (a == b) return true;
  const auto first = nlohmann::json::parse(a, nullptr, false),
             second = nlohmann::json::parse(b, nullptr, false);
  return !first.is_discarded() && first == second;
}

std::string text_of(const ChangedSetting& change) {
  const auto& [key, before, now] = change;
  if (key.starts_with(template_files_key)) {
    const std::string file = key.substr(std::strlen(template_files_key));
    return fmt::format("the file '{}' of solver.template {}", file,
                       before.empty() ? "is new"
                       : now.empty()  ? "is gone"
                                      : "has changed");
  }
  const auto shown = [](const std::string& value) { return value.empty() ? std::string("not set") : value; };
  return fmt::format("{} was {}, is now {}", key, shown(before), shown(now));
}

}  // namespace

std::string template_key(const std::string& file) { return template_files_key + file; }

std::vector<ChangedSetting> changed_settings(const CaseSettings& before, const CaseSettings& now) {
  std::map<std::string, ChangedSetting> all;
  for (const auto& [key, value] : before) all[key] = {key, value, ""};
  for (const auto& [key, value] : now) all[key].now = value;
  std::vector<ChangedSetting> changed;
  for (const auto& [key, setting] : all) {
    if (!is_same_value(setting.before, setting.now)) changed.push_back({key, setting.before, setting.now});
  }
  return changed;
}

bool may_change_in_a_run(const std::string& key) {
  return key == "solver.command" || key == "solver.template" || key == "solver.iterations" ||
         key == "output.formats" || key == "output.fields" || key.starts_with(template_files_key);
}

bool shapes_cells_at_boundaries(const std::string& key) {
  if (key == "spacing.corner") return true;
  if (!key.starts_with("boundary.")) return false;
  return key.ends_with(".spacing") || key.ends_with(".corner") || key.ends_with(".corner_spacing") ||
         key.ends_with(".layers") || key.find(".layers.") != std::string::npos;
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
  std::string text;
  for (std::size_t i = 0; i < changes.size() && i < most; ++i)
    text += (i == 0 ? "" : ", ") + text_of(changes[i]);
  return changes.size() > most ? text + fmt::format(", and {} more", changes.size() - most) : text;
}

}  // namespace quadloop::adapt
