#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "io/model/clean_up.hpp"
#include "io/ugrid/ugrid_file.hpp"
#include "io/ugrid/ugrid_plane_file.hpp"

namespace quadloop::io {

namespace {

class UgridPlaneReader {
 public:
  explicit UgridPlaneReader(const std::string& path) : scan_{path}, names_{read_mapbc(names_of(path))} {}

  MeshOfFile read() {
    mesh_.dimension = 2;
    const std::size_t nodes = scan_.count("nodes", 3), triangles = scan_.count("triangles", 3),
                      quads = scan_.count("quadrilaterals", 4);
    for (const char* kind : {"tetrahedra", "pyramids", "prisms", "hexahedra"}) {
      if (scan_.integer(std::string("the number of ") + kind) != 0)
        scan_.refuse("a mesh of three dimensions in text; give it in binary (.b8.ugrid, .lb8.ugrid)");
    }
    for (std::size_t i = 0; i < nodes; ++i) {
      const double x = scan_.real("an x coordinate"), y = scan_.real("a y coordinate");
      scan_.real("a z coordinate");
      mesh_.points.push_back({x, y, 0});
    }
    for (std::size_t i = 0; i < triangles; ++i) mesh_.triangles.push_back(row<3>());
    for (std::size_t i = 0; i < quads; ++i) mesh_.quads.push_back(row<4>());
    std::vector<std::int64_t> identifiers(triangles + quads);
    for (std::int64_t& identifier : identifiers) identifier = scan_.integer("the identifier of a face");
    set_blocks(mesh_, identifiers);
    if (!scan_.at_end()) read_edges();
    drop_unused_nodes(mesh_, scan_.path());
    return plane_mesh(std::move(mesh_), scan_);
  }

 private:
  /// Other programs may use the file name of a 3D mesh.
  static std::string names_of(const std::string& path) {
    const std::string own = plane_mapbc_path(path);
    return std::filesystem::exists(own) ? own : mapbc_path(path);
  }

  template <std::size_t width>
  std::array<std::int32_t, width> row() {
    const std::int64_t points = std::ssize(mesh_.points);
    std::array<std::int32_t, width> nodes;
    for (std::int32_t& node : nodes) {
      const std::int64_t number = scan_.integer("the number of a node");
      if (number < 1 || number > points)
        scan_.refuse(fmt::format("node {} is none of the nodes 1 to {}", number, points));
      node = static_cast<std::int32_t>(number - 1);
    }
    return nodes;
  }

  void read_edges() {
    for (std::size_t left = scan_.count("boundary edges", 3); left > 0; --left) {
      const auto [from, to] = row<2>();
      const std::size_t place = scan_.place();
      const std::int64_t number = scan_.integer("the number of a boundary");
      const auto named = names_.find(static_cast<std::int32_t>(number));
      const bool has_name = named != names_.end();
      FileBoundary& boundary = mesh_.boundaries[mesh_.boundary_named(
          has_name ? named->second.name : fmt::format("boundary_{}", number))];
      if (has_name) boundary.condition = condition_of_mapbc(named->second.condition);
      boundary.faces.push_back({from, to, FileBoundary::no_node, FileBoundary::no_node});
      boundary.places.push_back(place);
    }
  }

  TextScanner scan_;
  std::map<std::int32_t, MapbcPatch> names_;
  FileMesh mesh_;
};

}  // namespace

MeshOfFile read_ugrid_plane(const std::string& path) { return UgridPlaneReader(path).read(); }

}  // namespace quadloop::io
