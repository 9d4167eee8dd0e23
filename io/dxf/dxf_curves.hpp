#pragma once

#include <optional>
#include <span>

#include "io/dxf/dxf_text.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop::io {

/// An affine map of the plane: of a block's coordinates to those of the drawing, or of the plane of an entity
/// to the plane seen from above.
struct DxfPlacement {
  Point x{1, 0}, y{0, 1}, origin;

  Point operator()(Point p) const { return p.x * x + p.y * y + origin; }
  /// This map after another one.
  DxfPlacement after(const DxfPlacement& first) const;
};

/// The plane of an entity with an extrusion direction, by the arbitrary axis algorithm of the DXF reference.
DxfPlacement plane_of(const DxfRecord& entity);

/// Whether the entity is a line, polyline, arc, circle, ellipse or spline.
bool is_dxf_curve(const DxfRecord& entity);

/// The first entity, for which is_dxf_curve() holds, as a chain placed by the map: closed if the entity says
/// so or its ends coincide. A polyline's vertices follow it in `entities`. None if it has no extent. The
/// chain has no name and no source yet. Throws InputError with layer and handle for data that define no
/// curve.
std::optional<Chain> dxf_curve(std::span<const DxfRecord> entities, const DxfPlacement& placement);

}  // namespace quadloop::io
