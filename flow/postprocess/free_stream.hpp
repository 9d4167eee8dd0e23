#pragma once

namespace quadloop::flow {

/// The free stream, to which the coefficients refer, in the units of the solution.
struct FreeStream {
  double density = 1, pressure = 1 / 1.4, speed = 0;
  double alpha = 0;             ///< degrees above the x axis
  double gamma = 1.4;           ///< ratio of specific heats
  double viscosity = 0;         ///< dynamic; 0: inviscid
  double reference_length = 1;  ///< of the forces, in the mesh's units

  double dynamic_pressure() const { return 0.5 * density * speed * speed; }
};

}  // namespace quadloop::flow
