#include "io/loaded/foreign_mesh.hpp"
#include "io/loaded/matching_sides.hpp"
#include "io/solid/vtk_cell.hpp"
#include "io/su2/su2_file.hpp"
#include "io/su2/su2_text.hpp"

namespace quadloop {

namespace {

class Su2Reader {
 public:
  explicit Su2Reader(const std::string& path) : text_{path} {}

  LoadedMesh read() {
    for (std::size_t zone = 0; zone < text_.zones(); ++zone) {
      text_.go_to_zone(zone);
      read_zone(text_.zones() == 1 ? "domain" : "zone_" + std::to_string(zone + 1));
    }
    foreign_.loaded.warnings = text_.warnings();
    LoadedMesh loaded = finish(std::move(foreign_), text_.scan());
    // The configuration alone says which sides are periodic.
    loaded.periodic_nodes = nodes_of_matching_sides(loaded.mesh);
    return loaded;
  }

 private:
  /// Zones keep their own nodes and markers, also where they touch.
  void read_zone(const std::string& block) {
    const std::int64_t dimension = text_.dimension();
    if (dimension != 2)
      text_.scan().refuse("the mesh has " + std::to_string(dimension) + " dimensions; only 2 can be read");
    auto& points = foreign_.loaded.mesh.points;
    text_.read_points(
        2, [&](std::size_t count) { points.reserve(points.size() + count); },
        [&](const double* p) {
          points.push_back({p[0], p[1]});
        });
    read_elements(foreign_.block_named(block));
    text_.read_markers([&](std::size_t key, const std::string& name) { read_marker(key, name); });
  }

  template <std::size_t width>
  std::array<NodeId, width> nodes_in_row() {
    std::array<NodeId, width> nodes;
    for (NodeId& node : nodes) node = NodeId{text_.node_in_row()};
    text_.end_row();
    return nodes;
  }

  void read_elements(std::int32_t block) {
    TextScanner& scan = text_.scan();
    const std::size_t key = text_.find_one("NELEM");
    const std::size_t count = text_.count_of(key, "elements", 4);
    text_.end_of_key_line();
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t type = scan.integer("the type of an element");
      if (type == vtk_triangle) {
        foreign_.add_triangle(nodes_in_row<3>(), block);
      } else if (type == vtk_quad) {
        foreign_.add_quad(nodes_in_row<4>(), block);
      } else {
        scan.refuse("an element of type " + vtk_cell_name(type) +
                    "; only 5 (triangle) and 9 (quadrilateral) can be read");
      }
    }
    text_.check_rows_end_before(key + 1);
  }

  void read_marker(std::size_t key, const std::string& name) {
    TextScanner& scan = text_.scan();
    const std::size_t count = text_.count_of(key, "edges of marker " + name, 3);
    text_.end_of_key_line();
    const std::int32_t boundary = foreign_.boundary_named(name);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t type = scan.integer("the type of an edge");
      const std::size_t place = scan.place();
      if (type != vtk_line)
        scan.refuse("marker " + name + " has an element of type " + vtk_cell_name(type) +
                    "; only 3 (line) can be read");
      foreign_.edges.push_back({nodes_in_row<2>(), boundary, place});
    }
    text_.check_rows_end_before(key + 1);
  }

  Su2Text text_;
  ForeignMesh foreign_;
};

}  // namespace

LoadedMesh read_su2(const std::string& path) { return Su2Reader(path).read(); }

}  // namespace quadloop
