#pragma once

#include <span>
#include <vector>

#include "tests/support/world.hpp"

namespace quadloop::test {

/// The values of all ranks, one rank's after another's. *Collective.*
inline std::vector<double> gathered(const std::vector<double>& values) {
  return world().all_gather_values(std::span<const double>(values));
}

}  // namespace quadloop::test
