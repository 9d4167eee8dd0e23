#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace quadloop {

/// The index of a variable among the names of a solution: the name as it is written, else the same name in
/// other letters (case, blanks and punctuation do not count), else another usual name for it (density: rho;
/// x_velocity: VelocityX, velocity_x, u; pressure: p; mach: Mach_Number;
/// ...). Throws an InputError that begins with `where` and lists the names where none is it, or several are.
std::size_t variable(std::span<const std::string> names, const std::string& wanted, const std::string& where);

/// The indices of all names that may be this variable, by the first of these ways that finds any; more than
/// one where it cannot be told.
std::vector<std::size_t> variables_like(std::span<const std::string> names, const std::string& wanted);

/// A name as one word, which the native format can hold: each blank and control character becomes "_".
std::string word_of(const std::string& name);

/// The names as words, v1, v2, ... in the place of empty ones. Throws an InputError that begins with `where`
/// and names both where two are then the same.
std::vector<std::string> distinct_words(std::span<const std::string> names, const std::string& where);

/// Throws an InputError that begins with `where` where two names are the same to the letter.
void require_distinct(std::span<const std::string> names, const std::string& where);

}  // namespace quadloop
