#include "io/input/airfoil_dat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "io/input/line_reader.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

constexpr double blunt = 0.05;  ///< maximum thickness of a trailing edge, relative to the chord

double chord_of(const std::vector<Point>& rows) {
  Box box;
  for (const Point p : rows) box.include(p);
  return std::max(box.width(), box.height());
}

bool is_count(double value) {
  constexpr double most = 1e9;  // more points than any file contains
  return value >= 2 && value <= most && value == std::floor(value);
}

/// Two integers of at least 2 are the point counts of a Lednicer file, as coordinates are relative to the
/// chord.
bool are_counts(Point p) { return is_count(p.x) && is_count(p.y); }

/// A third column of zeros occurs in 3D files.
bool has_no_third(const LineReader& lines) {
  return lines.words().size() == 2 || (lines.words().size() == 3 && lines.is_number(2) && lines.real(2) == 0);
}

Point read_point(const LineReader& lines) {
  if (!has_no_third(lines)) {
    lines.refuse(fmt::format("'{}' should be two coordinates of the airfoil", fmt::join(lines.words(), " ")));
  }
  return {lines.real(0), lines.real(1)};
}

bool is_point(const LineReader& lines) {
  return has_no_third(lines) && lines.is_number(0) && lines.is_number(1);
}

/// A file without a name begins with a point; "2412 63" is nevertheless a name.
bool is_name(const LineReader& lines) {
  return !is_point(lines) || lines.row().find('.') == std::string_view::npos;
}

/// A row of words is a remark; one that begins with a number was meant to be a point. In the header a remark
/// may begin with a number.
bool is_remark(const LineReader& lines, bool in_head) {
  return !lines.is_number(0) || (in_head && lines.words().size() > 2 && !lines.is_number(1));
}

/// "999. 999." separates the elements of an airfoil with flaps or slats.
bool is_divider(Point p) { return p.x == p.y && p.x >= 999 && p.x < 1000; }

/// Whether the row is the second one of an MSES file, the box of its grid: XINL XOUTL YBOT YTOP.
bool is_grid_box(const LineReader& lines) {
  if (lines.words().size() != 4) return false;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!lines.is_number(i)) return false;
  }
  return true;
}

/// Rows that are not points of the airfoil.
struct PassedOver {
  std::int64_t count = 0, first_line = 0;
  std::string first_row;

  void add(const LineReader& lines) {
    if (count++ > 0) return;
    first_line = lines.line();
    const std::string_view last = lines.words().back();
    first_row = {lines.words().front().data(), last.data() + last.size()};
  }
};

/// The rows of one element: its points in order, preceded by the counts in a Lednicer file.
class AirfoilRows {
 public:
  /// Reads up to the row that separates elements, or to the end of the file. Text in the header other than
  /// the name, words between the surfaces, and rows after the last point are skipped.
  AirfoilRows(LineReader& lines, bool first) {
    if (first) read_head(lines);
    while (!divided_ && lines.next()) take(lines);
    if (rows_.empty() && !first) return;
    if (rows_.empty()) lines.refuse("the file ends here, but the coordinates are missing");
    if (counts_ && !agrees() && returns_to(*counts_)) {
      rows_.insert(rows_.begin(), *counts_);
      counts_.reset();
    }
    if (counts_ && !agrees()) {
      lines.refuse(fmt::format(
          "the file has {} points, but its header (Lednicer format) counts {} and {}; correct the counts, or "
          "complete the file",
          rows_.size(), counts_->x, counts_->y));
    }
  }

  std::vector<Point>& rows() { return rows_; }
  bool divided() const { return divided_; }  ///< another element may follow
  std::int64_t first_line() const { return first_line_; }
  std::optional<std::size_t> upper() const {
    return counts_ ? std::optional(static_cast<std::size_t>(counts_->x)) : std::nullopt;
  }

  void warn(const std::string& path, std::vector<std::string>& warnings) const {
    if (passed_.count == 0) return;
    warnings.push_back(fmt::format(
        "{}:{}: {} row{} beside the name that {} no point{} of the airfoil, the first '{}', {} ignored", path,
        passed_.first_line, passed_.count, passed_.count == 1 ? "" : "s", passed_.count == 1 ? "is" : "are",
        passed_.count == 1 ? "" : "s", passed_.first_row, passed_.count == 1 ? "was" : "were"));
  }

 private:
  void read_head(LineReader& lines) {
    lines.require_next("the airfoil's name");
    if (!is_name(lines)) return add_point(lines);
    if (lines.next() && !is_grid_box(lines)) take(lines);
  }

  void take(const LineReader& lines) {
    divided_ = is_point(lines) && is_divider(read_point(lines));
    if (divided_) return;
    const bool after_gap = lines.line() - last_point_line_ > usual_step_ || ended_;
    if (is_point(lines) && !(after_gap && is_whole())) return add_point(lines);
    if (!is_whole() && !is_remark(lines, rows_.empty() && !counts_)) read_point(lines);  // throws
    passed_.add(lines);
    ended_ = ended_ || is_whole();
  }

  void add_point(const LineReader& lines) {
    const Point p = read_point(lines);
    if (rows_.empty()) first_line_ = lines.line();
    if (rows_.size() == 1)
      usual_step_ = lines.line() - last_point_line_;  // some files have every other row blank
    last_point_line_ = lines.line();
    if (rows_.empty() && !counts_ && are_counts(p)) {
      counts_ = p;
    } else {
      rows_.push_back(p);
    }
  }

  std::size_t expected() const {
    return static_cast<std::size_t>(counts_->x) + static_cast<std::size_t>(counts_->y);
  }

  bool agrees() const { return rows_.size() == expected(); }

  /// Whether the last row is at p, up to a blunt trailing edge. Then two integers are the first point of a
  /// Selig file, such as one in millimetres, and not counts.
  bool returns_to(Point p) const { return length(rows_.back() - p) <= blunt * chord_of(rows_); }

  /// Whether the element is complete: as many points as counted in the header, or closed.
  bool is_whole() const {
    if (counts_) return rows_.size() >= expected();
    return rows_.size() >= 3 && length(rows_.back() - rows_.front()) <= blunt * chord_of(rows_);
  }

  std::optional<Point> counts_;
  std::vector<Point> rows_;
  PassedOver passed_;
  std::int64_t last_point_line_ = 0, usual_step_ = 1, first_line_ = 0;
  bool ended_ = false;    ///< what follows is not part of the airfoil
  bool divided_ = false;  ///< the last row is a separator
};

/// Two surfaces in the same direction between the edges, without counts.
struct TwoSurfaces {
  /// Index of the first point of the second surface; 0 if the file has one line around the airfoil.
  std::size_t second = 0;
  bool from_leading_edge = true;
};

/// Detected by the single step over most of the chord, back to the edge where the first surface began.
TwoSurfaces two_surfaces(const std::vector<Point>& rows) {
  constexpr double most = 0.8;
  TwoSurfaces found;
  if (rows.size() < 2) return found;
  const double chord = chord_of(rows);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double step = rows[i].x - rows[i - 1].x;
    if (std::abs(step) < most * chord) continue;
    if (found.second > 0 || length(rows[i] - rows.front()) > blunt * chord) return {};
    found = {i, step < 0};
  }
  return found;
}

/// Returns the points from the trailing edge along the upper side to the leading edge and back along the
/// lower side (Selig order).
std::vector<Point> around(const std::vector<Point>& rows, std::size_t upper) {
  std::vector<Point> points(rows.begin(), rows.begin() + upper);
  std::reverse(points.begin(), points.end());
  const std::size_t skip =
      upper < rows.size() && rows[upper] == rows.front() ? 1 : 0;  // the leading edge is in both lists
  points.insert(points.end(), rows.begin() + (upper + skip), rows.end());
  return points;
}

/// Determines only the direction; assemble() checks it exactly.
double area(const std::vector<Point>& points) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) sum += cross(points[i], points[(i + 1) % points.size()]);
  return 0.5 * sum;
}

/// The trailing edge may be blunt, even very blunt, but no airfoil is open over half of its chord: then one
/// side is missing, or the file has an extraneous point.
void check_gap(const std::vector<Point>& rows, const std::string& source,
               std::vector<std::string>& warnings) {
  if (rows.size() < 2) return;
  const double gap = length(rows.back() - rows.front());
  const double chord = chord_of(rows);
  if (gap <= blunt * chord) return;
  if (gap > 0.5 * chord)
    throw InputError(fmt::format(
        "{}: the airfoil's first and last point, ({}, {}) and ({}, {}), are {:.3g} apart, too far for a "
        "trailing edge; remove rows that are no points of the outline, or add the surface that is missing",
        source, rows.front().x, rows.front().y, rows.back().x, rows.back().y, gap));
  warnings.push_back(
      fmt::format("{}: the airfoil's first and last point, ({}, {}) and ({}, {}), are {:.3g} apart and were "
                  "joined by a straight line",
                  source, rows.front().x, rows.front().y, rows.back().x, rows.back().y, gap));
}

/// Returns the loop of one element, clockwise.
Chain chain_of(AirfoilRows& airfoil, const std::string& path, const std::string& source,
               std::vector<std::string>& warnings) {
  std::vector<Point> rows = std::move(airfoil.rows());
  airfoil.warn(path, warnings);
  if (airfoil.upper()) {
    rows = around(rows, *airfoil.upper());
  } else if (const auto [second, from_leading_edge] = two_surfaces(rows); second > 0) {
    warnings.push_back(
        fmt::format("{}: both surfaces run from the {} edge, though the header has no counts; point {} "
                    "begins the second",
                    path, from_leading_edge ? "leading" : "trailing", second + 1));
    if (!from_leading_edge) {
      std::reverse(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(second));
      std::reverse(rows.begin() + static_cast<std::ptrdiff_t>(second), rows.end());
    }
    rows = around(rows, second);
  }
  check_gap(rows, source, warnings);
  if (rows.size() > 1 && rows.front() == rows.back()) rows.pop_back();
  if (area(rows) > 0) std::reverse(rows.begin(), rows.end());
  return {"airfoil", false, std::move(rows), source, false};
}

}  // namespace

std::vector<Chain> read_airfoil(const std::string& path, std::vector<std::string>& warnings) {
  LineReader lines(path);
  std::vector<Chain> elements;
  bool more = true;
  while (more) {
    AirfoilRows rows(lines, elements.empty());
    more = rows.divided();
    if (rows.rows().empty()) continue;
    const std::int64_t line = elements.empty() ? 1 : rows.first_line();
    elements.push_back(chain_of(rows, path, fmt::format("{}:{}", path, line), warnings));
  }
  if (elements.size() == 1) return elements;
  for (std::size_t i = 0; i < elements.size(); ++i) elements[i].name += fmt::format("_{}", i + 1);
  return elements;
}

std::string airfoil_text(const std::string& title, std::span<const Point> points) {
  std::string text = title + "\n";
  for (const Point p : points) text += fmt::format("{} {}\n", p.x, p.y);
  return text;
}

}  // namespace quadloop::io
