#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace quadloop::io {

/// Exponents of mass, length, time, temperature and angle.
using CgnsExponents = std::array<float, 5>;

/// Returns the dimensions of a quantity by its standard name (SIDS, annex A): {1, -3} for "Density", all 0
/// for "Mach". Empty for names that are not in the standard, or are not flow quantities.
std::optional<CgnsExponents> cgns_exponents(std::string_view name);

}  // namespace quadloop::io
