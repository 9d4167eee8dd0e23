#include "adapt/loop/convergence.hpp"

#include <cmath>

#include "mesher/base/error.hpp"

namespace quadloop::adapt {

CycleValues values_of(const CycleRecord& record) {
  return {record.nodes, record.cl, record.cd, record.estimate, record.converged};
}

CycleValues recorded_values(const std::string& json) {
  const double nodes = recorded_number(json, "nodes").value_or(0);
  return {static_cast<std::int64_t>(nodes), recorded_number(json, "cl"), recorded_number(json, "cd"),
          recorded_number(json, "estimate"), recorded_flag(json, "converged")};
}

std::optional<double> observed_order(const CycleValues& before, const CycleValues& now) {
  constexpr double too_close = 0.1;
  if (!before.estimate || !now.estimate || !(*before.estimate > 0) || !(*now.estimate > 0)) return {};
  const double growth = static_cast<double>(now.nodes) / static_cast<double>(before.nodes);
  if (std::abs(growth - 1) < too_close) return {};
  return std::log(*before.estimate / *now.estimate) / (0.5 * std::log(growth));
}

bool have_settled(const AdaptOptions::Until& until, const CycleValues& before, const CycleValues& now) {
  const auto within = [](const std::optional<double>& most, const std::optional<double>& a,
                         const std::optional<double>& b, bool relative) {
    if (!most) return true;
    return a && b && std::abs(*b - *a) < *most * (relative ? std::abs(*a) : 1);
  };
  if (before.converged == false || now.converged == false) return false;
  return !until.empty() && within(until.cl, before.cl, now.cl, false) &&
         within(until.cd, before.cd, now.cd, false) &&
         within(until.estimate, before.estimate, now.estimate, true);
}

void require_reported(const AdaptOptions::Until& until, const CycleValues& now) {
  const bool cl_misses = until.cl && !now.cl, cd_misses = until.cd && !now.cd;
  if (!cl_misses && !cd_misses) return;
  throw InputError(std::string("adapt.until requires ") + (cl_misses ? "cl" : "cd") +
                   ", which the solver does not provide: forces need a boundary with bc = \"wall\" and, with "
                   "an external solver, a pressure in [flow]");
}

}  // namespace quadloop::adapt
