#pragma once

namespace quadloop {

/// The flow that first heights are made for: [flow] of a case.
struct FlowConditions {
  double reynolds = 0;          ///< by the free stream's speed and viscosity and the reference length
  double reference_length = 1;  ///< in the geometry's unit of length
};

/// The height above a wall at which a turbulent boundary layer is expected to have this y+, in the geometry's
/// unit of length: that of a flat plate at its end, with the skin friction of Schlichting's formula
///
///     cf = (2 log10 Re - 0.65)^-2.3,  u_tau = U sqrt(cf / 2),  y = y+ nu / u_tau = y+ L / (Re sqrt(cf / 2))
///
/// (H. Schlichting, Boundary-Layer Theory, 7th ed., chapter XXI; good for Re up to 1e9). Incompressible: at a
/// wall that takes no heat viscosity grows with the Mach number and y+ falls, so that this errs on the safe
/// side. Upstream, where the layer is thinner, y+ is larger: by a half where Re is a hundredth. All of them
/// above 0, and Re at least 1000.
double height_of_y_plus(double y_plus, const FlowConditions& flow);

}  // namespace quadloop
