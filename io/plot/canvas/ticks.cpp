#include "io/plot/canvas/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace quadloop::io {

Ticks round_ticks(double low, double high, double most) {
  constexpr int limit = 40;
  Ticks ticks;
  const double raw = (high - low) / std::clamp(most, 2.0, limit - 1.0);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double step = power * (raw > 5 * power ? 10 : raw > 2 * power ? 5 : raw > power ? 2 : 1);
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  const bool plain = decimals <= 7 && std::max(std::abs(low), std::abs(high)) < 1e7;
  const double first = std::ceil(low / step - 1e-9);
  for (int i = 0; i < limit && (first + i) * step <= high + 1e-9 * step; ++i) {
    const double value = (first + i) * step;
    ticks.values.push_back(value);
    ticks.labels.push_back(plain ? fmt::format("{:.{}f}", value == 0 ? 0.0 : value, decimals)
                                 : fmt::format("{:.6g}", value));
  }
  return ticks;
}

Ticks decade_ticks(double low, double high, double most) {
  Ticks ticks;
  const int first = static_cast<int>(std::ceil(std::log10(low) - 1e-9)),
            last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
  const int step = std::max(1, static_cast<int>(std::ceil((last - first + 1) / std::max(most, 1.0))));
  for (int power = first; power <= last; power += step) {
    ticks.values.push_back(std::pow(10.0, power));
    ticks.labels.push_back(fmt::format("1e{}", power));
  }
  return ticks;
}

}  // namespace quadloop::io
