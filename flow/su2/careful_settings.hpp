#pragma once

#include "flow/su2/su2_config.hpp"

namespace quadloop::flow {

/// Replaces the CFL numbers of a configuration by those of a slower run, for a flow that diverged: CFL_NUMBER
/// is divided by ten, as are the limits in CFL_ADAPT_PARAM, whose growth factor loses half of its excess over
/// 1. Without CFL_NUMBER the start is SU2's default. Values that are not numbers are not changed.
void set_careful_cfl(Su2Config& config);

}  // namespace quadloop::flow
