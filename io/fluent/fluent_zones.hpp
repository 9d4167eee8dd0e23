#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesher/geometry/boundary_conditions.hpp"

namespace quadloop::io {

/// Fluent's number for inner faces.
inline constexpr std::int64_t fluent_interior = 2;

/// Zone name of inner faces without a boundary, in our files.
inline constexpr const char* fluent_inner_zone = "interior-faces";

/// Return Fluent's number for the condition of a boundary of one cell per face, and the corresponding word: a
/// wall if there is no condition.
std::int64_t fluent_number(BoundaryCondition condition);
std::string fluent_word(BoundaryCondition condition);

/// Inverse; "none" for a number without a corresponding word.
BoundaryCondition condition_of_fluent(std::int64_t number);

/// Returns a section that names a zone: "(45 (2 fluid domain)())".
std::string fluent_zone_name(std::int64_t zone, const std::string& word, const std::string& name);

/// Throws OutputError if the numbers exceed the 32 bits of the format.
void require_countable_in_fluent(const std::string& path, std::int64_t nodes, std::int64_t cells);

/// Returns a number in the format of Fluent's sections.
std::string fluent_hexadecimal(std::int64_t number);

}  // namespace quadloop::io
