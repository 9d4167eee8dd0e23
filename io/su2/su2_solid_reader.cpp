#include "io/su2/su2_solid_file.hpp"
#include "io/su2/su2_text.hpp"

namespace quadloop {

namespace {

class Su2SolidReader {
 public:
  explicit Su2SolidReader(const std::string& path) : text_{path} {}

  std::optional<SolidMesh> read() {
    if (text_.dimension() != 3) return std::nullopt;
    text_.read_points(
        3, [&](std::size_t count) { mesh_.points.reserve(count); },
        [&](const double* p) {
          mesh_.points.push_back({p[0], p[1], p[2]});
        });
    read_elements();
    text_.read_markers([&](std::size_t key, const std::string& name) { read_marker(key, name); });
    return std::move(mesh_);
  }

 private:
  template <std::size_t width>
  void add(std::vector<std::array<std::int32_t, width>>& cells) {
    for (std::int32_t& node : cells.emplace_back()) node = text_.node_in_row();
    text_.end_row();
  }

  void read_elements() {
    const std::size_t key = text_.find_one("NELEM");
    const std::size_t count = text_.count_of(key, "elements", 5);
    text_.end_of_key_line();
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t type = text_.scan().integer("the type of an element");
      switch (type) {
        case 10: add(mesh_.tetrahedra); break;
        case 12: add(mesh_.hexahedra); break;
        case 13: add(mesh_.prisms); break;
        case 14: add(mesh_.pyramids); break;
        default:
          text_.scan().refuse("an element of type " + su2_element_name(type) +
                              "; only 10 (tetrahedron), 12 (hexahedron), 13 (prism) and 14 (pyramid) can be "
                              "read of three dimensions");
      }
    }
    text_.check_rows_end_before(key + 1);
  }

  void read_marker(std::size_t key, const std::string& name) {
    const std::size_t count = text_.count_of(key, "faces of marker " + name, 4);
    text_.end_of_key_line();
    SolidPatch& patch = mesh_.patches.emplace_back();
    patch.name = name;
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t type = text_.scan().integer("the type of a face");
      if (type != 5 && type != 9)
        text_.scan().refuse("marker " + name + " has an element of type " + su2_element_name(type) +
                            "; only 5 (triangle) and 9 (quadrilateral) can be read");
      SolidPatch::Face& face = patch.faces.emplace_back();
      face.fill(SolidPatch::no_node);
      for (std::size_t k = 0; k < (type == 5 ? 3 : 4); ++k) face[k] = text_.node_in_row();
      text_.end_row();
    }
    text_.check_rows_end_before(key + 1);
  }

  Su2Text text_;
  SolidMesh mesh_;
};

}  // namespace

std::optional<SolidMesh> read_su2_solid(const std::string& path) { return Su2SolidReader(path).read(); }

}  // namespace quadloop
