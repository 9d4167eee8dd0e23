#pragma once

#include <string>

#include "io/plot/canvas/flow_charts.hpp"

namespace quadloop::app {

/// Reads the table of the flow along walls: `input` itself, the one next to a mesh, or that of the last cycle
/// of an adaptive run's folder. Throws InputError that says what is missing.
io::PlotTable wall_table_for(const std::string& input);

/// Reads residual and forces over steps, from such a table or those of a run's cycles; for a run whose solver
/// writes none, over its cycles, from their records. Throws InputError.
io::Chart chart_of_history(const std::string& input);

}  // namespace quadloop::app
