#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "flow/postprocess/free_stream.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop::flow {

/// Names in files of quantities derived from the flow at each node: "mach", "pressure_coefficient".
inline constexpr const char* mach_name = "mach";
inline constexpr const char* pressure_coefficient_name = "pressure_coefficient";
const std::vector<std::string>& quantity_names();

/// Columns of the flow variables in a solution: velocity and pressure; density in compressible flow;
/// wall_shear if there is friction. Throws InputError, which begins with `where`, for a solution without
/// velocity or pressure.
class FlowColumns {
 public:
  FlowColumns(const std::vector<std::string>& names, const std::string& where);
  FlowColumns(const Field& flow, const std::string& where) : FlowColumns(flow.names, where) {}

  bool has_shear() const { return shear_.has_value(); }
  bool has_density() const { return density_.has_value(); }
  /// Values in one row.
  Point velocity(std::span<const double> row) const { return {row[x_velocity_], row[y_velocity_]}; }
  double pressure(std::span<const double> row) const { return row[pressure_]; }
  double shear(std::span<const double> row) const { return shear_ ? row[*shear_] : 0; }
  double density(std::span<const double> row, const FreeStream& stream) const {
    return density_ ? row[*density_] : stream.density;
  }
  /// Returns the local Mach number; 0 if the solution has no density (incompressible flow), or the square of
  /// the speed of sound is not positive.
  double mach(std::span<const double> row, double gamma) const;

 private:
  std::size_t x_velocity_, y_velocity_, pressure_;
  std::optional<std::size_t> density_, shear_;
};

/// Returns the pressure minus the free-stream pressure over the dynamic pressure; 0 if the free stream is at
/// rest.
double pressure_coefficient(double pressure, const FreeStream& stream);

/// Appends these quantities (of quantity_names()) to the flow's variables, replacing existing ones of the
/// same name: at the nodes if velocity and pressure are nodal, else in the cells.
Field with_quantities(const Field& flow, const std::vector<std::string>& names, const FreeStream& stream);

}  // namespace quadloop::flow
