#pragma once

#include <string>

#include "io/step/part21.hpp"

namespace quadloop::io {

/// The units of a representation's context.
struct StepUnits {
  std::string length;  ///< a name of length_units.hpp, else the declared one; empty: none declared
  double metres = 0;   ///< per unit of length; 0: not known
  double radians = 1;  ///< per unit of angle

  friend bool operator==(const StepUnits&, const StepUnits&) = default;
};

/// Throws InputError for a unit that is not well formed.
StepUnits units_of(const StepEntity& context);

}  // namespace quadloop::io
