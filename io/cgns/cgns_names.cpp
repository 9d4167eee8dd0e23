#include "io/cgns/cgns_names.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "io/cgns/cgns_handle.hpp"
#include "io/text/name_index.hpp"
#include "mesher/geometry/boundary_conditions.hpp"

namespace quadloop {

namespace {

constexpr std::size_t longest_name = 32;

constexpr std::array<std::pair<const char*, const char*>, 10> known_variables{{{"density", "Density"},
                                                                               {"pressure", "Pressure"},
                                                                               {"temperature", "Temperature"},
                                                                               {"mach", "Mach"},
                                                                               {"x_velocity", "VelocityX"},
                                                                               {"y_velocity", "VelocityY"},
                                                                               {"z_velocity", "VelocityZ"},
                                                                               {"x_momentum", "MomentumX"},
                                                                               {"y_momentum", "MomentumY"},
                                                                               {"z_momentum", "MomentumZ"}}};

/// The number of a BCType_t by its name.
int type_named(std::string_view name) {
  const auto* const found = std::find(std::begin(BCTypeName), std::end(BCTypeName), name);
  return found == std::end(BCTypeName) ? BCTypeUserDefined : static_cast<int>(found - std::begin(BCTypeName));
}

/// Cut at a character, not inside one of several bytes (UTF-8).
std::string shortened(const std::string& name, std::size_t length) {
  if (name.size() <= length) return name;
  while (length > 0 && (name[length] & 0xC0U) == 0x80U) --length;
  return name.substr(0, length);
}

std::string standard_name(const std::string& name) {
  const auto* const known = std::find_if(known_variables.begin(), known_variables.end(),
                                         [&](const auto& pair) { return name == pair.first; });
  return known == known_variables.end() ? name : known->second;
}

/// Names of siblings beside the nodes that are `used`.
std::vector<std::string> names_beside(std::initializer_list<const char*> used,
                                      const std::vector<std::string>& names) {
  DistinctNames distinct;
  for (const char* const name : {"", ".", ".."}) distinct.reserve(name);
  for (const char* const name : used) distinct.reserve(name);
  std::vector<std::string> result;
  for (std::string name : names) {
    std::replace(name.begin(), name.end(), '/', '_');
    const auto with_suffix = [&](const std::string& suffix) {
      return shortened(name, longest_name - suffix.size()) + suffix;
    };
    result.push_back(distinct.name(with_suffix(""), with_suffix));
  }
  return result;
}

}  // namespace

std::vector<std::string> cgns_boundary_names(const std::vector<std::string>& names) {
  // Sections stand in the zone and families in the base, beside these nodes.
  return names_beside({"ZoneType", "GridCoordinates", "TRI_3", "QUAD_4", "TETRA_4", "PYRA_5", "PENTA_6",
                       "HEXA_8", "ZoneBC", "ZoneGridConnectivity", "FlowSolution", "CellSolution", "domain",
                       "DataClass", "DimensionalUnits", strips_descriptor, "Part"},
                      names);
}

std::vector<std::string> cgns_variable_names(const std::vector<std::string>& names) {
  std::vector<std::string> wanted;
  for (const std::string& name : names) wanted.push_back(standard_name(name));
  return names_beside({"GridLocation", "Rind", "PointRange", "PointList", "DataClass", "DimensionalUnits"},
                      wanted);
}

std::vector<std::string> cgns_variable_renames(const std::vector<std::string>& names) {
  std::vector<std::string> written = cgns_variable_names(names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (written[i] == standard_name(names[i])) written[i] = names[i];
  }
  return written;
}

std::string variable_name_of_cgns(const std::string& name) {
  for (const auto& [ours, theirs] : known_variables) {
    if (name == theirs) return ours;
  }
  return name;
}

int cgns_condition(const std::string& condition) {
  for (const auto& [word, cgns_type] : boundary_conditions) {
    if (condition == word) return type_named(cgns_type);
  }
  return BCTypeUserDefined;
}

std::string cgns_family_condition(const std::string& condition) {
  const bool has_type = cgns_condition(condition) != BCTypeUserDefined || condition == "none";
  return has_type ? "FamBC" : condition;
}

std::string condition_of_cgns_family(int type, const std::string& name) {
  const bool is_word =
      std::ranges::any_of(boundary_conditions, [&](const BoundaryCondition& c) { return name == c.word; });
  return type == BCTypeUserDefined && is_word ? name : condition_of_cgns(type);
}

/// Types that a word of ours names come before those that it merely comprises.
std::string condition_of_cgns(int type) {
  if (type == BCTypeUserDefined) return "none";
  for (const auto& [word, cgns_type] : boundary_conditions) {
    if (type == type_named(cgns_type)) return word;
  }
  switch (type) {
    case BCWallViscousHeatFlux:
    case BCWallViscousIsothermal: return "viscous_wall";
    case BCInflowSubsonic:
    case BCInflowSupersonic:
    case BCTunnelInflow: return "inflow";
    case BCOutflowSubsonic:
    case BCOutflowSupersonic:
    case BCTunnelOutflow: return "outflow";
    default: return "none";
  }
}

}  // namespace quadloop
