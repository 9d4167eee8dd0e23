#include "io/cgns/cgns_exponents.hpp"

#include <algorithm>
#include <iterator>

namespace quadloop::io {

namespace {

constexpr CgnsExponents none{}, of_length{0, 1}, of_density{1, -3}, of_pressure{1, -1, -2},
    of_velocity{0, 1, -1}, of_momentum{1, -2, -1}, of_energy{0, 2, -2}, of_rate{0, 0, -1},
    of_temperature{0, 0, 0, 1}, of_viscosity{1, -1, -1}, of_diffusion{0, 2, -1}, of_heat{0, 2, -2, -1};

struct Quantity {
  std::string_view name;
  CgnsExponents exponents;
};

constexpr std::array scalars{Quantity{"CoefPressure", none},
                             Quantity{"Density", of_density},
                             Quantity{"DensityStagnation", of_density},
                             Quantity{"EnergyInternal", of_energy},
                             Quantity{"EnergyKinetic", of_energy},
                             Quantity{"EnergyStagnation", of_energy},
                             Quantity{"EnergyStagnationDensity", of_pressure},
                             Quantity{"Enthalpy", of_energy},
                             Quantity{"EnthalpyStagnation", of_energy},
                             Quantity{"Entropy", {1, 2, -2, -1}},
                             Quantity{"Mach", none},
                             Quantity{"Potential", of_diffusion},
                             Quantity{"Prandtl", none},
                             Quantity{"Pressure", of_pressure},
                             Quantity{"PressureDynamic", of_pressure},
                             Quantity{"PressureStagnation", of_pressure},
                             Quantity{"Reynolds", none},
                             Quantity{"SpecificHeatPressure", of_heat},
                             Quantity{"SpecificHeatRatio", none},
                             Quantity{"SpecificHeatVolume", of_heat},
                             Quantity{"StreamFunction", of_diffusion},
                             Quantity{"Temperature", of_temperature},
                             Quantity{"TemperatureStagnation", of_temperature},
                             Quantity{"ThermalConductivity", {1, 1, -3, -1}},
                             Quantity{"TurbulentDissipation", {0, 2, -3}},
                             Quantity{"TurbulentDissipationRate", of_rate},
                             Quantity{"TurbulentDistance", of_length},
                             Quantity{"TurbulentEnergyKinetic", of_energy},
                             Quantity{"TurbulentSANuTilde", of_diffusion},
                             Quantity{"VelocitySound", of_velocity},
                             Quantity{"VelocitySoundStagnation", of_velocity},
                             Quantity{"ViscosityEddy", of_viscosity},
                             Quantity{"ViscosityEddyKinematic", of_diffusion},
                             Quantity{"ViscosityKinematic", of_diffusion},
                             Quantity{"ViscosityMolecular", of_viscosity}};

/// Names of their components end in X, Y or Z.
constexpr std::array vectors{Quantity{"CoefSkinFriction", none},    Quantity{"Coordinate", of_length},
                             Quantity{"Force", {1, 1, -2}},         Quantity{"Momentum", of_momentum},
                             Quantity{"SkinFriction", of_pressure}, Quantity{"Velocity", of_velocity},
                             Quantity{"Vorticity", of_rate}};

std::optional<CgnsExponents> found_in(const auto& quantities, std::string_view name) {
  const auto found = std::ranges::find(quantities, name, &Quantity::name);
  if (found == quantities.end()) return {};
  return found->exponents;
}

}  // namespace

std::optional<CgnsExponents> cgns_exponents(std::string_view name) {
  constexpr std::string_view magnitude = "Magnitude";
  if (const auto exponents = found_in(scalars, name)) return exponents;
  if (name.ends_with(magnitude) && name != "CoordinateMagnitude")
    return found_in(vectors, name.substr(0, name.size() - magnitude.size()));
  if (!name.empty() && std::string_view("XYZ").find(name.back()) != std::string_view::npos)
    return found_in(vectors, name.substr(0, name.size() - 1));
  return {};
}

}  // namespace quadloop::io
