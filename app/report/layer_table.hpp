#pragma once

#include <vector>

#include "app/report/statistics.hpp"
#include "mesher/layers/layer_report.hpp"
#include "mesher/mesh/check/face_statistics.hpp"
#include "mesher/mesh/check/layer_statistics.hpp"
#include "mesher/mesh/check/solver_statistics.hpp"
#include "mesher/mesh/check/worst_places.hpp"

namespace quadloop::app {

/// Adds the results for the layers of a case: a line for each boundary in the table, at most `most`, and all
/// as the member "layers" of the record.
void add_layers(Statistics& statistics, const LayerReport& report, std::size_t most = 20);

/// Adds the measured layers of a mesh in the same way.
void add_layers(Statistics& statistics, const std::vector<LayerStatistics>& layers, std::size_t most = 20);

/// Adds angles and quality of all cells to the record; to the table too if there are no layers. With layers,
/// the table has face quality for cells in layers, and angles and quality for the others: a thin layer cell
/// is not worse than a square. `worst`: locations of the worst cells outside layers.
void add_quality(Statistics& statistics, const QualitySummary& all, const QualityByLayers& by_layers,
                 const FaceStatisticsByLayers& faces, const WorstPlaces* worst = nullptr);

/// Adds one line: what OpenFOAM's checkMesh and SU2 would object to.
void add_objections(Statistics& statistics, const FaceStatisticsByLayers& faces,
                    const SolverStatistics& shape);

}  // namespace quadloop::app
