#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesher/geometry/boundary_conditions.hpp"

namespace quadloop {

/// Fluent's number for faces inside.
inline constexpr std::int64_t fluent_interior = 2;

/// The zone of those that no boundary names, in our files.
inline constexpr const char* fluent_inner_zone = "interior-faces";

/// Fluent's number for Boundary::condition, and the word that goes with it: a wall where nothing is said.
std::int64_t fluent_number(BoundaryCondition condition);
std::string fluent_word(BoundaryCondition condition);

/// The way back; "none" for a number that has no word of ours.
BoundaryCondition condition_of_fluent(std::int64_t number);

/// A section that names a zone: "(45 (2 fluid domain)())".
std::string fluent_zone_name(std::int64_t zone, const std::string& word, const std::string& name);

/// Throws OutputError where the format, with its numbers of 32 bits, cannot count so many.
void require_countable_in_fluent(const std::string& path, std::int64_t nodes, std::int64_t cells);

/// A number as Fluent's sections have it.
std::string fluent_hexadecimal(std::int64_t number);

}  // namespace quadloop
