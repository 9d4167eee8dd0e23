#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "io/loaded/foreign_mesh.hpp"
#include "io/ugrid/ugrid_file.hpp"
#include "io/ugrid/ugrid_plane_file.hpp"

namespace quadloop {

namespace {

class UgridPlaneReader {
 public:
  explicit UgridPlaneReader(const std::string& path) : scan_{path}, names_{read_mapbc(names_of(path))} {}

  LoadedMesh read() {
    const std::size_t nodes = scan_.count("nodes", 3), triangles = scan_.count("triangles", 3),
                      quads = scan_.count("quadrilaterals", 4);
    for (const char* kind : {"tetrahedra", "pyramids", "prisms", "hexahedra"}) {
      if (scan_.integer(std::string("the number of ") + kind) != 0)
        scan_.refuse("a mesh of three dimensions in text; give it in binary (.b8.ugrid, .lb8.ugrid)");
    }
    for (std::size_t i = 0; i < nodes; ++i) {
      const double x = scan_.real("an x coordinate"), y = scan_.real("a y coordinate");
      scan_.real("a z coordinate");
      foreign_.loaded.mesh.points.push_back({x, y});
    }
    const std::int32_t block = foreign_.block_named("domain");
    for (std::size_t i = 0; i < triangles; ++i) foreign_.add_triangle(row<3>(), block);
    for (std::size_t i = 0; i < quads; ++i) foreign_.add_quad(row<4>(), block);
    for (std::size_t i = 0; i < triangles + quads; ++i) scan_.integer("the identifier of a face");
    if (!scan_.at_end()) read_edges();
    drop_unused_nodes(foreign_, scan_.path());
    return finish(std::move(foreign_), scan_);
  }

 private:
  /// Other programs may give it the name that goes with a 3D mesh.
  static std::string names_of(const std::string& path) {
    const std::string own = plane_mapbc_path(path);
    return std::filesystem::exists(own) ? own : mapbc_path(path);
  }

  template <std::size_t width>
  std::array<NodeId, width> row() {
    const std::int64_t points = std::ssize(foreign_.loaded.mesh.points);
    std::array<NodeId, width> nodes;
    for (NodeId& node : nodes) {
      const std::int64_t number = scan_.integer("the number of a node");
      if (number < 1 || number > points)
        scan_.refuse(fmt::format("node {} is none of the nodes 1 to {}", number, points));
      node = NodeId{static_cast<std::int32_t>(number - 1)};
    }
    return nodes;
  }

  void read_edges() {
    for (std::size_t left = scan_.count("boundary edges", 3); left > 0; --left) {
      const std::array<NodeId, 2> nodes = row<2>();
      const std::size_t place = scan_.place();
      const std::int64_t number = scan_.integer("the number of a boundary");
      const auto named = names_.find(static_cast<std::int32_t>(number));
      const bool has_name = named != names_.end();
      const std::int32_t boundary =
          foreign_.boundary_named(has_name ? named->second.name : fmt::format("boundary_{}", number));
      if (has_name)
        foreign_.loaded.mesh.boundaries[boundary].condition = condition_of_mapbc(named->second.condition);
      foreign_.edges.push_back({nodes, boundary, place});
    }
  }

  TextScanner scan_;
  std::map<std::int32_t, MapbcPatch> names_;
  ForeignMesh foreign_;
};

}  // namespace

LoadedMesh read_ugrid_plane(const std::string& path) { return UgridPlaneReader(path).read(); }

}  // namespace quadloop
