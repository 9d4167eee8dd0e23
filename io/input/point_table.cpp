#include "io/input/point_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "io/files/reading/input_file.hpp"
#include "io/input/geometry_file.hpp"
#include "io/text/text_scanner.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

using Coordinates = std::pair<double, double>;

std::map<Coordinates, std::int32_t> vertices_by_place(const Geometry& outline) {
  std::map<Coordinates, std::int32_t> vertices;
  for (std::int32_t v = 0; v < outline.size(); ++v)
    vertices.emplace(Coordinates(outline.point(v).x, outline.point(v).y), v);
  return vertices;
}

/// Returns the fields of a row, without surrounding blanks and quotes.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  std::string cell;
  while (std::getline(stream, cell, ',')) {
    const std::size_t begin = cell.find_first_not_of(" \t\r\""), end = cell.find_last_not_of(" \t\r\"");
    cells.push_back(begin == std::string::npos ? "" : cell.substr(begin, end - begin + 1));
  }
  return cells;
}

/// Columns of boundary, x, y and both components.
using Columns = std::array<std::size_t, 5>;

/// Throws InputError unless the line names exactly these columns, in any order.
Columns columns_of(const std::string& line, const std::string& place, const ComponentNames& components) {
  const std::array<std::string, 5> wanted{"boundary", "x", "y", components[0], components[1]};
  const std::string cure = fmt::format("; begin the table with the line {}", fmt::join(wanted, ","));
  const std::vector<std::string> names = cells_of(line);
  for (const std::string& name : names) {
    if (std::ranges::count(wanted, name) == 0)
      throw InputError(fmt::format("{}: '{}' is the name of no column{}", place, name, cure));
    if (std::ranges::count(names, name) > 1)
      throw InputError(fmt::format("{}: two columns are named '{}'{}", place, name, cure));
  }
  Columns columns{};
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const auto found = std::ranges::find(names, wanted[k]);
    if (found == names.end())
      throw InputError(fmt::format("{}: there is no column '{}'{}", place, wanted[k], cure));
    columns[k] = static_cast<std::size_t>(found - names.begin());
  }
  return columns;
}

struct PointRow {
  std::string boundary;
  Point place, value;
};

/// Throws InputError.
PointRow row_of(const std::string& line, const Columns& columns, const std::string& place) {
  const std::vector<std::string> cells = cells_of(line);
  std::array<double, 4> numbers{};
  bool good = cells.size() == columns.size();
  for (std::size_t k = 0; good && k < numbers.size(); ++k)
    good = parse_real(cells[columns[k + 1]], numbers[k]) && std::isfinite(numbers[k]);
  if (good) return {cells[columns[0]], {numbers[0], numbers[1]}, {numbers[2], numbers[3]}};
  throw InputError(place +
                   ": is no row of a point: boundary, x, y and two numbers, with commas between them, in the "
                   "order of the first line");
}

/// Returns the vertex of a row. Throws InputError if the geometry has none, or on other boundaries.
std::int32_t vertex_of(const PointRow& row, const std::map<Coordinates, std::int32_t>& vertices,
                       const Geometry& outline, const std::string& place) {
  const auto vertex = vertices.find({row.place.x, row.place.y});
  if (vertex == vertices.end())
    throw InputError(fmt::format(
        "{}: the geometry has no point ({}, {}); give its points with all their digits, as in its file",
        place, row.place.x, row.place.y));
  const std::int32_t v = vertex->second;
  const std::string& after = outline.boundary(outline.boundary_of(v)).name;
  const std::string& before = outline.boundary(outline.boundary_of(outline.previous(v))).name;
  if (row.boundary != after && row.boundary != before)
    throw InputError(fmt::format("{}: ({}, {}) is a point of boundary '{}', not of '{}'; name its boundary",
                                 place, row.place.x, row.place.y, after, row.boundary));
  return v;
}

bool is_no_line(const std::string& line) {
  return line.find_first_not_of(" \t\r") == std::string::npos || line.front() == '#';
}

}  // namespace

std::string point_table(const Geometry& outline, const std::string& path, std::span<const Point> values,
                        const std::string& names) {
  std::map<Coordinates, std::int32_t> left = vertices_by_place(outline);
  std::string text = "boundary,x,y," + names + "\n";
  std::vector<std::string> reported_already;
  for (const Chain& chain : read_geometry(path, reported_already)) {
    for (const Point& p : chain.points) {
      const auto found = left.find({p.x, p.y});
      if (found == left.end()) continue;
      const Point& value = values[found->second];
      text += fmt::format("{},{},{},{},{}\n", chain.name, p.x, p.y, value.x, value.y);
      left.erase(found);
    }
  }
  return text;
}

std::vector<Point> read_point_table(const std::string& path, const Geometry& outline,
                                    const ComponentNames& components) {
  const std::map<Coordinates, std::int32_t> vertices = vertices_by_place(outline);
  std::vector<Point> values(outline.size());
  std::vector<char> told(outline.size(), 0);
  std::istringstream lines(read_input(path));
  std::string line;
  std::optional<Columns> columns;
  bool has_rows = false;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (is_no_line(line)) continue;
    const std::string place = fmt::format("{}:{}", path, number);
    if (!columns) {
      columns = columns_of(line, place, components);
      continue;
    }
    const PointRow row = row_of(line, *columns, place);
    const std::int32_t vertex = vertex_of(row, vertices, outline, place);
    if (told[vertex] != 0)
      throw InputError(fmt::format("{}: ({}, {}) has a row already; give each point once", place, row.place.x,
                                   row.place.y));
    told[vertex] = 1;
    values[vertex] = row.value;
    has_rows = true;
  }
  if (!has_rows)
    throw InputError(path + ": has no row of a point; give boundary,x,y," + components[0] + "," +
                     components[1] + " of each point that moves, below a line with these names");
  return values;
}

}  // namespace quadloop::io
