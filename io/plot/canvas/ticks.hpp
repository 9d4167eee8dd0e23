#pragma once

#include <string>
#include <vector>

namespace quadloop::io {

/// Numbers along an axis, with their labels.
struct Ticks {
  std::vector<double> values;
  std::vector<std::string> labels;
};

/// Returns about `most` round numbers between low and high, at most 40.
Ticks round_ticks(double low, double high, double most);

/// Returns at most `most` powers of ten between low and high, which must be positive.
Ticks decade_ticks(double low, double high, double most);

}  // namespace quadloop::io
