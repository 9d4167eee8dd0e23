#include "io/model/repeated_rows.hpp"

#include <fmt/format.h>

#include "mesher/base/counted.hpp"

namespace quadloop::io {

void warn_of_repeated(const RepeatedElements& repeated, const std::string& path,
                      std::vector<std::string>& warnings) {
  constexpr std::size_t most_lines = 5;
  std::int64_t same = 0;
  std::size_t lines = 0;
  for (const auto& [names, count] : repeated) {
    const auto& [kept, other] = names;
    if (kept == other) {
      same += count;
    } else if (++lines <= most_lines) {
      warnings.push_back(fmt::format("{}: {} in the groups '{}' and '{}', assigned to '{}'", path,
                                     counted(count, "element"), kept, other, kept));
    }
  }
  if (lines > most_lines)
    warnings.push_back(
        fmt::format("{}: {} of groups with common elements", path, counted(lines - most_lines, "more pair")));
  if (same > 0)
    warnings.push_back(fmt::format("{}: {} that occurred before; the first of each was used", path,
                                   counted(same, "element")));
}

std::string some_names(const std::vector<std::string>& names) {
  constexpr std::size_t most = 5;
  const std::size_t shown = names.size() <= most ? names.size() : most - 1;
  std::string text;
  for (std::size_t i = 0; i < shown; ++i)
    text += fmt::format("{}'{}'", i == 0 ? "" : i + 1 == names.size() ? " and " : ", ", names[i]);
  if (shown < names.size()) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

}  // namespace quadloop::io
