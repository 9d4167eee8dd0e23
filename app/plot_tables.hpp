#pragma once

#include <string>

#include "io/plot/canvas/flow_charts.hpp"

namespace quadloop {

/// The table of the flow along walls: `input` itself, the one beside a mesh, or that of the last cycle of an
/// adaptive run's folder. Throws InputError, with what is missing.
PlotTable wall_table_for(const std::string& input);

/// Residual and forces over steps, from such a table or those of a run's cycles; of a run whose solver leaves
/// none over its cycles, from their records. Throws InputError.
Chart chart_of_history(const std::string& input);

}  // namespace quadloop
