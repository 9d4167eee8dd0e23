#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace quadloop {

/// Returns the index of a variable among the names of a solution: the exact name, else the same name ignoring
/// case, blanks and punctuation, else a synonym (density: rho; x_velocity: VelocityX, velocity_x, u;
/// pressure: p; mach: Mach_Number; ...). Throws an InputError that begins with `where` and lists the names if
/// there is no match, or several.
std::size_t variable(std::span<const std::string> names, const std::string& wanted, const std::string& where);

/// Returns the indices of all matching names, by the first of these rules that gives a match; more than one
/// if it is ambiguous.
std::vector<std::size_t> variables_like(std::span<const std::string> names, const std::string& wanted);

/// Returns the index of the only variable that variables_like() finds; empty for none or several.
std::optional<std::size_t> only_variable_like(std::span<const std::string> names, const std::string& wanted);

/// Returns the indices of both components of a vector, `wanted`_x and `wanted`_y, if each is
/// only_variable_like() its name.
std::optional<std::array<std::size_t, 2>> components_like(std::span<const std::string> names,
                                                          const std::string& wanted);

/// Returns a name as one word, which the native format can store: each blank and control character becomes
/// "_".
std::string word_of(const std::string& name);

/// Returns the names as words; empty ones become v1, v2, ... Throws an InputError that begins with `where`
/// and names both if two are then the same.
std::vector<std::string> distinct_words(std::span<const std::string> names, const std::string& where);

/// Throws an InputError that begins with `where` if two names are identical.
void require_distinct(std::span<const std::string> names, const std::string& where);

}  // namespace quadloop
