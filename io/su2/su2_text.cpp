#include "io/su2/su2_text.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace quadloop::io {

namespace {

std::string_view without_blanks_around(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string_view::npos ? std::string_view() : text.substr(first, last - first + 1);
}

}  // namespace

Su2Text::Su2Text(const std::string& path) : scan_{path, '%'} {
  find_keys();
  find_zones();
}

/// Keys may be in any order, so their lines are found first: those where "=" follows.
void Su2Text::find_keys() {
  const std::string_view text = scan_.text();
  std::size_t line_end = 0;
  for (std::size_t equals = text.find('='); equals != std::string_view::npos;
       equals = text.find('=', line_end)) {
    const std::size_t before = text.rfind('\n', equals);
    const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
    line_end = std::min(text.find('\n', equals), text.size());
    const std::string_view key = without_blanks_around(text.substr(begin, equals - begin));
    if (key.find('%') == std::string_view::npos) keys_.push_back({std::string(key), begin, equals + 1});
  }
  if (keys_.empty()) scan_.refuse("is no SU2 mesh: no line \"NDIME= 2\" is in it");
  check_rows_end_before(0);
}

/// Each zone begins with its IZONE, after the header; a file without is one zone.
void Su2Text::find_zones() {
  for (std::size_t key = 0; key < keys_.size(); ++key) {
    if (keys_[key].key == "IZONE") zone_begins_.push_back(key);
  }
  const std::size_t found = std::max<std::size_t>(zone_begins_.size(), 1);
  if (zone_begins_.empty()) zone_begins_.push_back(0);
  zone_begins_.push_back(keys_.size());
  const auto head = std::ranges::find(keys_, "NZONE", &Su2Key::key);
  if (head == keys_.end()) return;
  const std::int64_t count = number_of(head - keys_.begin(), "the number of zones");
  if (count != static_cast<std::int64_t>(found))
    scan_.refuse("the file has " + std::to_string(found) + (found == 1 ? " zone" : " zones") +
                 " (IZONE=), not " + std::to_string(count));
}

void Su2Text::go_to_zone(std::size_t zone) {
  zone_ = zone;
  first_point_ += std::exchange(points_, 0);
}

std::string Su2Text::name_of_zone() const {
  const std::size_t key = zone_begin();
  const std::size_t end = key + 1 < keys_.size() ? keys_[key + 1].begin : scan_.text().size();
  const std::string_view head = scan_.text().substr(keys_[key].begin, end - keys_[key].begin);
  const std::size_t found = head.find(std::string("\n") + su2_block_comment);
  if (found == std::string_view::npos) return {};
  const std::size_t begin = found + 1 + std::string_view(su2_block_comment).size();
  return std::string(without_blanks_around(head.substr(begin, head.find('\n', begin) - begin)));
}

std::size_t Su2Text::end_of_zone() const {
  return zone_end() == keys_.size() ? scan_.text().size() : keys_[zone_end()].begin;
}

std::int64_t Su2Text::dimension() { return number_of(find_one("NDIME"), "the dimension"); }

std::size_t Su2Text::find(const std::string& key) const {
  std::size_t found = keys_.size();
  for (std::size_t k = zone_begin(); k < zone_end(); ++k) {
    if (keys_[k].key != key) continue;
    if (found < keys_.size()) scan_.refuse_at(keys_[k].begin, key + "= stands in the file a second time");
    found = k;
  }
  return found;
}

std::size_t Su2Text::find_one(const std::string& key) const {
  const std::size_t found = find(key);
  if (found == keys_.size())
    scan_.refuse_at(end_of_zone(), std::string(zones() == 1 ? "the file" : "a zone") + " ends without " +
                                       key + "=; it is cut short, or no SU2 mesh");
  return found;
}

void Su2Text::go_to_value(std::size_t key, const std::string& expected) {
  scan_.go_to(keys_[key].value);
  if (scan_.at_line_end()) scan_.refuse("after " + keys_[key].key + "= should follow " + expected);
}

std::int64_t Su2Text::number_of(std::size_t key, const std::string& expected) {
  go_to_value(key, expected);
  return scan_.integer(expected);
}

std::size_t Su2Text::count_of(std::size_t key, const std::string& of, std::size_t width) {
  go_to_value(key, "the number of " + of);
  return scan_.count(of, width);
}

void Su2Text::end_of_key_line() {
  if (!scan_.at_line_end())
    scan_.refuse("text after the number: \"" + std::string(scan_.rest_of_line().substr(0, 40)) + "\"");
}

void Su2Text::read_points(std::size_t dimension, const std::function<void(std::size_t)>& begin,
                          const std::function<void(const double*)>& put) {
  constexpr std::array names{"an x coordinate", "a y coordinate", "a z coordinate"};
  const std::size_t key = find_one("NPOIN");
  const std::size_t count = count_of(key, "points", dimension);
  if (!scan_.at_line_end()) scan_.integer("the number of points without copies");
  end_of_key_line();
  begin(count);
  points_ = static_cast<std::int64_t>(count);
  std::array<double, 3> p{};
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < dimension; ++k) {
      if (k > 0) expect_in_row(names[k]);
      p[k] = scan_.real(names[k]);
    }
    pass_over_rest_of_point();
    put(p.data());
  }
  check_rows_end_before(key + 1);
}

/// SU2 takes the first numbers of the row; usually the point's number follows.
void Su2Text::pass_over_rest_of_point() {
  if (scan_.at_line_end()) return;
  const std::string_view rest = scan_.rest_of_line();
  if (rest.find_first_not_of("0123456789 \t\r") == std::string_view::npos) return;
  if (odd_rows_++ == 0) first_odd_row_ = scan_.place();
}

/// A row is one line: a missing number is not taken from the next line.
void Su2Text::expect_in_row(const std::string& expected) {
  if (!scan_.at_line_end()) return;
  scan_.refuse((scan_.at_end() ? "the file ends where " : "this line ends where ") + expected +
               " should follow");
}

std::int32_t Su2Text::node_in_row() {
  expect_in_row("a point of this element");
  const std::int64_t number = scan_.integer("a point of this element");
  if (number < 0 || number >= points_) {
    scan_.refuse("point " + std::to_string(number) + " is none of the points 0 to " +
                 std::to_string(points_ - 1));
  }
  return static_cast<std::int32_t>(first_point_ + number);
}

void Su2Text::end_row() {
  if (!scan_.at_line_end()) scan_.integer("the row's own number");
  if (!scan_.at_line_end()) scan_.refuse("too many numbers in this row");
}

void Su2Text::check_rows_end_before(std::size_t next) {
  if (scan_.at_end()) return;
  const std::string found(scan_.token("").substr(0, 40));
  if (next < keys_.size() && scan_.place() >= keys_[next].begin) return;
  scan_.refuse("expected a line \"KEY= value\", found \"" + found +
               "\"; a row too many, or a count too small");
}

/// MARKER_ELEMS belongs to the preceding MARKER_TAG.
void Su2Text::read_markers(const std::function<void(std::size_t, const std::string&)>& read) {
  std::size_t tags = 0;
  std::string name;
  for (std::size_t key = zone_begin(); key < zone_end(); ++key) {
    if (keys_[key].key == "MARKER_TAG") {
      if (!name.empty()) scan_.refuse_at(keys_[key].begin, "marker " + name + " has no MARKER_ELEMS=");
      go_to_value(key, "the marker's name");
      name = scan_.rest_of_line();
      ++tags;
    } else if (keys_[key].key == "MARKER_ELEMS") {
      if (name.empty())
        scan_.refuse_at(keys_[key].begin, "MARKER_ELEMS= stands without a MARKER_TAG= before it");
      if (name == "SEND_RECEIVE") {
        ++passed_markers_;
      } else {
        read(key, name);
      }
      name.clear();
    }
  }
  if (!name.empty()) scan_.refuse_at(end_of_zone(), "the file ends without MARKER_ELEMS= for marker " + name);
  check_marker_count(tags);
}

void Su2Text::check_marker_count(std::size_t tags) {
  const std::size_t key = find("NMARK");
  if (key == keys_.size() && tags == 0) return;
  const std::int64_t count = number_of(find_one("NMARK"), "the number of markers");
  if (count != static_cast<std::int64_t>(tags)) {
    scan_.refuse("the file has " + std::to_string(tags) + " markers (MARKER_TAG=), not " +
                 std::to_string(count));
  }
}

std::vector<std::string> Su2Text::warnings() const {
  std::vector<std::string> lines;
  if (odd_rows_ > 0)
    lines.push_back(
        scan_.place_text(first_odd_row_) + ": " + std::to_string(odd_rows_) +
        " rows of points have more behind their coordinates than a number of the point, here first; "
        "as in SU2 it is ignored");
  if (passed_markers_ > 0)
    lines.push_back(scan_.path() + ": " + std::to_string(passed_markers_) +
                    " markers SEND_RECEIVE are left out: they connect ranks and are no boundaries");
  return lines;
}

}  // namespace quadloop::io
