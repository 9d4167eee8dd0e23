#pragma once

namespace quadloop::test {

/// What rounding may make of a cost or a length about 1, and of an angle in degrees.
inline constexpr double rounding = 1e-12;
inline constexpr double degrees_rounding = 1e-9;

}  // namespace quadloop::test
