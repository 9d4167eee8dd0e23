#pragma once

#include <string>
#include <vector>

#include "app/report/statistics.hpp"
#include "quadloop/case/settings.hpp"

namespace quadloop::app {

/// Returns a line for each geometry file: the extent of its coordinates, their unit, and whether they are
/// converted to metres; at most most_listed lines.
std::vector<std::string> extent_lines(const std::vector<FileExtent>& extents);

/// Adds these lines to the table, and the member "geometry" to the record: for each file its path, bounding
/// box, declared unit (null: none), plane (of a STEP file, unless XY) and metres per unit (null: no
/// conversion).
void add_extents(Statistics& statistics, const std::vector<FileExtent>& extents);

}  // namespace quadloop::app
