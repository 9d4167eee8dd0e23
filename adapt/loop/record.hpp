#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adapt/loop/case_settings.hpp"
#include "adapt/metric/metric_statistics.hpp"
#include "adapt/remesh/remesh.hpp"
#include "flow/postprocess/flow_statistics.hpp"
#include "mesher/base/json.hpp"

namespace quadloop::adapt {

/// Range of a length of the layers along a boundary, in the geometry's unit.
struct RangeOnWall {
  std::string boundary;
  double least = 0, largest = 0;
};

/// Quality of the layers and of the cells outside them.
struct LayerQuality {
  double outer_angle = 0;   ///< smallest angle outside layers, degrees
  double aspect_ratio = 0;  ///< this and the next two in layers: FaceStatistics
  double non_orthogonality = 0, skewness = 0;
};

/// Contents of record.json for a cycle.
struct CycleRecord : flow::FlowStatistics {
  int cycle = 0;
  std::uint64_t case_digest = 0;      ///< digest of all that the run depends on
  std::uint64_t geometry_digest = 0;  ///< digest of the geometry alone
  std::uint64_t template_digest = 0;  ///< digest of the user's case for SU2 or OpenFOAM; 0: none
  std::uint64_t solution_digest = 0;  ///< digest of the values of the cycle's solution
  CaseSettings settings;              ///< settings of the cycle
  std::int64_t nodes = 0, triangles = 0, quads = 0, leaves = 0;
  double worst_angle = 0;               ///< smallest angle, degrees
  std::optional<LayerQuality> layered;  ///< if the mesh has layers, whose thin cells have small angles
  double mean = 0, deviation = 0;       ///< of log10 of the indicator
  std::int64_t refined = 0, coarsened = 0;
  std::optional<double> estimate;  ///< norm of the interpolation error, if sizes follow from it
  std::optional<double> order;     ///< observed order of convergence from the previous cycle
  std::optional<bool> settled;     ///< whether forces and estimate have settled, if adapt.until is set
  std::optional<bool> morphed;     ///< for a run started from another one: whether the cells were kept
  std::vector<PassRecord> passes;  ///< initial passes, before a run's first cycle
  std::int64_t outside = 0;        ///< nodes that the transfer found outside the old mesh
  /// Drift of each variable's integral in the transfer into this cycle.
  std::vector<std::pair<std::string, double>> drift;
  /// Smallest and largest target first height, for boundaries that specify a y+.
  std::vector<RangeOnWall> first_heights;
  /// Smallest and largest target thickness, for boundaries whose layers follow the flow.
  std::vector<RangeOnWall> thickness;
  std::optional<MetricStatistics> metric;  ///< that the mesh follows, if any
  std::vector<std::pair<std::string, double>> seconds;
};

/// Returns the results of a cycle, without its case and its timings.
JsonObject statistics_of(const CycleRecord& record);
JsonObject seconds_of(const CycleRecord& record);
/// Returns the smallest angle and, with layers, their face quality, for the log.
std::string quality_text(const CycleRecord& record);

/// {goal: {"value": ..., "corrected": ..., "error": ..., "by_alpha": ..., "by_mach": ..., "adjoint_residual":
/// ...}}
JsonObject record_of(const std::vector<flow::GoalValue>& goals);
/// Returns one line for the log.
std::string line_of(const flow::GoalValue& goal);

/// {"from": ..., "to": ..., "steps": ..., "implicit": ..., "cl": {"mean": ..., "smallest": ..., "largest":
/// ...}, "cd": the same, "period": ..., "strouhal": ..., "steady_steps": ..., "steady_residual": ...}
JsonObject record_of(const flow::UnsteadyFlow& flow);

/// {boundary: {"cl": ..., "cd": ..., "cl_friction": ..., "cd_friction": ...}}
JsonObject record_of(const std::vector<flow::BoundaryForce>& forces);

/// Returns one JSON object with one member per line; numbers are the shortest that read back bitwise.
std::string json_text(const CycleRecord& record);

/// The case data in a record.
struct RecordedCase {
  std::uint64_t case_digest = 0, geometry_digest = 0;
  std::optional<std::uint64_t> solution_digest;  ///< absent in records of earlier versions
  CaseSettings settings;
};

/// Returns the number stored under a top-level key of a record, e.g. `cl`; empty if there is none.
std::optional<double> recorded_number(const std::string& text, const std::string& key);
/// Returns the same for a flag, e.g. `converged`.
std::optional<bool> recorded_flag(const std::string& text, const std::string& key);

/// Returns the case data of a record; empty if the text is not a complete record.
std::optional<RecordedCase> recorded_case(const std::string& text);

}  // namespace quadloop::adapt
