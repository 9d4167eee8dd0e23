#pragma once

#include "mesher/mesh/field.hpp"

namespace quadloop::flow {

/// Returns an SU2 solution extended by the usual variables of sensors and users: x_velocity, y_velocity,
/// pressure, mach and total_pressure (of the flow brought to rest without losses), unless it has them under a
/// usual name. They are computed from density, momentum and energy (per volume) for an ideal gas with this
/// ratio of specific heats. A solution without these four is unchanged. The Mach number is 0 if the pressure
/// is not positive.
Field with_primitive_variables(Field flow, double gamma);

/// Returns the solution without the variables of with_primitive_variables(), from which SU2 restarts.
Field without_primitive_variables(const Field& flow);

}  // namespace quadloop::flow
