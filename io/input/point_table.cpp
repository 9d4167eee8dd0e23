#include "io/input/point_table.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

#include "io/files/reading/input_file.hpp"
#include "io/input/geometry_file.hpp"
#include "io/text/text_scanner.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

using Coordinates = std::pair<double, double>;

std::map<Coordinates, std::int32_t> vertices_by_place(const Geometry& outline) {
  std::map<Coordinates, std::int32_t> vertices;
  for (std::int32_t v = 0; v < outline.size(); ++v)
    vertices.emplace(Coordinates(outline.point(v).x, outline.point(v).y), v);
  return vertices;
}

/// The cells of a row, without blanks and quotes around them.
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

/// x, y and both components. Throws InputError.
std::array<double, 4> numbers_of(const std::string& line, const std::string& place) {
  const std::vector<std::string> cells = cells_of(line);
  std::array<double, 4> numbers{};
  bool good = cells.size() == numbers.size() + 1;
  for (std::size_t k = 0; good && k < numbers.size(); ++k)
    good = parse_real(cells[k + 1], numbers[k]) && std::isfinite(numbers[k]);
  if (good) return numbers;
  throw InputError(place +
                   ": is no row of a point: boundary, x, y and two numbers, with commas between them");
}

}  // namespace

std::string point_table(const Geometry& outline, const std::string& path, std::span<const Point> values,
                        const std::string& names) {
  std::map<Coordinates, std::int32_t> left = vertices_by_place(outline);
  std::string text = "boundary,x,y," + names + "\n";
  std::vector<std::string> told_already;
  for (const Chain& chain : read_geometry(path, told_already)) {
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

std::vector<Point> read_point_table(const std::string& path, const Geometry& outline) {
  const std::map<Coordinates, std::int32_t> vertices = vertices_by_place(outline);
  std::vector<Point> values(outline.size());
  std::vector<char> told(outline.size(), 0);
  std::istringstream lines(read_input(path));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (number == 1 || line.find_first_not_of(" \t\r") == std::string::npos || line.front() == '#') continue;
    const std::string place = fmt::format("{}:{}", path, number);
    const auto [x, y, first, second] = numbers_of(line, place);
    const auto vertex = vertices.find({x, y});
    if (vertex == vertices.end())
      throw InputError(
          fmt::format("{}: the outline has no point ({}, {}); give its points with all their digits, as "
                      "they stand in its file",
                      place, x, y));
    if (told[vertex->second] != 0)
      throw InputError(fmt::format("{}: ({}, {}) has a row already; give each point once", place, x, y));
    told[vertex->second] = 1;
    values[vertex->second] = {first, second};
  }
  return values;
}

}  // namespace quadloop
