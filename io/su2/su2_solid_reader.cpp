#include "io/solid/block_collector.hpp"
#include "io/solid/vtk_cell.hpp"
#include "io/su2/su2_solid_file.hpp"
#include "io/su2/su2_text.hpp"
#include "io/text/name_index.hpp"

namespace quadloop {

namespace {

class Su2SolidReader {
 public:
  explicit Su2SolidReader(const std::string& path) : text_{path} {}

  std::optional<SolidMesh> read() {
    if (text_.dimension() != 3) return std::nullopt;
    for (std::size_t zone = 0; zone < text_.zones(); ++zone) {
      text_.go_to_zone(zone);
      block_ = blocks_.named(text_.zones() == 1 ? "domain" : "zone_" + std::to_string(zone + 1));
      read_zone();
    }
    blocks_.put_into(mesh_);
    mesh_.warnings = text_.warnings();
    return std::move(mesh_);
  }

 private:
  /// Zones keep their own nodes, also where they touch; markers of one name are one patch.
  void read_zone() {
    if (text_.dimension() != 3) text_.scan().refuse("a zone of other dimensions than the first");
    text_.read_points(
        3, [&](std::size_t count) { mesh_.points.reserve(mesh_.points.size() + count); },
        [&](const double* p) {
          mesh_.points.push_back({p[0], p[1], p[2]});
        });
    read_elements();
    blocks_.take(mesh_, block_);
    text_.read_markers([&](std::size_t key, const std::string& name) { read_marker(key, name); });
  }

  template <std::size_t width>
  void add(std::vector<std::array<std::int32_t, width>>& cells) {
    std::array<std::int32_t, width>& cell = cells.emplace_back();
    for (std::int32_t& node : cell) node = text_.node_in_row();
    if constexpr (width == 6) cell = vtk_wedge_order(cell);
    text_.end_row();
  }

  void read_elements() {
    const std::size_t key = text_.find_one("NELEM");
    const std::size_t count = text_.count_of(key, "elements", 5);
    text_.end_of_key_line();
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t type = text_.scan().integer("the type of an element");
      switch (type) {
        case vtk_tetrahedron: add(mesh_.tetrahedra); break;
        case vtk_hexahedron: add(mesh_.hexahedra); break;
        case vtk_wedge: add(mesh_.prisms); break;
        case vtk_pyramid: add(mesh_.pyramids); break;
        default:
          text_.scan().refuse("an element of type " + vtk_cell_name(type) +
                              "; only 10 (tetrahedron), 12 (hexahedron), 13 (prism) and 14 (pyramid) can be "
                              "read of three dimensions");
      }
    }
    text_.check_rows_end_before(key + 1);
  }

  void read_marker(std::size_t key, const std::string& name) {
    const std::size_t count = text_.count_of(key, "faces of marker " + name, 4);
    text_.end_of_key_line();
    SolidPatch& patch = patch_named(name);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t type = text_.scan().integer("the type of a face");
      if (type != vtk_triangle && type != vtk_quad)
        text_.scan().refuse("marker " + name + " has an element of type " + vtk_cell_name(type) +
                            "; only 5 (triangle) and 9 (quadrilateral) can be read");
      SolidPatch::Face& face = patch.faces.emplace_back();
      face.fill(SolidPatch::no_node);
      for (std::size_t k = 0; k < (type == vtk_triangle ? 3 : 4); ++k) face[k] = text_.node_in_row();
      text_.end_row();
    }
    text_.check_rows_end_before(key + 1);
  }

  SolidPatch& patch_named(const std::string& name) {
    const auto [number, is_new] = patch_names_.entry_of(name);
    if (is_new) mesh_.patches.push_back({name, "none", {}});
    return mesh_.patches[number];
  }

  Su2Text text_;
  SolidMesh mesh_;
  NameIndex patch_names_;
  BlockCollector blocks_;
  std::int32_t block_ = 0;  ///< of the zone that is read
};

}  // namespace

std::optional<SolidMesh> read_su2_solid(const std::string& path) { return Su2SolidReader(path).read(); }

}  // namespace quadloop
