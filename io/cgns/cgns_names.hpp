#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/boundary_conditions.hpp"

namespace quadloop::io {

/// Name of the descriptor with the original name of a boundary or variable that CGNS cannot store.
inline constexpr const char* full_name_descriptor = "FullName";
/// Name of the descriptor with number and thickness of a boundary's layers.
inline constexpr const char* layers_descriptor = "Layers";
/// Name of the descriptor of a zone with its strips, in the format of comments_of().
inline constexpr const char* strips_descriptor = "Strips";

/// Returns the name of a family's boundary condition: a word for a condition without a CGNS type.
std::string cgns_family_condition(BoundaryCondition condition);

/// Returns a valid CGNS name for each name: at most 32 characters, without '/', distinct from each other and
/// from names used in the zone or the base. Deterministic.
std::vector<std::string> cgns_boundary_names(const std::vector<std::string>& names);

/// Returns a valid CGNS name for each zone, distinct from those of the boundaries in the file, which are also
/// nodes of the base. Deterministic.
std::vector<std::string> cgns_zone_names(const std::vector<std::string>& blocks,
                                         const std::vector<std::string>& boundaries_in_file);

/// Return the SIDS names of variables ("x_velocity": "VelocityX"), or the names themselves, truncated to 32
/// characters and made distinct from each other and from other contents of a solution; and the inverse.
std::vector<std::string> cgns_variable_names(const std::vector<std::string>& names);
std::string variable_name_of_cgns(const std::string& name);
/// Returns the names, with those that CGNS cannot store replaced by their names in the file.
std::vector<std::string> cgns_variable_renames(const std::vector<std::string>& names);

/// Return the BCType_t of Boundary::condition, and the inverse ("none" if there is no corresponding word).
int cgns_condition(BoundaryCondition condition);
BoundaryCondition condition_of_cgns(int type);
/// The same for the condition of a family, whose name may be one of our words.
BoundaryCondition condition_of_cgns_family(int type, const std::string& name);

}  // namespace quadloop::io
