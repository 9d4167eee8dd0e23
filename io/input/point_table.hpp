#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// What the points of an outline do or gain, as a text table: rows of boundary, x, y and two components. Of
/// an outline as read_outline() read it, which may have turned loops round, in the order of its file.

/// The table; `names` are those of the components. A point that the file has twice, as open chains do where
/// they meet, has one row. `path` is the outline's file. Throws InputError where it cannot be read again.
std::string point_table(const Geometry& outline, const std::string& path, std::span<const Point> values,
                        const std::string& names);

using ComponentNames = std::array<std::string, 2>;

/// Of each vertex of the outline the components that the table at `path` has for it, 0 where it has no row.
/// The first line names the columns, in any order: boundary, x, y and the components. A row's point is the
/// vertex with just its x and y, on the boundary named. Throws InputError "file:line: ..." for other columns,
/// a row that is none, a point that the outline does not have there, or two rows for one; and for a table
/// without rows.
std::vector<Point> read_point_table(const std::string& path, const Geometry& outline,
                                    const ComponentNames& components);

}  // namespace quadloop
