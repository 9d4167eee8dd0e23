#pragma once

#include <vector>

#include "app/report/figures.hpp"
#include "mesher/layers/layer_report.hpp"
#include "mesher/mesh/check/layer_figures.hpp"

namespace quadloop {

/// What became of the layers that a case asks for: a line for each boundary in the table, at most 20 of them
/// unless `most` says other, and all as the member "layers" of the record.
void add_layers(Figures& figures, const LayerReport& report, std::size_t most = 20);

/// The layers that a mesh has, as they are measured: likewise.
void add_layers(Figures& figures, const std::vector<LayerFigures>& layers, std::size_t most = 20);

/// The cells of layers, and the shapes of the others, which the figures of all cells do not tell.
void add_quality(Figures& figures, const QualityByLayers& quality);

}  // namespace quadloop
