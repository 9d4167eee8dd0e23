#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "flow/quantities/free_stream.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop {

/// The names of what follows from a flow at each node, as files have them: "mach", "pressure_coefficient".
inline constexpr const char* mach_name = "mach";
inline constexpr const char* pressure_coefficient_name = "pressure_coefficient";
const std::vector<std::string>& quantity_names();

/// Where a solution has the variables of a flow: velocity and pressure; density where the flow is
/// compressible; wall_shear where it has friction. Throws InputError, which begins with `where`, for one
/// without velocity or pressure.
class FlowColumns {
 public:
  FlowColumns(const std::vector<std::string>& names, const std::string& where);
  FlowColumns(const Field& flow, const std::string& where) : FlowColumns(flow.names, where) {}

  bool has_shear() const { return shear_.has_value(); }
  bool has_density() const { return density_.has_value(); }
  /// Of one row of values.
  Point velocity(std::span<const double> row) const { return {row[x_velocity_], row[y_velocity_]}; }
  double pressure(std::span<const double> row) const { return row[pressure_]; }
  double shear(std::span<const double> row) const { return shear_ ? row[*shear_] : 0; }
  double density(std::span<const double> row, const FreeStream& stream) const {
    return density_ ? row[*density_] : stream.density;
  }
  /// The local speed by the speed of sound there; 0 where the solution has no density, as that of an
  /// incompressible flow, or where the speed of sound is not above 0.
  double mach(std::span<const double> row, double gamma) const;

 private:
  std::size_t x_velocity_, y_velocity_, pressure_;
  std::optional<std::size_t> density_, shear_;
};

/// The pressure less the free stream's over the dynamic pressure; 0 where the free stream rests.
double pressure_coefficient(double pressure, const FreeStream& stream);

/// The flow with these quantities (of quantity_names()) behind its variables, in the place of any that it has
/// by these names: at the nodes where it has velocity and pressure there, else in the cells.
Field with_quantities(const Field& flow, const std::vector<std::string>& names, const FreeStream& stream);

}  // namespace quadloop
