#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/base/json.hpp"
#include "mesher/mesh/check/face_figures.hpp"
#include "mesher/mesh/check/layer_figures.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/check/shape_figures.hpp"
#include "mesher/mesh/check/shape_statistics.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/check/worst_places.hpp"

namespace quadloop {

/// What `check` has found out about one mesh.
struct CheckReport {
  std::string file;
  std::int32_t blocks = 1;
  std::vector<std::pair<std::string, std::int64_t>> boundaries;  ///< name and number of edges
  QualitySummary quality;
  ShapeStatistics shape;
  ShapeFigures figures;
  std::vector<LayerFigures> layers;
  QualityByLayers by_layers;  ///< where there are any
  FaceFiguresByLayers faces;
  WorstPlaces worst;  ///< of the cells outside layers, but for the area ratio
  double area = 0;
  std::int64_t pinched_nodes = 0;
  MeshRegions regions;
  std::optional<GeometryFit> fit;  ///< its faults are in `faults` too
  std::vector<MeshFault> faults;
};

/// A table for people, angles in degrees. At most 20 boundaries and 20 faults of each rule are listed, and
/// how many more there are is said; `verbose` lists all, and every place where the outline makes corners
/// sharp.
std::string report_text(const CheckReport& report, bool verbose);

/// The members of the record that --json prints, with all faults.
JsonObject report_record(const CheckReport& report);

}  // namespace quadloop
