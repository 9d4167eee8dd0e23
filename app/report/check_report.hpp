#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/base/json.hpp"
#include "mesher/mesh/check/block_statistics.hpp"
#include "mesher/mesh/check/edge_statistics.hpp"
#include "mesher/mesh/check/face_statistics.hpp"
#include "mesher/mesh/check/layer_statistics.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/check/shape_statistics.hpp"
#include "mesher/mesh/check/solver_statistics.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/check/validate_geometry.hpp"
#include "mesher/mesh/check/worst_places.hpp"

namespace quadloop::app {

/// Results of `check` for one mesh.
struct CheckReport {
  std::string file;
  std::vector<BlockStatistics> blocks;
  InterfaceEdges interfaces;
  using Edges = std::vector<std::pair<std::string, std::int64_t>>;
  Edges boundaries, inner_lines;   ///< name and number of edges
  std::vector<std::string> pairs;  ///< both names of each periodic pair
  QualitySummary quality;
  ShapeStatistics shape;
  SolverStatistics statistics;
  std::vector<LayerStatistics> layers;
  QualityByLayers by_layers;  ///< if there are layers
  FaceStatisticsByLayers faces;
  WorstPlaces worst;
  Point largest_area_ratio;  ///< its place
  double area = 0;
  std::int64_t pinched_nodes = 0;
  MeshRegions regions;
  std::optional<GeometryFit> fit;  ///< on the root; its errors are also in `faults`
  std::vector<MeshFault> faults;   ///< on the root
};

/// Returns a table, angles in degrees. At most 20 boundaries and 20 errors of each rule are listed, with the
/// number of others; `verbose` lists all, and every location with sharp corners due to the geometry.
std::string report_text(const CheckReport& report, bool verbose);

/// Returns the members of the record that --json prints, with all errors.
JsonObject report_record(const CheckReport& report);

}  // namespace quadloop::app
