#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adapt/sensor/measured_friction.hpp"
#include "io/input/case_file.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/layer_spec.hpp"
#include "mesher/geometry/mirror_axis.hpp"
#include "mesher/layers/front/layer_lines.hpp"
#include "quadloop/case/first_height.hpp"
#include "quadloop/case/flow_settings.hpp"
#include "quadloop/case/solver_settings.hpp"

namespace quadloop {

/// Reads the tables `layers` of boundaries, wakes and lines with layers, with the table [flow] that `first =
/// "yplus:1"` stands on. Throws InputError that names key and line.
class LayerSettings {
 public:
  explicit LayerSettings(std::optional<FlowSettings> flow) : flow_{std::move(flow)} {}

  LayerSpec read(const CaseTable& layers);

  /// Wakes and free lines with layers.
  std::vector<LayerLine> read_lines(const CaseTable& root);

  /// What turns a solution's wall shear into wall units, if a wall's layers want a y+: by a laminar flow's
  /// own viscosity, else by [flow].
  std::optional<WallFlow> wall_flow(const SolverSettings& solver) const;

  /// A warning where there is a table [flow], and neither layers have asked for it nor a solver has a use for
  /// the stream that it tells; once all are read.
  Warnings unused(const SolverSettings& solver) const;

 private:
  /// The same keys of a table that may have others.
  LayerSpec read_keys(const CaseTable& table);
  LayerLine read_layer_line(const CaseTable& table);
  void read_first_height(const CaseTable& layers, LayerSpec& spec);
  FlowConditions flow_conditions(const CaseTable& layers) const;

  std::optional<FlowSettings> flow_;
  bool used_ = false;
};

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
