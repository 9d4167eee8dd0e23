#pragma once

#include <optional>
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
  FlowColumns(const Field& flow, const std::string& where);

  bool has_shear() const { return shear_.has_value(); }
  double pressure(const Field& flow, NodeId node) const { return flow.row(node)[pressure_]; }
  double shear(const Field& flow, NodeId node) const { return shear_ ? flow.row(node)[*shear_] : 0; }
  double density(const Field& flow, NodeId node, const FreeStream& stream) const {
    return density_ ? flow.row(node)[*density_] : stream.density;
  }
  /// The local speed by the speed of sound there; 0 where the solution has no density, as that of an
  /// incompressible flow.
  double mach(const Field& flow, NodeId node, double gamma) const;

 private:
  std::size_t x_velocity_, y_velocity_, pressure_;
  std::optional<std::size_t> density_, shear_;
};

/// The pressure less the free stream's over the dynamic pressure; 0 where the free stream rests.
double pressure_coefficient(double pressure, const FreeStream& stream);

/// The flow with these quantities (of quantity_names()) behind its variables, in the place of any that it has
/// by these names.
Field with_quantities(const Field& flow, const std::vector<std::string>& names, const FreeStream& stream);

}  // namespace quadloop
