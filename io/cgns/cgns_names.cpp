#include "io/cgns/cgns_names.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "io/cgns/cgns_handle.hpp"
#include "io/text/name_index.hpp"

namespace quadloop {

namespace {

constexpr std::size_t longest_name = 32;

constexpr std::array<std::pair<const char*, const char*>, 8> variables{{{"density", "Density"},
                                                                        {"pressure", "Pressure"},
                                                                        {"temperature", "Temperature"},
                                                                        {"mach", "Mach"},
                                                                        {"x_velocity", "VelocityX"},
                                                                        {"y_velocity", "VelocityY"},
                                                                        {"x_momentum", "MomentumX"},
                                                                        {"y_momentum", "MomentumY"}}};

constexpr std::array<std::pair<const char*, int>, 5> conditions{{{"wall", BCWall},
                                                                 {"farfield", BCFarfield},
                                                                 {"inflow", BCInflow},
                                                                 {"outflow", BCOutflow},
                                                                 {"symmetry", BCSymmetryPlane}}};

/// Cut at a character, not inside one of several bytes (UTF-8).
std::string shortened(const std::string& name, std::size_t length) {
  if (name.size() <= length) return name;
  while (length > 0 && (name[length] & 0xC0U) == 0x80U) --length;
  return name.substr(0, length);
}

}  // namespace

std::vector<std::string> cgns_boundary_names(const std::vector<std::string>& names) {
  // Sections stand in the zone and families in the base, beside these nodes.
  DistinctNames distinct;
  for (const char* used :
       {"", ".", "..", "ZoneType", "GridCoordinates", "TRI_3", "QUAD_4", "ZoneBC", "ZoneGridConnectivity",
        "FlowSolution", "domain", "DataClass", "DimensionalUnits"}) {
    distinct.reserve(used);
  }
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

std::vector<std::string> cgns_variable_names(std::vector<std::string> names) {
  for (std::string& name : names) {
    const auto* const known = std::find_if(variables.begin(), variables.end(),
                                           [&](const auto& pair) { return name == pair.first; });
    if (known != variables.end()) name = known->second;
  }
  return cgns_boundary_names(names);
}

std::string variable_name_of_cgns(const std::string& name) {
  for (const auto& [ours, theirs] : variables) {
    if (name == theirs) return ours;
  }
  return name;
}

int cgns_condition(const std::string& condition) {
  for (const auto& [ours, theirs] : conditions) {
    if (condition == ours) return theirs;
  }
  return BCTypeUserDefined;
}

std::string condition_of_cgns(int type) {
  switch (type) {
    case BCWallInviscid:
    case BCWallViscous:
    case BCWallViscousHeatFlux:
    case BCWallViscousIsothermal: return "wall";
    case BCInflowSubsonic:
    case BCInflowSupersonic:
    case BCTunnelInflow: return "inflow";
    case BCOutflowSubsonic:
    case BCOutflowSupersonic:
    case BCTunnelOutflow: return "outflow";
    default: break;
  }
  for (const auto& [ours, theirs] : conditions) {
    if (type == theirs) return ours;
  }
  return "none";
}

}  // namespace quadloop
