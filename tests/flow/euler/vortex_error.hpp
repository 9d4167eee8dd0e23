#pragma once

#include "flow/euler/solve_euler.hpp"

namespace quadloop::test {

/// Root mean square error of the density after a vortex of radius 1 has drifted by one unit of length,
/// slantwise, on a square of ten units of n x n irregular cells. *Collective.*
double vortex_error(std::int32_t n, flow::EulerOptions::Limiter limiter, bool quads);

}  // namespace quadloop::test
