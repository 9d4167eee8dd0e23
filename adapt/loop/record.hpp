#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adapt/loop/case_settings.hpp"
#include "adapt/metric/metric_figures.hpp"
#include "adapt/remesh/remesh.hpp"
#include "flow/quantities/flow_figures.hpp"
#include "mesher/base/json.hpp"

namespace quadloop {

/// Of one boundary's layers, in the geometry's unit of length.
struct FirstHeights {
  std::string boundary;
  double least = 0, largest = 0;
};

/// What layers, and the cells outside them, are judged by.
struct LayerQuality {
  double outer_angle = 0;   ///< the smallest corner outside layers, degrees
  double aspect_ratio = 0;  ///< of layers these: FaceFigures
  double non_orthogonality = 0, skewness = 0;
};

/// What record.json keeps of a cycle.
struct CycleRecord : FlowFigures {
  int cycle = 0;
  std::uint64_t case_digest = 0;      ///< of all that the run depends on
  std::uint64_t geometry_digest = 0;  ///< of the outline alone
  std::uint64_t template_digest = 0;  ///< of the user's case for SU2 or OpenFOAM; 0: none
  std::uint64_t solution_digest = 0;  ///< of the values that the cycle's solution has
  CaseSettings settings;              ///< those that the cycle was made with
  std::int64_t nodes = 0, triangles = 0, quads = 0, leaves = 0;
  double worst_angle = 0;               ///< the smallest corner, degrees
  std::optional<LayerQuality> layered;  ///< where the mesh has layers, whose thin cells have small corners
  double mean = 0, deviation = 0;       ///< of log10 of the indicator
  std::int64_t refined = 0, coarsened = 0;
  std::optional<double> estimate;  ///< the norm of the interpolation error, where sizes follow from it
  std::optional<double> order;     ///< at which it fell from the cycle before
  std::optional<bool> settled;     ///< whether forces and estimate have, where that ends the run
  std::optional<bool> morphed;     ///< of a run's first mesh that another run left: whether its cells stay
  std::vector<PassRecord> passes;  ///< before a run's first cycle
  std::int64_t outside = 0;        ///< nodes that the transfer found outside the old mesh
  /// How far each variable's integral drifted in the transfer into this cycle.
  std::vector<std::pair<std::string, double>> drift;
  /// Of boundaries that want a y+: the least and the largest first height that their layers were asked for.
  std::vector<FirstHeights> first_heights;
  std::optional<MetricFigures> metric;  ///< that the mesh follows
  std::vector<std::pair<std::string, double>> seconds;
};

/// What the cycle came to, without its case and the seconds that it took.
JsonObject figures_of(const CycleRecord& record);
JsonObject seconds_of(const CycleRecord& record);
/// For people: the smallest angle, in layers the figures of their faces.
std::string quality_text(const CycleRecord& record);

/// {goal: {"value": ..., "corrected": ..., "error": ..., "by_alpha": ..., "by_mach": ..., "adjoint_residual":
/// ...}}
JsonObject record_of(const std::vector<GoalValue>& goals);
/// For people.
std::string line_of(const GoalValue& goal);

/// {"from": ..., "to": ..., "steps": ..., "implicit": ..., "cl": {"mean": ..., "smallest": ..., "largest":
/// ...}, "cd": the same, "period": ..., "strouhal": ..., "steady_steps": ..., "steady_residual": ...}
JsonObject record_of(const UnsteadyFlow& flow);

/// {boundary: {"cl": ..., "cd": ..., "cl_friction": ..., "cd_friction": ...}}
JsonObject record_of(const std::vector<BoundaryForce>& forces);

/// One JSON object, a member a line; numbers are the shortest that read back as they are.
std::string json_text(const CycleRecord& record);

/// What a record's text says of the case.
struct RecordedCase {
  std::uint64_t case_digest = 0, geometry_digest = 0;
  std::optional<std::uint64_t> solution_digest;  ///< records of earlier versions have none
  CaseSettings settings;
};

/// What a record's text has under a key of its own that is a number, as `cl`. Empty where there is none.
std::optional<double> recorded_number(const std::string& text, const std::string& key);

/// Empty where the text is no whole record of ours.
std::optional<RecordedCase> recorded_case(const std::string& text);

}  // namespace quadloop
