#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapt/sensor/measured_friction.hpp"
#include "mesher/geometry/assemble/boundary_rules.hpp"
#include "mesher/geometry/layer_spec.hpp"
#include "mesher/geometry/mirror_axis.hpp"
#include "mesher/layers/front/layer_lines.hpp"
#include "quadloop/case/key_table.hpp"
#include "quadloop/case/settings.hpp"

namespace quadloop {

/// The height of the first layer, in the geometry's unit of length, and the y+ that determined it, or 0.
struct FirstHeight {
  double height = 0, y_plus = 0;

  friend bool operator==(const FirstHeight&, const FirstHeight&) = default;
};

struct GrowthRange {
  double low = LayerSpec{}.growth, high = LayerSpec{}.growth_to;

  friend bool operator==(const GrowthRange&, const GrowthRange&) = default;
};

/// The total thickness of layers: at least this, if it is positive, or that of the boundary layer.
struct LayersThickness {
  double least = 0;
  bool follows_flow = false;

  friend bool operator==(const LayersThickness&, const LayersThickness&) = default;
};

/// The keys of `layers` and of a free line.
struct LayerKeys {
  FirstHeight first;
  GrowthRange growth;
  int count = 0;
  LayersThickness thickness;
  int equal = 1;
};

/// The course of a wake: points, or that of the flow.
struct WakeCourse {
  std::vector<Point> points;
  bool follows_flow = false;

  friend bool operator==(const WakeCourse&, const WakeCourse&) = default;
};

/// Sizes along a wake. Only without layers they may differ.
struct WakeSpacing {
  double at_edge = 0, at_end = 0;

  friend bool operator==(const WakeSpacing&, const WakeSpacing&) = default;
};

/// The table [[wake]].
struct WakeKeys {
  LayerLine line;
  WakeCourse course;
  WakeSpacing spacing;
  bool has_layers = true;
};

/// The table [[layer_line]].
struct LayerLineKeys {
  LayerLine line;
  LayerKeys layers;
};

/// The table [boundary.NAME].
struct BoundaryKeys {
  BoundaryRule rule;
  std::optional<double> pressure, wall_temperature;
  std::optional<BoundaryCondition> wall;
};

const KeyTable<LayerKeys>& layer_keys();
const KeyTable<WakeKeys>& wake_keys();
const KeyTable<LayerLineKeys>& layer_line_keys();
const KeyTable<BoundaryKeys>& boundary_keys();

/// Read all [boundary.NAME], a [[wake]], a [[layer_line]]. Throw InputError that names key and line.
void read_boundary_tables(const io::CaseTable& boundaries, Settings& settings);
LayerLine read_wake(const io::CaseTable& table);
LayerLine read_layer_line(const io::CaseTable& table, Settings& settings);

/// Returns the flow that converts a solution's wall shear to wall units, if the layers of a wall specify a
/// y+. The viscosity is that of a laminar flow, else that of [flow].
std::optional<adapt::WallFlow> wall_flow(const Settings& settings);

/// Returns a warning if there is a table [flow] that is used neither by layers nor by an external solver.
/// Call it after all tables have been read.
Warnings unused_flow(const Settings& settings);

/// Throws InputError, naming the line and what is missing, unless the mirror image of each line's path is the
/// path of a line with the same settings, point by point, as columns are generated from its first point on. A
/// path on the axis is its own image. A free line across the axis is its own image read backwards; this is
/// recorded in it.
void require_mirrored_lines(std::vector<LayerLine>& lines, MirrorAxis axis);

/// Throws InputError, naming the line, if a free line reaches the axis of a half model.
void require_lines_beside(const std::vector<LayerLine>& lines, MirrorAxis axis);

/// Throws InputError, naming the boundary, if its first layer is too thin, compared with the coordinates, for
/// double precision.
void require_layers_that_doubles_hold(const Geometry& geometry);

}  // namespace quadloop
