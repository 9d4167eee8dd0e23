#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// For each of `points` the index of one of the `known` points with the same coordinates, the first of
/// several; -1 where there is none. O(n + m).
std::vector<std::int32_t> find_equal_points(std::span<const Point> known, std::span<const Point> points);

}  // namespace quadloop
