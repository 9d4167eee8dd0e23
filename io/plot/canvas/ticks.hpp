#pragma once

#include <string>
#include <vector>

namespace quadloop {

/// Numbers along an axis, as they are written there.
struct Ticks {
  std::vector<double> values;
  std::vector<std::string> labels;
};

/// Round numbers between low and high, about `most` of them.
Ticks round_ticks(double low, double high, double most);

/// Powers of ten between low and high, both above 0; at most `most` of them.
Ticks decade_ticks(double low, double high, double most);

}  // namespace quadloop
