#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

#include "io/model/clean_up.hpp"
#include "io/model/matching_sides.hpp"
#include "io/stream/vtk_cell.hpp"
#include "io/su2/su2_file.hpp"
#include "io/su2/su2_text.hpp"

namespace quadloop::io {

namespace {

class Su2Reader {
 public:
  explicit Su2Reader(const std::string& path) : text_{path} {}

  MeshOfFile read() {
    const std::int64_t dimension = text_.dimension();
    if (dimension != 2 && dimension != 3)
      text_.scan().refuse(fmt::format("the mesh has {} dimensions; 2 and 3 can be read", dimension));
    mesh_.dimension = static_cast<std::int32_t>(dimension);
    for (std::size_t zone = 0; zone < text_.zones(); ++zone) {
      text_.go_to_zone(zone);
      first_nodes_.push_back(mesh_.points.size());
      const std::string name = text_.name_of_zone();
      read_zone(!name.empty() ? name : text_.zones() == 1 ? "domain" : "zone_" + std::to_string(zone + 1));
    }
    const bool conforming = has_common_faces();
    if (conforming) unite_nodes(mesh_, first_nodes_, links_of_common_faces());
    if (conforming && !is_plane()) drop_inner_faces(mesh_);
    mesh_.warnings = text_.warnings();
    if (is_plane()) return read_plane();
    drop_empty_groups(mesh_);
    return std::move(mesh_);
  }

 private:
  bool is_plane() const { return mesh_.dimension == 2; }

  LoadedMesh read_plane() {
    LoadedMesh loaded = plane_mesh(std::move(mesh_), text_.scan());
    keep_first_mentions(loaded);
    // Periodic sides are specified only in the configuration.
    loaded.periodic_nodes = nodes_of_matching_sides(loaded.mesh);
    return loaded;
  }

  /// Whether there is a marker of two zones with all of its faces at the same places in both, as between the
  /// zones of one mesh. Zones of other files keep their own nodes, even where they touch.
  bool has_common_faces() const {
    if (first_nodes_.size() < 2) return false;
    return std::ranges::any_of(mesh_.boundaries, [&](const FileBoundary& boundary) {
      std::map<std::vector<Place>, std::set<std::size_t>> zones;
      for (const FileBoundary::Face& face : boundary.faces) zones[places_of(face)].insert(zone_of(face[0]));
      return !zones.empty() &&
             std::ranges::all_of(zones, [](const auto& at) { return at.second.size() == 2; });
    });
  }

  /// Links the nodes of each face that a marker has in two zones. At the sides of a baffle that crosses the
  /// boundary between two zones, positions alone do not tell which nodes are equal.
  NodeLinks links_of_common_faces() const {
    NodeLinks links;
    for (const FileBoundary& boundary : mesh_.boundaries) {
      std::map<std::vector<Place>, std::vector<std::int32_t>> first_at;
      for (const FileBoundary::Face& face : boundary.faces) {
        const std::vector<std::int32_t> nodes = nodes_by_place(face);
        const std::vector<std::int32_t>& first = first_at.emplace(places_of(face), nodes).first->second;
        if (zone_of(first[0]) == zone_of(nodes[0])) continue;
        for (std::size_t k = 0; k < nodes.size(); ++k) links.nodes.push_back({first[k], nodes[k]});
      }
    }
    return links;
  }

  using Place = std::tuple<double, double, double>;
  Place place_of(std::int32_t node) const {
    const Point3 p = mesh_.points[node];
    return {p.x, p.y, p.z};
  }
  /// The nodes of a face in the order of their places.
  std::vector<std::int32_t> nodes_by_place(const FileBoundary::Face& face) const {
    std::vector<std::int32_t> nodes;
    std::ranges::copy_if(face, std::back_inserter(nodes),
                         [](std::int32_t node) { return node != FileBoundary::no_node; });
    std::ranges::sort(nodes, {}, [&](std::int32_t node) { return place_of(node); });
    return nodes;
  }
  std::vector<Place> places_of(const FileBoundary::Face& face) const {
    std::vector<Place> places;
    for (const std::int32_t node : nodes_by_place(face)) places.push_back(place_of(node));
    return places;
  }
  std::size_t zone_of(std::size_t node) const {
    return std::ranges::upper_bound(first_nodes_, node) - first_nodes_.begin();
  }

  /// Markers of the same name form one boundary.
  void read_zone(const std::string& block) {
    if (text_.dimension() != mesh_.dimension)
      text_.scan().refuse("a zone of other dimensions than the first");
    text_.read_points(
        mesh_.dimension, [&](std::size_t count) { mesh_.points.reserve(mesh_.points.size() + count); },
        [&](const double* p) {
          mesh_.points.push_back({p[0], p[1], is_plane() ? 0 : p[2]});
        });
    read_elements(mesh_.block_named(block));
    text_.read_markers([&](std::size_t key, const std::string& name) { read_marker(key, name); });
  }

  template <std::size_t width>
  std::array<std::int32_t, width> nodes_in_row() {
    std::array<std::int32_t, width> nodes;
    for (std::int32_t& node : nodes) node = text_.node_in_row();
    text_.end_row();
    return nodes;
  }

  void read_elements(std::int32_t block) {
    const std::size_t key = text_.find_one("NELEM");
    const std::size_t count = text_.count_of(key, "elements", is_plane() ? 4 : 5);
    text_.end_of_key_line();
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t type = text_.scan().integer("the type of an element");
      is_plane() ? read_plane_cell(type, block) : read_cell(type, block);
    }
    text_.check_rows_end_before(key + 1);
  }

  void read_plane_cell(std::int64_t type, std::int32_t block) {
    switch (type) {
      case vtk_triangle: return add_cell<CellKind::triangle>(mesh_, nodes_in_row<3>(), block);
      case vtk_quad: return add_cell<CellKind::quad>(mesh_, nodes_in_row<4>(), block);
      default:
        text_.scan().refuse("an element of type " + vtk_cell_name(type) +
                            "; only 5 (triangle) and 9 (quadrilateral) can be read");
    }
  }

  void read_cell(std::int64_t type, std::int32_t block) {
    switch (type) {
      case vtk_tetrahedron: return add_cell<CellKind::tetrahedron>(mesh_, nodes_in_row<4>(), block);
      case vtk_hexahedron: return add_cell<CellKind::hexahedron>(mesh_, nodes_in_row<8>(), block);
      case vtk_wedge: return add_cell<CellKind::prism>(mesh_, vtk_wedge_order(nodes_in_row<6>()), block);
      case vtk_pyramid: return add_cell<CellKind::pyramid>(mesh_, nodes_in_row<5>(), block);
      default:
        text_.scan().refuse("an element of type " + vtk_cell_name(type) +
                            "; only 10 (tetrahedron), 12 (hexahedron), 13 (prism) and 14 (pyramid) can be "
                            "read of three dimensions");
    }
  }

  void read_marker(std::size_t key, const std::string& name) {
    const std::size_t count = text_.count_of(
        key, (is_plane() ? "edges of marker " : "faces of marker ") + name, is_plane() ? 3 : 4);
    text_.end_of_key_line();
    FileBoundary& boundary = mesh_.boundaries[mesh_.boundary_named(name)];
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t type =
          text_.scan().integer(is_plane() ? "the type of an edge" : "the type of a face");
      boundary.places.push_back(text_.scan().place());
      boundary.faces.push_back(face_in_row(type, name));
    }
    text_.check_rows_end_before(key + 1);
  }

  FileBoundary::Face face_in_row(std::int64_t type, const std::string& marker) {
    const std::size_t width = is_plane()             ? (type == vtk_line ? 2 : 0)
                              : type == vtk_triangle ? 3
                              : type == vtk_quad     ? 4
                                                     : 0;
    if (width == 0)
      text_.scan().refuse("marker " + marker + " has an element of type " + vtk_cell_name(type) +
                          (is_plane() ? "; only 3 (line) can be read"
                                      : "; only 5 (triangle) and 9 (quadrilateral) can be read"));
    FileBoundary::Face face;
    face.fill(FileBoundary::no_node);
    for (std::size_t k = 0; k < width; ++k) face[k] = text_.node_in_row();
    text_.end_row();
    return face;
  }

  Su2Text text_;
  FileMesh mesh_;
  std::vector<std::size_t> first_nodes_;  ///< of each zone
};

}  // namespace

MeshOfFile read_su2(const std::string& path) { return Su2Reader(path).read(); }

}  // namespace quadloop::io
