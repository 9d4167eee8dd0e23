#include "io/input/airfoil_dat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/input/line_reader.hpp"

namespace quadloop {

namespace {

/// Two whole numbers from 2 on can only be the counts of a Lednicer file: coordinates are shares of the chord.
bool are_counts(Point p) { return p.x >= 2 && p.y >= 2 && p.x == std::floor(p.x) && p.y == std::floor(p.y); }

Point read_point(const LineReader& lines) {
  if (lines.words().size() != 2) {
    lines.refuse(fmt::format("'{}' should be two coordinates of the airfoil", fmt::join(lines.words(), " ")));
  }
  return {lines.real(0), lines.real(1)};
}

/// A file without a name begins with a point; "2412 63" is a name all the same.
bool is_name(const LineReader& lines) {
  return lines.words().size() != 2 || !lines.is_number(0) || !lines.is_number(1) || lines.row().find('.') == std::string_view::npos;
}

/// From the trailing edge over the upper side to the leading edge and back along the lower one, as Selig has it.
std::vector<Point> around(const std::vector<Point>& rows, std::size_t upper) {
  std::vector<Point> points(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(upper));
  std::reverse(points.begin(), points.end());
  const std::size_t skip = upper < rows.size() && rows[upper] == rows.front() ? 1 : 0;  // the leading edge stands in both lists
  points.insert(points.end(), rows.begin() + static_cast<std::ptrdiff_t>(upper + skip), rows.end());
  return points;
}

/// Only says which way to walk; assemble() decides exactly.
double area(const std::vector<Point>& points) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) sum += cross(points[i], points[(i + 1) % points.size()]);
  return 0.5 * sum;
}

/// The trailing edge may be blunt, but a file with one side alone is not to pass in silence.
void warn_of_gap(const std::vector<Point>& rows, const std::string& source, std::vector<std::string>& warnings) {
  constexpr double blunt = 0.05;  // of the chord
  if (rows.size() < 2) return;
  Box box;
  for (const Point p : rows) box.include(p);
  const double gap = length(rows.back() - rows.front());
  if (gap <= blunt * std::max(box.width(), box.height())) return;
  warnings.push_back(fmt::format("{}: the airfoil's first and last point, ({}, {}) and ({}, {}), are {:.3g} apart and were joined by a straight line",
                                 source, rows.front().x, rows.front().y, rows.back().x, rows.back().y, gap));
}

}  // namespace

std::vector<Chain> read_airfoil(const std::string& path, std::vector<std::string>& warnings) {
  LineReader lines(path);
  lines.require_next("the airfoil's name");
  std::vector<Point> rows;
  const std::string source = lines.place();
  if (!is_name(lines)) rows.push_back(read_point(lines));
  while (lines.next()) rows.push_back(read_point(lines));
  if (rows.empty()) lines.refuse("the file ends here, but the coordinates are missing");
  if (are_counts(rows.front())) {
    const Point counts = rows.front();
    rows.erase(rows.begin());
    if (counts.x + counts.y != static_cast<double>(rows.size())) {
      lines.refuse(fmt::format("the file has {} points, but its head says {} and {}; correct the counts, or complete the file", rows.size(), counts.x,
                               counts.y));
    }
    rows = around(rows, static_cast<std::size_t>(counts.x));
  }
  if (rows.size() > 1 && rows.front() == rows.back()) rows.pop_back();
  warn_of_gap(rows, source, warnings);
  if (area(rows) > 0) std::reverse(rows.begin(), rows.end());
  return {Chain{"airfoil", false, std::move(rows), source}};
}

}  // namespace quadloop
