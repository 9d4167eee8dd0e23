#include <algorithm>

#include "io/loaded/foreign_mesh.hpp"
#include "io/su2/su2_file.hpp"
#include "io/text/text_scanner.hpp"

namespace quadloop {

namespace {

/// A line "KEY= value", by places in the text; the rows of the key follow it.
struct KeyLine {
  std::string key;
  std::size_t begin = 0, value = 0;
};

std::string_view without_blanks_around(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string_view::npos ? std::string_view() : text.substr(first, last - first + 1);
}

std::string element_name(std::int64_t vtk_type) {
  switch (vtk_type) {
    case 1: return "1 (vertex)";
    case 3: return "3 (line)";
    case 5: return "5 (triangle)";
    case 9: return "9 (quadrilateral)";
    case 10: return "10 (tetrahedron)";
    case 12: return "12 (hexahedron)";
    case 13: return "13 (prism)";
    case 14: return "14 (pyramid)";
    default: return std::to_string(vtk_type);
  }
}

class Su2Reader {
 public:
  explicit Su2Reader(const std::string& path) : scan_{path, '%'} {}

  LoadedMesh read() {
    find_keys();
    check_head();
    read_points();
    read_elements();
    read_markers();
    return finish(std::move(foreign_), scan_);
  }

 private:
  /// The keys may stand in any order, so that their lines are found first: those where a "=" follows.
  void find_keys() {
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

  void check_head() {
    const std::size_t zones = find("NZONE");
    if (zones < keys_.size() && number_of(zones, "the number of zones") != 1)
      scan_.refuse("a file of several zones; only one can be read");
    const std::int64_t dimension = number_of(find_one("NDIME"), "the dimension");
    if (dimension != 2)
      scan_.refuse("the mesh has " + std::to_string(dimension) + " dimensions; only 2 can be read");
  }

  /// The line of a key; keys_.size() where the file has none.
  std::size_t find(const std::string& key) const {
    std::size_t found = keys_.size();
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      if (keys_[k].key != key) continue;
      if (found < keys_.size()) scan_.refuse_at(keys_[k].begin, key + "= stands in the file a second time");
      found = k;
    }
    return found;
  }

  std::size_t find_one(const std::string& key) const {
    const std::size_t found = find(key);
    if (found == keys_.size())
      scan_.refuse_at(scan_.text().size(),
                      "the file ends without " + key + "=; it is cut short, or no SU2 mesh");
    return found;
  }

  void go_to_value(std::size_t key, const std::string& expected) {
    scan_.go_to(keys_[key].value);
    if (scan_.at_line_end()) scan_.refuse("after " + keys_[key].key + "= should follow " + expected);
  }

  std::int64_t number_of(std::size_t key, const std::string& expected) {
    go_to_value(key, expected);
    return scan_.integer(expected);
  }

  std::size_t count_of(std::size_t key, const std::string& of, std::size_t width) {
    go_to_value(key, "the number of " + of);
    return scan_.count(of, width);
  }

  /// A row is one line: a number that is missing is not taken from the next.
  void expect_in_row(const std::string& expected) {
    if (!scan_.at_line_end()) return;
    scan_.refuse((scan_.at_end() ? "the file ends where " : "this line ends where ") + expected +
                 " should follow");
  }

  /// A row may end with its own number, which says nothing new.
  void end_row() {
    if (!scan_.at_line_end()) scan_.integer("the row's own number");
    if (!scan_.at_line_end()) scan_.refuse("too many numbers in this row");
  }

  /// After the rows of a key comes the next key, or the end.
  void check_rows_end_before(std::size_t next) {
    if (scan_.at_end()) return;
    const std::string found(scan_.token("").substr(0, 40));
    if (next < keys_.size() && scan_.place() >= keys_[next].begin) return;
    scan_.refuse("expected a line \"KEY= value\", found \"" + found +
                 "\"; a row too many, or a count too small");
  }

  void read_points() {
    const std::size_t key = find_one("NPOIN");
    auto& points = foreign_.loaded.mesh.points;
    const std::size_t count = count_of(key, "points", 2);
    if (!scan_.at_line_end()) scan_.integer("the number of points without copies");
    end_of_key_line();
    points.resize(count);
    for (Point& p : points) {
      p.x = scan_.real("an x coordinate");
      expect_in_row("a y coordinate");
      p.y = scan_.real("a y coordinate");
      end_row();
    }
    check_rows_end_before(key + 1);
  }

  void end_of_key_line() {
    if (!scan_.at_line_end())
      scan_.refuse("text after the number: \"" + std::string(scan_.rest_of_line().substr(0, 40)) + "\"");
  }

  NodeId node_in_row() {
    expect_in_row("a point of this element");
    const std::int64_t number = scan_.integer("a point of this element");
    const auto points = std::ssize(foreign_.loaded.mesh.points);
    if (number < 0 || number >= points) {
      scan_.refuse("point " + std::to_string(number) + " is none of the points 0 to " +
                   std::to_string(points - 1));
    }
    return NodeId{static_cast<std::int32_t>(number)};
  }

  template <std::size_t width>
  std::array<NodeId, width> nodes_in_row() {
    std::array<NodeId, width> nodes;
    for (NodeId& node : nodes) node = node_in_row();
    end_row();
    return nodes;
  }

  void read_elements() {
    const std::size_t key = find_one("NELEM");
    const std::size_t count = count_of(key, "elements", 4);
    end_of_key_line();
    const std::int32_t block = foreign_.block_named("domain");
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t type = scan_.integer("the type of an element");
      if (type == 5) {
        foreign_.add_triangle(nodes_in_row<3>(), block);
      } else if (type == 9) {
        foreign_.add_quad(nodes_in_row<4>(), block);
      } else {
        scan_.refuse("an element of type " + element_name(type) +
                     "; only 5 (triangle) and 9 (quadrilateral) can be read");
      }
    }
    check_rows_end_before(key + 1);
  }

  /// MARKER_ELEMS belongs to the MARKER_TAG before it.
  void read_markers() {
    std::size_t tags = 0;
    std::string name;
    for (std::size_t key = 0; key < keys_.size(); ++key) {
      if (keys_[key].key == "MARKER_TAG") {
        if (!name.empty()) scan_.refuse_at(keys_[key].begin, "marker " + name + " has no MARKER_ELEMS=");
        go_to_value(key, "the marker's name");
        name = scan_.rest_of_line();
        ++tags;
      } else if (keys_[key].key == "MARKER_ELEMS") {
        if (name.empty())
          scan_.refuse_at(keys_[key].begin, "MARKER_ELEMS= stands without a MARKER_TAG= before it");
        read_marker(key, name);
        name.clear();
      }
    }
    if (!name.empty())
      scan_.refuse_at(scan_.text().size(), "the file ends without MARKER_ELEMS= for marker " + name);
    check_marker_count(tags);
  }

  void check_marker_count(std::size_t tags) {
    const std::size_t key = find("NMARK");
    if (key == keys_.size() && tags == 0) return;
    const std::int64_t count = number_of(find_one("NMARK"), "the number of markers");
    if (count != static_cast<std::int64_t>(tags)) {
      scan_.refuse("the file has " + std::to_string(tags) + " markers (MARKER_TAG=), not " +
                   std::to_string(count));
    }
  }

  void read_marker(std::size_t key, const std::string& name) {
    const std::size_t count = count_of(key, "edges of marker " + name, 3);
    end_of_key_line();
    const std::int32_t boundary = foreign_.boundary_named(name);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t type = scan_.integer("the type of an edge");
      const std::size_t place = scan_.place();
      if (type != 3)
        scan_.refuse("marker " + name + " has an element of type " + element_name(type) +
                     "; only 3 (line) can be read");
      foreign_.edges.push_back({nodes_in_row<2>(), boundary, place});
    }
    check_rows_end_before(key + 1);
  }

  TextScanner scan_;
  std::vector<KeyLine> keys_;
  ForeignMesh foreign_;
};

}  // namespace

LoadedMesh read_su2(const std::string& path) { return Su2Reader(path).read(); }

}  // namespace quadloop
