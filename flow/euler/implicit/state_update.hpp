#pragma once

#include <array>

#include "flow/euler/model/gas.hpp"

namespace quadloop::flow::euler {

/// Returns the state after a change of the conserved variables. The change is scaled down if it would change
/// the node's density or pressure by more than a quarter.
State updated(const Gas& gas, const State& state, const std::array<double, 4>& change);

}  // namespace quadloop::flow::euler
