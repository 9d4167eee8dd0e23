#pragma once

#include <string>
#include <vector>

#include "app/report/figures.hpp"
#include "quadloop/case/settings.hpp"

namespace quadloop {

/// A line for each geometry file: the extent of its coordinates and their unit, and whether they are meshed
/// as they stand or in metres; at most most_listed lines.
std::vector<std::string> extent_lines(const std::vector<FileExtent>& extents);

/// These lines in the table, and the member "geometry" of the record: for each file its path, box, unit
/// declared (null: none) and metres in one unit (null: as they stand).
void add_extents(Figures& figures, const std::vector<FileExtent>& extents);

}  // namespace quadloop
