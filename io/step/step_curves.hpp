#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "io/step/part21.hpp"
#include "io/step/space_curve.hpp"

namespace quadloop::io {

/// Reads a CARTESIAN_POINT or a VERTEX_POINT; a plane one has z = 0. Throws InputError for other entities.
SpacePoint point_of(const StepEntity& entity);

/// A placement in space: origin and axes, orthogonal and of length 1.
struct StepPlacement {
  SpacePoint origin, x, y, z;
};

/// Reads an AXIS2_PLACEMENT_3D or an AXIS2_PLACEMENT_2D. Throws InputError for other entities.
StepPlacement placement_of(const StepEntity& entity);

/// Whether the entity is a curve that bounded_curve() reads.
bool is_bounded_curve(const StepEntity& entity);

/// Reads a curve of bounded length: POLYLINE, B-splines, CIRCLE, ELLIPSE, TRIMMED_CURVE, or a SURFACE_CURVE
/// on one of these. `radians`: of the unit of angle. The direction along the curve is not kept. The result
/// are several curves where a part of a closed B-spline contains the spline's ends, none if a part has no
/// length. Throws InputError for a curve that is not well formed or of another type.
std::vector<SpaceCurve> bounded_curve(const StepEntity& entity, double radians);

/// Reads the curve of an EDGE_CURVE between its vertices. `off` becomes the larger distance of a vertex from
/// the curve. Throws InputError also if a vertex is far from the curve.
std::vector<SpaceCurve> curve_of_edge(const StepEntity& edge, double radians, double& off);

/// Removes what wraps a curve: the curve in space of a SURFACE_CURVE, SEAM_CURVE or INTERSECTION_CURVE.
StepEntity without_surface(const StepEntity& curve);

}  // namespace quadloop::io
