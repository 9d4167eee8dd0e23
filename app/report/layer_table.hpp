#pragma once

#include <vector>

#include "app/report/figures.hpp"
#include "mesher/layers/layer_report.hpp"
#include "mesher/mesh/check/face_figures.hpp"
#include "mesher/mesh/check/layer_figures.hpp"
#include "mesher/mesh/check/shape_figures.hpp"
#include "mesher/mesh/check/worst_places.hpp"

namespace quadloop {

/// What became of the layers that a case asks for: a line for each boundary in the table, at most 20 of them
/// unless `most` says other, and all as the member "layers" of the record.
void add_layers(Figures& figures, const LayerReport& report, std::size_t most = 20);

/// The layers that a mesh has, as they are measured: likewise.
void add_layers(Figures& figures, const std::vector<LayerFigures>& layers, std::size_t most = 20);

/// Angles and quality of all cells for the record; for the table too where there are no layers. Where there
/// are, the table judges cells in layers by the figures of faces and the others by angles and quality: a thin
/// cell of a layer is of no worse quality than a square. `worst` says where cells outside layers are worst.
void add_quality(Figures& figures, const QualitySummary& all, const QualityByLayers& by_layers,
                 const FaceFiguresByLayers& faces, const WorstPlaces* worst = nullptr);

/// One line: what OpenFOAM's checkMesh and SU2 would object to.
void add_objections(Figures& figures, const FaceFiguresByLayers& faces, const ShapeFigures& shape);

}  // namespace quadloop
