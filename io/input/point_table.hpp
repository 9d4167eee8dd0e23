#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "io/input/geometry_line.hpp"

namespace quadloop::io {

/// Vectors at the points of a geometry (velocities or gradients) as a text table: rows of boundary, x, y and
/// two components. A point that occurs twice, as where open lines meet, counts once, where it occurs first.

/// A list for each line, with a vector for each of its points.
using PointVectors = std::vector<std::vector<Point>>;

/// Returns the table, in the order of the lines; `names` are those of the components.
std::string point_table(std::span<const GeometryLine> lines, const PointVectors& values,
                        const std::string& names);

using ComponentNames = std::array<std::string, 2>;

/// Returns for each point of the lines its components in the table at `path`, 0 if it has no row. The first
/// line of the table names the columns, in any order: boundary, x, y and the components. A row belongs to the
/// point with exactly its x and y, on the named boundary. Throws InputError "file:line: ..." for other
/// columns, an invalid row, a point that is not in the geometry, or duplicate rows; and for an empty table.
PointVectors read_point_table(const std::string& path, std::span<const GeometryLine> lines,
                              const ComponentNames& components);

}  // namespace quadloop::io
