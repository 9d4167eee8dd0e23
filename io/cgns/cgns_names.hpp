#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/boundary_conditions.hpp"

namespace quadloop {

/// Name of the descriptor that keeps the own name of a boundary or a variable where CGNS could not hold it.
inline constexpr const char* full_name_descriptor = "FullName";
/// And of that with the number and thickness of a boundary's layers.
inline constexpr const char* layers_descriptor = "Layers";
/// And of that of a zone which tells of strips, as comments_of() does.
inline constexpr const char* strips_descriptor = "Strips";

/// The name of a family's boundary condition: one that CGNS has no type for stands there as a word.
std::string cgns_family_condition(BoundaryCondition condition);

/// For each name one that CGNS can hold: at most 32 characters, no '/', none twice and none that the zone or
/// the base already uses. The same names always give the same answer.
std::vector<std::string> cgns_boundary_names(const std::vector<std::string>& names);

/// The SIDS names of variables of ours ("x_velocity": "VelocityX"), or the names themselves, cut to 32
/// characters, told apart as boundaries are and from what else a solution holds; and back.
std::vector<std::string> cgns_variable_names(const std::vector<std::string>& names);
std::string variable_name_of_cgns(const std::string& name);
/// The same names, but for those that CGNS could not hold, which are as a file has them.
std::vector<std::string> cgns_variable_renames(const std::vector<std::string>& names);

/// The number of the BCType_t for Boundary::condition, and back ("none" for what has no word of ours).
int cgns_condition(BoundaryCondition condition);
BoundaryCondition condition_of_cgns(int type);
/// The same for the condition of a family, which may have one of our words as its name.
BoundaryCondition condition_of_cgns_family(int type, const std::string& name);

}  // namespace quadloop
