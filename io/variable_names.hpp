#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace quadloop {

/// The place of a variable among the names of a solution: the name as it is written, else the same name in other letters (case, blanks and
/// punctuation do not count), else another usual name for it (density: rho; x_velocity: VelocityX, velocity_x, u; pressure: p; mach: Mach_Number;
/// ...). Throws an InputError that begins with `where` and lists the names where none is it, or several are.
std::size_t variable(std::span<const std::string> names, const std::string& wanted, const std::string& where);

}  // namespace quadloop
