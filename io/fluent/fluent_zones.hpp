#pragma once

#include <cstdint>
#include <string>

namespace quadloop {

/// Fluent's number for faces inside.
inline constexpr std::int64_t fluent_interior = 2;

/// The zone of those that no boundary names, in our files.
inline constexpr const char* fluent_inner_zone = "interior-faces";

/// Fluent's number for Boundary::condition, and the word that goes with it: a wall where nothing is said.
std::int64_t fluent_number(const std::string& condition);
std::string fluent_word(const std::string& condition);

/// The way back; "none" for a number that has no word of ours.
std::string condition_of_fluent(std::int64_t number);

/// A number as Fluent's sections have it.
std::string fluent_hexadecimal(std::int64_t number);

}  // namespace quadloop
