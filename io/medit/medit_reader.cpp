#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "io/medit/medit_file.hpp"
#include "io/model/clean_up.hpp"

namespace quadloop::io {

namespace {

constexpr std::string_view medit_head = "MeshVersionFormatted";

class MeditReader {
 public:
  explicit MeditReader(const std::string& path) : scan_{path} {}

  MeshOfFile read() {
    mesh_.dimension = 2;
    if (scan_.token(medit_head) != medit_head) scan_.refuse("is no mesh of Medit");
    scan_.integer("the version of the format");
    while (!scan_.at_end()) {
      const std::string section(scan_.token(""));
      if (section == "End") break;
      read_section(section);
    }
    if (mesh_.points.empty())
      scan_.refuse_at(scan_.text().size(), "the file ends without Vertices; it is cut short, or no mesh");
    references_of_[0].insert(references_of_[0].end(), references_of_[1].begin(), references_of_[1].end());
    set_blocks(mesh_, references_of_[0]);
    drop_unused_nodes(mesh_, scan_.path());
    return plane_mesh(std::move(mesh_), scan_);
  }

 private:
  void read_section(const std::string& section) {
    if (section == "Dimension") {
      dimension_ = scan_.integer("the dimension");
      if (dimension_ != 2 && dimension_ != 3)
        scan_.refuse(fmt::format("a mesh of {} dimensions; there are 2 and 3", dimension_));
    } else if (section == "Vertices") {
      read_vertices();
    } else if (section == "Edges") {
      read_edges();
    } else if (section == "Triangles") {
      read_cells<CellKind::triangle, 3>("triangles");
    } else if (section == "Quadrilaterals") {
      read_cells<CellKind::quad, 4>("quadrilaterals");
    } else {
      pass_over(section);
    }
  }

  void read_vertices() {
    if (dimension_ == 0) scan_.refuse("Vertices without a Dimension before them");
    if (!mesh_.points.empty()) scan_.refuse("a second section Vertices; only one can be read");
    const std::size_t count = scan_.count("vertices", dimension_ + 1);
    mesh_.points.reserve(count);
    double first_z = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = scan_.real("an x coordinate"), y = scan_.real("a y coordinate");
      const double z = dimension_ == 3 ? scan_.real("a z coordinate") : 0;
      if (i == 0) first_z = z;
      if (z != first_z)
        scan_.refuse(
            fmt::format("vertex {} does not lie in the first one's plane z = constant; only plane "
                        "meshes can be read",
                        i + 1));
      scan_.integer("the reference of a vertex");
      mesh_.points.push_back({x, y, 0});
    }
  }

  template <std::size_t width>
  std::array<std::int32_t, width> row() {
    const std::int64_t points = std::ssize(mesh_.points);
    std::array<std::int32_t, width> nodes;
    for (std::int32_t& node : nodes) {
      const std::int64_t number = scan_.integer("the number of a vertex");
      if (number < 1 || number > points)
        scan_.refuse(fmt::format("vertex {} is none of the vertices 1 to {}", number, points));
      node = static_cast<std::int32_t>(number - 1);
    }
    return nodes;
  }

  void read_edges() {
    for (std::size_t left = scan_.count("edges", 3); left > 0; --left) {
      const auto [from, to] = row<2>();
      const std::size_t place = scan_.place();
      const std::int64_t reference = scan_.integer("the reference of an edge");
      FileBoundary& boundary = mesh_.boundaries[mesh_.boundary_named(fmt::format("boundary_{}", reference))];
      boundary.faces.push_back({from, to, FileBoundary::no_node, FileBoundary::no_node});
      boundary.places.push_back(place);
    }
  }

  template <CellKind kind, std::size_t width>
  void read_cells(const char* of) {
    for (std::size_t left = scan_.count(of, width + 1); left > 0; --left) {
      const std::array<std::int32_t, width> nodes = row<width>();
      const std::int64_t reference = scan_.integer("the reference of a cell");
      cells_of<kind>(mesh_).push_back(nodes);
      references_of_[kind == CellKind::quad ? 1 : 0].push_back(reference);
    }
  }

  void pass_over(const std::string& section) {
    for (const char* mesh3d : {"Tetrahedra", "Pyramids", "Prisms", "Hexahedra"}) {
      if (section == mesh3d && scan_.count("3D cells", 4) > 0)
        scan_.refuse("a mesh of three dimensions; of Medit's only plane ones can be read");
    }
    for (const char* curved : {"EdgesP2", "TrianglesP2", "QuadrilateralsQ2"}) {
      if (section == curved)
        scan_.refuse(section + ", of second order; only cells of first order can be read");
    }
    const bool is_word = (section[0] >= 'A' && section[0] <= 'Z') || (section[0] >= 'a' && section[0] <= 'z');
    if (!is_word)
      scan_.refuse("expected the name of a section, found \"" + section.substr(0, 40) +
                   "\"; a row too many, or a count too small");
    while (!scan_.at_end() && is_number_next()) scan_.token("");
  }

  bool is_number_next() {
    const std::size_t next = scan_.text().size() - scan_.bytes_left();
    const char c = scan_.text()[next];
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
  }

  TextScanner scan_;
  std::int64_t dimension_ = 0;
  FileMesh mesh_;
  std::array<std::vector<std::int64_t>, 2> references_of_;  ///< of the triangles and of the quads
};

}  // namespace

bool is_medit(const std::string& path) {
  std::ifstream file(path);
  std::string first;
  for (char c = 0; first.size() < medit_head.size() && file.get(c);) {
    if (first.empty() && (c == ' ' || (c >= '\t' && c <= '\r'))) continue;
    first += c;
  }
  return first == medit_head;
}

MeshOfFile read_medit(const std::string& path) { return MeditReader(path).read(); }

}  // namespace quadloop::io
