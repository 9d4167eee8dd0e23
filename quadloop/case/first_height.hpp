#pragma once

namespace quadloop {

/// Flow conditions for the estimate of first heights: [flow] of a case.
struct FlowConditions {
  double reynolds = 0;          ///< based on free-stream speed and viscosity and the reference length
  double reference_length = 1;  ///< in the geometry's unit of length
};

/// Returns the wall distance at which a turbulent boundary layer is expected to have this y+, in the
/// geometry's unit of length. It is that at the end of a flat plate, with the skin friction of Schlichting's
/// formula
///
///     cf = (2 log10 Re - 0.65)^-2.3,  u_tau = U sqrt(cf / 2),  y = y+ nu / u_tau = y+ L / (Re sqrt(cf / 2))
///
/// (H. Schlichting, Boundary-Layer Theory, 7th ed., chapter XXI; valid for Re up to 1e9). Incompressible: at
/// an adiabatic wall the viscosity grows with the Mach number and y+ falls, so the estimate is conservative.
/// Upstream, where the boundary layer is thinner, y+ is larger: by a half where Re is a hundredth. All
/// arguments must be positive, and Re at least 1000.
double height_of_y_plus(double y_plus, const FlowConditions& flow);

}  // namespace quadloop
