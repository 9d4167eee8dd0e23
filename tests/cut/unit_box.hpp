#pragma once

#include "mesher/geometry/point.hpp"

namespace quadloop::test {

inline constexpr Box unit_box{{0, 0}, {1, 1}};

}  // namespace quadloop::test
