#include "io/cgns/cgns_names.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "io/cgns/cgns_handle.hpp"
#include "io/text/name_index.hpp"
#include "mesher/geometry/boundary_conditions.hpp"

namespace quadloop::io {

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

/// For each condition the first type is written.
constexpr std::array<std::pair<BoundaryCondition, BCType_t>, 15> condition_types{
    {{BoundaryCondition::wall, BCWall},
     {BoundaryCondition::viscous_wall, BCWallViscous},
     {BoundaryCondition::viscous_wall, BCWallViscousHeatFlux},
     {BoundaryCondition::viscous_wall, BCWallViscousIsothermal},
     {BoundaryCondition::inviscid_wall, BCWallInviscid},
     {BoundaryCondition::farfield, BCFarfield},
     {BoundaryCondition::inflow, BCInflow},
     {BoundaryCondition::inflow, BCInflowSubsonic},
     {BoundaryCondition::inflow, BCInflowSupersonic},
     {BoundaryCondition::inflow, BCTunnelInflow},
     {BoundaryCondition::outflow, BCOutflow},
     {BoundaryCondition::outflow, BCOutflowSubsonic},
     {BoundaryCondition::outflow, BCOutflowSupersonic},
     {BoundaryCondition::outflow, BCTunnelOutflow},
     {BoundaryCondition::symmetry, BCSymmetryPlane}}};

/// Truncates a name, not inside a multi-byte UTF-8 character.
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

/// Returns names distinct from each other and from the `used` sibling nodes.
std::vector<std::string> names_beside(const std::vector<std::string>& used,
                                      const std::vector<std::string>& names) {
  DistinctNames distinct;
  for (const char* const name : {"", ".", ".."}) distinct.reserve(name);
  for (const std::string& name : used) distinct.reserve(name);
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
  // Sections are siblings of these nodes in the zone, families in the base.
  return names_beside(
      {"ZoneType", "GridCoordinates", "TRI_3", "QUAD_4", "TETRA_4", "PYRA_5", "PENTA_6", "HEXA_8", "ZoneBC",
       "ZoneGridConnectivity", "FlowSolution", "CellSolution", "domain", "DataClass", "DimensionalUnits",
       strips_descriptor, full_name_descriptor, "Ordinal", "Part"},
      names);
}

std::vector<std::string> cgns_zone_names(const std::vector<std::string>& blocks,
                                         const std::vector<std::string>& boundaries_in_file) {
  std::vector<std::string> used = boundaries_in_file;
  used.insert(used.end(), {"DataClass", "DimensionalUnits"});
  return names_beside(used, blocks);
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

int cgns_condition(BoundaryCondition condition) {
  for (const auto& [known, type] : condition_types) {
    if (condition == known) return type;
  }
  return BCTypeUserDefined;
}

std::string cgns_family_condition(BoundaryCondition condition) {
  const bool has_type =
      cgns_condition(condition) != BCTypeUserDefined || condition == BoundaryCondition::none;
  return has_type ? "FamBC" : condition.word();
}

BoundaryCondition condition_of_cgns_family(int type, const std::string& name) {
  const auto named = BoundaryCondition::named(name);
  return type == BCTypeUserDefined && named ? *named : condition_of_cgns(type);
}

BoundaryCondition condition_of_cgns(int type) {
  for (const auto& [condition, known] : condition_types) {
    if (type == known) return condition;
  }
  return BoundaryCondition::none;
}

}  // namespace quadloop::io
