#pragma once

#include "mesher/mesh/field.hpp"

namespace quadloop {

/// A flow as SU2 leaves it, with what sensors and users name behind its own variables: x_velocity,
/// y_velocity, pressure and mach, each unless it is there by a usual name, from its density, momentum and
/// energy (a volume's) by the law of an ideal gas of this ratio of specific heats. A flow without these four
/// is left as it is. Where the pressure is not positive the Mach number is 0.
Field with_primitive_variables(Field flow, double gamma);

/// The same without what with_primitive_variables() has added: as SU2 restarts from it.
Field without_primitive_variables(const Field& flow);

}  // namespace quadloop
