#include "flow/su2/careful_settings.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

namespace quadloop::flow {

namespace {

constexpr double default_cfl = 1.25, slower = 0.1;

/// The words of CFL_ADAPT_PARAM (factor down, factor up, smallest and largest CFL number, more) for a slower
/// run.
std::vector<std::string> slower_ramp(std::vector<std::string> words) {
  constexpr std::size_t up = 1, least = 2, most = 3;
  const auto change = [&](std::size_t k, const auto& changed) {
    if (k >= words.size()) return;
    if (const auto value = su2_number(words[k])) words[k] = fmt::format("{:g}", changed(*value));
  };
  change(up, [](double factor) { return 1 + 0.5 * (factor - 1); });
  change(least, [](double cfl) { return slower * cfl; });
  change(most, [](double cfl) { return slower * cfl; });
  return words;
}

}  // namespace

void set_careful_cfl(Su2Config& config) {
  const auto given = config.value("CFL_NUMBER");
  const auto cfl = given ? su2_number(*given) : std::optional(default_cfl);
  if (cfl) config.set("CFL_NUMBER", fmt::format("{:g}", slower * *cfl));
  const std::vector<std::string> ramp = slower_ramp(config.words("CFL_ADAPT_PARAM"));
  if (!ramp.empty()) config.set("CFL_ADAPT_PARAM", fmt::format("( {} )", fmt::join(ramp, ", ")));
}

}  // namespace quadloop::flow
