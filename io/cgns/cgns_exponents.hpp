#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace quadloop {

/// Of mass, length, time, temperature and angle.
using CgnsExponents = std::array<float, 5>;

/// The dimensions of a quantity by its name in the standard (SIDS, annex A): {1, -3} for "Density", all 0 for
/// "Mach". Nothing for names that are none of the standard's, or of no flow's.
std::optional<CgnsExponents> cgns_exponents(std::string_view name);

}  // namespace quadloop
