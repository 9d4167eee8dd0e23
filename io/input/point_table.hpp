#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop::io {

/// Vectors at the points of a geometry (velocities or gradients) as a text table: rows of boundary, x, y and
/// two components. The geometry must be from read_outline(), which may have reversed loops; rows are in the
/// order of its file.

/// Returns the table; `names` are those of the components. A point that occurs twice in the file, as where
/// open chains meet, has one row. `path` is the geometry file. Throws InputError if it cannot be read again.
std::string point_table(const Geometry& outline, const std::string& path, std::span<const Point> values,
                        const std::string& names);

using ComponentNames = std::array<std::string, 2>;

/// Returns for each vertex of the geometry its components in the table at `path`, 0 if it has no row. The
/// first line names the columns, in any order: boundary, x, y and the components. A row belongs to the vertex
/// with exactly its x and y, on the named boundary. Throws InputError "file:line: ..." for other columns, an
/// invalid row, a point that is not in the geometry, or duplicate rows; and for an empty table.
std::vector<Point> read_point_table(const std::string& path, const Geometry& outline,
                                    const ComponentNames& components);

}  // namespace quadloop::io
