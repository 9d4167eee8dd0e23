#pragma once

#include <array>

#include "flow/euler/model/gas.hpp"

namespace quadloop::euler {

/// The state after a change of what is conserved, which is made smaller where it would take more than a
/// quarter of the node's density or pressure, or add that much.
State updated(const Gas& gas, const State& state, const std::array<double, 4>& change);

}  // namespace quadloop::euler
