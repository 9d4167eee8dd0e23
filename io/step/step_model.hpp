#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "io/dxf/drawing_choice.hpp"
#include "io/step/part21.hpp"
#include "io/step/space_curve.hpp"
#include "io/step/step_units.hpp"

namespace quadloop::io {

/// A curve of the geometry, and the entity that it is from.
struct StepCurve {
  SpaceCurve curve;
  std::string name;  ///< of the curve, edge or face; empty: none
  std::string layer;
  StepEntity entity;
};

/// The curves of a STEP file.
struct StepModel {
  std::vector<StepCurve> curves;
  std::set<std::string> layers;  ///< of all curves of the file
  LeftOut left_out;
  StepUnits units;               ///< empty: no curves
  std::int64_t inner_edges = 0;  ///< edges between two faces of a sheet, which are left out
  double largest_deviation = 0;  ///< largest distance of a vertex from the curve of its edge
};

/// Collects the curves of the layers that match, or of all visible layers: those of curve sets and wires, and
/// the boundary edges of planar faces and sheets, at all their places in an assembly. Throws InputError for
/// damaged entities, references in a circle, solids, curved faces, and representations in different units.
StepModel read_step_model(const Part21File& file, const DrawingChoice& choice);

}  // namespace quadloop::io
