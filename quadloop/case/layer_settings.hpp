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

/// The height of the first layer, in the geometry's unit of length, and the y+ that asked for it, or 0.
struct FirstHeight {
  double height = 0, y_plus = 0;

  friend bool operator==(const FirstHeight&, const FirstHeight&) = default;
};

struct GrowthRange {
  double low = LayerSpec{}.growth, high = LayerSpec{}.growth_to;

  friend bool operator==(const GrowthRange&, const GrowthRange&) = default;
};

/// The keys of `layers` and of a free line.
struct LayerKeys {
  FirstHeight first;
  GrowthRange growth;
  int count = 0;
  std::optional<double> thickness;
  int equal = 1;
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
const KeyTable<LayerLine>& wake_keys();
const KeyTable<LayerLineKeys>& layer_line_keys();
const KeyTable<BoundaryKeys>& boundary_keys();

/// Reads all [boundary.NAME], a [[wake]], a [[layer_line]]. They throw InputError that names key and line.
void read_boundary_tables(const CaseTable& boundaries, Settings& settings);
LayerLine read_wake(const CaseTable& table);
LayerLine read_layer_line(const CaseTable& table, Settings& settings);

/// What turns a solution's wall shear into wall units, if a wall's layers want a y+: by a laminar flow's own
/// viscosity, else by [flow].
std::optional<WallFlow> wall_flow(const Settings& settings);

/// A warning where there is a table [flow], and neither layers nor a solver of the user's has a use for it;
/// once all are read.
Warnings unused_flow(const Settings& settings);

/// Throws InputError, naming the line and what it lacks, unless the mirror image of each line's path is that
/// of a line with the same settings, point by point: columns are made from its first point on. A path on the
/// axis is its own image; so is that of a free line across the axis, read backwards, which is noted in it.
void require_mirrored_lines(std::vector<LayerLine>& lines, MirrorAxis axis);

/// Throws InputError, naming the line, where a free line reaches the axis along which a half is cut off.
void require_lines_beside(const std::vector<LayerLine>& lines, MirrorAxis axis);

/// Throws InputError, naming the boundary, where its first layer is so thin beside the coordinates that
/// doubles do not tell its nodes apart.
void require_layers_that_doubles_hold(const Geometry& geometry);

}  // namespace quadloop
