#pragma once

#include <limits>

namespace quadloop::test {

inline constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace quadloop::test
