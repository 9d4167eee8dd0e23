#include "io/model/plane_of_mesh3d.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "io/model/cell_faces.hpp"
#include "io/model/clean_up.hpp"
#include "io/model/mesh3d_faces.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop::io {

namespace {

/// Axes of the plane and the axis across it: u, v and across are right-handed.
struct PlaneAxes {
  char across = 'z';

  Point in_plane(Point3 p) const {
    return across == 'z' ? Point{p.x, p.y} : across == 'x' ? Point{p.y, p.z} : Point{p.x, p.z};
  }
  double along(Point3 p) const { return across == 'z' ? p.z : across == 'x' ? p.x : -p.y; }
};

/// Returns twice the area vector of a face; for a quad from its diagonals.
Point3 twice_area(const FileMesh& mesh, const FileBoundary::Face& face) {
  const auto at = [&](std::size_t i) { return mesh.points[face[i]]; };
  return is_triangle(face) ? cross(at(1) - at(0), at(2) - at(0)) : cross(at(2) - at(0), at(3) - at(1));
}

PlaneAxes axes_of(const FileMesh& mesh) {
  Point3 sum;
  for (const FileBoundary& patch : mesh.boundaries) {
    for (const FileBoundary::Face& face : patch.faces) {
      if (!patch.is_empty) break;
      const Point3 area = twice_area(mesh, face);
      sum = sum + Point3{std::abs(area.x), std::abs(area.y), std::abs(area.z)};
    }
  }
  if (sum.z >= sum.x && sum.z >= sum.y) return {'z'};
  return {sum.x >= sum.y ? 'x' : 'y'};
}

/// A face of a cell on an empty patch.
struct EmptyFace {
  std::int32_t patch = -1, number = -1;  ///< location of the face
  std::int32_t local = -1;               ///< local face number in the cell
};

class PlaneMaker {
 public:
  PlaneMaker(const FileMesh& mesh3d, const std::string& path)
      : mesh3d_{mesh3d}, path_{path}, axes_{axes_of(mesh3d)}, new_node_(mesh3d.points.size(), -1) {}

  LoadedMesh run() {
    find_empty_faces();
    for_each_cell(mesh3d_, [&](const auto& nodes, std::int64_t cell) { sort_out(nodes, cell); });
    number_nodes();
    for (const auto& [face, cell] : backs_) add_cell(face);
    add_boundaries();
    copy_solution();
    plane_.mesh.owned_nodes = size32(plane_.mesh.points);
    take_blocks();
    plane_.warnings = mesh3d_.warnings;
    return std::move(plane_);
  }

 private:
  // maximum deviation of an edge across the plane, relative to its length
  static constexpr double most_lean = 1e-6;

  struct Back {
    FileBoundary::Face nodes;  ///< in the order of the patch, or reversed, so that the normal points outwards
    std::int64_t cell;
  };

  [[noreturn]] void refuse(std::int64_t cell, const std::string& fault) const {
    throw InputError(fmt::format("{}: cell {} {}; a mesh with patches of type empty is one cell thick", path_,
                                 cell, fault));
  }

  void find_empty_faces() {
    std::int64_t cells = 0;
    for_each_cell(mesh3d_, [&](const auto&, std::int64_t) { ++cells; });
    empty_.resize(cells);
    for_each_face(mesh3d_, [this](std::int32_t, std::span<const FaceMention> same) {
      if (same.size() != 2 || same[0].owner >= 0 || same[1].owner < 0) return;
      const std::int32_t patch = -1 - same[0].owner;
      if (!mesh3d_.boundaries[patch].is_empty) return;
      auto& faces = empty_[same[1].owner];
      if (faces[1].local >= 0) refuse(same[1].owner, "has more than two faces on such patches");
      faces[faces[0].local < 0 ? 0 : 1] = {patch, same[0].number, same[1].number};
    });
  }

  /// Determines which of a cell's two empty faces is the back.
  template <std::size_t width>
  void sort_out(const std::array<std::int32_t, width>& nodes, std::int64_t cell) {
    auto [back, front] = empty_[cell];
    if (front.local < 0) refuse(cell, "does not have two faces on such patches");
    const auto outer = [&](const EmptyFace& face) {
      return face_of(nodes, CellFaces<width>::faces[face.local]);
    };
    if (axes_.along(twice_area(mesh3d_, outer(back))) > 0) std::swap(back, front);
    if (!(axes_.along(twice_area(mesh3d_, outer(back))) < 0) ||
        !(axes_.along(twice_area(mesh3d_, outer(front))) > 0))
      refuse(cell, fmt::format("does not lie between two faces across {}", axes_.across));
    const FileBoundary::Face own = outer(back);
    backs_.push_back({in_order_of(own, mesh3d_.boundaries[back.patch].faces[back.number]), cell});
    require_upright(nodes, own, outer(front), cell);
    for (const std::int32_t node : corners_of(own)) new_node_[node] = 0;
  }

  /// Returns the nodes of `given`, which are those of `own`, in the direction of `own`.
  static FileBoundary::Face in_order_of(const FileBoundary::Face& own, FileBoundary::Face given) {
    const std::size_t width = corners_of(own).size();
    const auto at = std::find(own.begin(), own.end(), given[0]) - own.begin();
    if (own[(at + 1) % width] != given[1]) std::reverse(given.begin(), given.begin() + width);
    return given;
  }

  /// Requires that the edges between back and front are parallel to the axis.
  template <std::size_t width>
  void require_upright(const std::array<std::int32_t, width>& nodes, const FileBoundary::Face& back,
                       const FileBoundary::Face& front, std::int64_t cell) const {
    const auto is_of = [](const FileBoundary::Face& face, std::int32_t node) {
      return std::ranges::count(face, node) > 0;
    };
    for (const LocalFace& local : CellFaces<width>::faces) {
      const FileBoundary::Face side = face_of(nodes, local);
      const auto corners = corners_of(side);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const std::int32_t from = corners[k], to = corners[(k + 1) % corners.size()];
        if (!is_of(back, from) || !is_of(front, to)) continue;
        const Point3 edge = mesh3d_.points[to] - mesh3d_.points[from];
        const Point lean = axes_.in_plane(edge);
        if (std::max(std::abs(lean.x), std::abs(lean.y)) > most_lean * axes_.along(edge) ||
            is_of(front, from))
          refuse(cell, fmt::format("is not extruded along {}", axes_.across));
      }
    }
  }

  void number_nodes() {
    std::int32_t next = 0;
    for (std::size_t node = 0; node < new_node_.size(); ++node) {
      if (new_node_[node] < 0) continue;
      new_node_[node] = next++;
      plane_.mesh.points.push_back(axes_.in_plane(mesh3d_.points[node]));
    }
  }

  /// Adds a cell from a back face, which is clockwise as seen from the front.
  void add_cell(const FileBoundary::Face& face) {
    const auto node = [&](std::size_t k) { return NodeId{new_node_[face[k]]}; };
    if (is_triangle(face)) {
      plane_.mesh.triangles.push_back({node(2), node(1), node(0)});
    } else {
      plane_.mesh.quads.push_back({node(3), node(2), node(1), node(0)});
    }
  }

  void add_boundaries() {
    const EdgeTable table(plane_.mesh);
    for (const FileBoundary& patch : mesh3d_.boundaries) {
      if (patch.is_empty || patch.faces.empty()) continue;
      BoundaryEdges boundary{patch.name, patch.condition, {}};
      for (const FileBoundary::Face& face : patch.faces) {
        std::array<NodeId, 2> edge = edge_of(face, patch.name);
        if (table.cell_left_of(edge[0], edge[1]) < 0) std::swap(edge[0], edge[1]);
        boundary.edges.push_back(edge);
        if (patch.is_periodic)
          plane_.periodic_nodes.insert(plane_.periodic_nodes.end(), edge.begin(), edge.end());
      }
      plane_.mesh.boundaries.push_back(std::move(boundary));
    }
  }

  /// Returns the edge of a side face on the back, in the direction of the face.
  std::array<NodeId, 2> edge_of(const FileBoundary::Face& face, const std::string& patch) const {
    const auto corners = corners_of(face);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::int32_t from = new_node_[corners[k]], to = new_node_[corners[(k + 1) % corners.size()]];
      if (from >= 0 && to >= 0) return {NodeId{from}, NodeId{to}};
    }
    throw InputError(
        path_ + ": a face of patch " + patch +
        " has no edge on the back of the plane; a mesh with patches of type empty is one cell thick");
  }

  void copy_solution() {
    if (!mesh3d_.solution) return;
    const Field& mesh3d = *mesh3d_.solution;
    Field& plane = plane_.solution.emplace();
    plane.names = mesh3d.names;
    plane.constants = mesh3d.constants;
    plane.cells = mesh3d.cells;  // prisms before hexahedra, as triangles before quads
    for (std::size_t node = 0; node < new_node_.size(); ++node) {
      if (new_node_[node] < 0) continue;
      const auto row = mesh3d.row(NodeId{static_cast<std::int32_t>(node)});
      plane.values.insert(plane.values.end(), row.begin(), row.end());
    }
  }

  /// Takes the blocks of the prisms and hexahedra.
  void take_blocks() {
    plane_.triangle_to_block = mesh3d_.cell_to_block[static_cast<std::size_t>(CellKind::prism)];
    plane_.quad_to_block = mesh3d_.cell_to_block[static_cast<std::size_t>(CellKind::hexahedron)];
    plane_.triangle_to_block.resize(plane_.mesh.triangles.size(), 0);
    plane_.quad_to_block.resize(plane_.mesh.quads.size(), 0);
    plane_.block_names = mesh3d_.has_blocks() ? mesh3d_.block_names : std::vector<std::string>{"domain"};
    plane_.blocks = size32(plane_.block_names);
    order_by_blocks(plane_);
  }

  const FileMesh& mesh3d_;
  std::string path_;
  PlaneAxes axes_;
  std::vector<std::array<EmptyFace, 2>> empty_;  ///< of each cell
  std::vector<Back> backs_;                      ///< in the order of the cells
  std::vector<std::int32_t> new_node_;  ///< number of each node in the plane; -1 if it is not on the back
  LoadedMesh plane_;
};

}  // namespace

bool is_one_cell_thick(const FileMesh& mesh) {
  return std::ranges::any_of(mesh.boundaries, [](const FileBoundary& patch) { return patch.is_empty; });
}

LoadedMesh plane_of_mesh3d(const FileMesh& mesh3d, const std::string& path) {
  return PlaneMaker(mesh3d, path).run();
}

LoadedMesh plane_of(MeshOfFile mesh, const std::string& path) {
  if (LoadedMesh* plane = std::get_if<LoadedMesh>(&mesh)) return std::move(*plane);
  const FileMesh& mesh3d = std::get<FileMesh>(mesh);
  if (is_one_cell_thick(mesh3d)) return plane_of_mesh3d(mesh3d, path);
  throw InputError(path +
                   ": contains a 3D mesh, but a 2D mesh is required (a 3D mesh is read as a 2D mesh if it is "
                   "one cell thick between patches of type empty)");
}

}  // namespace quadloop::io
