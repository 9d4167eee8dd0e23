#pragma once

#include "flow/postprocess/free_stream.hpp"

namespace quadloop::test {

/// Along the x axis, at Mach 2.67, of a gas that is not air.
inline flow::FreeStream dense_stream(double viscosity) { return {2, 3, 4, 0, 1.5, viscosity, 0.5}; }

}  // namespace quadloop::test
