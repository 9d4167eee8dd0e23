#include "io/input/point_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "io/files/reading/input_file.hpp"
#include "io/text/text_scanner.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

/// A point of the geometry, where it occurs first, and the boundaries on which it occurs.
struct TablePoint {
  std::size_t line, number;
  std::set<std::string> boundaries;
};
using PointsByPlace = std::map<Point, TablePoint>;

PointsByPlace points_by_place(std::span<const GeometryLine> lines) {
  PointsByPlace points;
  for (std::size_t line = 0; line < lines.size(); ++line) {
    for (std::size_t k = 0; k < lines[line].points.size(); ++k)
      points.try_emplace(lines[line].points[k], TablePoint{line, k, {}})
          .first->second.boundaries.insert(lines[line].boundary);
  }
  return points;
}

/// A zero for each point.
PointVectors zeros(std::span<const GeometryLine> lines) {
  PointVectors values;
  for (const GeometryLine& line : lines) values.emplace_back(line.points.size());
  return values;
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

/// Returns the point of a row. Throws InputError if the geometry has none, or on other boundaries.
const TablePoint& point_of(const PointRow& row, const PointsByPlace& points, const std::string& place) {
  const auto point = points.find(row.place);
  if (point == points.end())
    throw InputError(fmt::format(
        "{}: the geometry has no point ({}, {}); give its points with all their digits, as in its file",
        place, row.place.x, row.place.y));
  const std::set<std::string>& boundaries = point->second.boundaries;
  if (!boundaries.contains(row.boundary))
    throw InputError(fmt::format("{}: ({}, {}) is a point of boundary '{}', not of '{}'; name its boundary",
                                 place, row.place.x, row.place.y, *boundaries.begin(), row.boundary));
  return point->second;
}

bool is_no_line(const std::string& line) {
  return line.find_first_not_of(" \t\r") == std::string::npos || line.front() == '#';
}

}  // namespace

std::string point_table(std::span<const GeometryLine> lines, const PointVectors& values,
                        const std::string& names) {
  const PointsByPlace points = points_by_place(lines);
  std::string text = "boundary,x,y," + names + "\n";
  for (std::size_t line = 0; line < lines.size(); ++line) {
    for (std::size_t k = 0; k < lines[line].points.size(); ++k) {
      const Point &p = lines[line].points[k], &value = values[line][k];
      const TablePoint& first = points.at(p);
      if (first.line != line || first.number != k) continue;
      text += fmt::format("{},{},{},{},{}\n", lines[line].boundary, p.x, p.y, value.x, value.y);
    }
  }
  return text;
}

PointVectors read_point_table(const std::string& path, std::span<const GeometryLine> of_geometry,
                              const ComponentNames& components) {
  const PointsByPlace points = points_by_place(of_geometry);
  PointVectors values = zeros(of_geometry);
  std::set<const TablePoint*> told;
  std::istringstream lines(read_input(path));
  std::string line;
  std::optional<Columns> columns;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (is_no_line(line)) continue;
    const std::string place = fmt::format("{}:{}", path, number);
    if (!columns) {
      columns = columns_of(line, place, components);
      continue;
    }
    const PointRow row = row_of(line, *columns, place);
    const TablePoint& point = point_of(row, points, place);
    if (!told.insert(&point).second)
      throw InputError(fmt::format("{}: ({}, {}) has a row already; give each point once", place, row.place.x,
                                   row.place.y));
    values[point.line][point.number] = row.value;
  }
  if (told.empty())
    throw InputError(path + ": has no row of a point; give boundary,x,y," + components[0] + "," +
                     components[1] + " of each point that moves, below a line with these names");
  return values;
}

}  // namespace quadloop::io
