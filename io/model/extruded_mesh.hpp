#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/model/point3.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// Direction of extrusion: along z, x and y are unchanged; along y, the plane's y becomes z, so that flow and
/// angle of attack are in the x-z plane.
enum class ExtrusionAxis { y, z };

/// Returns the heights of `layers` layers of equal thickness, from 0 to `thickness` in total.
std::vector<double> even_heights(std::int64_t layers, double thickness);

/// A node of the 3D mesh, numbered over all ranks, from 0.
using NodeNumber = std::int64_t;

using PlaneBlocks = MeshBlocks;

/// A 3D mesh of prisms and hexahedra that is never stored: a distributed plane mesh and the levels of its
/// nodes. Level 0 is the back, the last the front, from which the plane is seen unmirrored. Cells are
/// right-handed for both axes: the first three or four nodes of each are on the level closer to the back and
/// counter-clockwise as seen from the front, followed by the others in front of them (CGNS order). Numbers
/// over all ranks, each from 0: node n of the plane on level k is n * levels() + k; the cell on cell c of the
/// plane (triangles before quads) between levels k and k + 1 is c * layers() + k. Rows below are those of
/// this rank, in the order of these numbers.
struct ExtrudedMesh {
  const Mesh& plane;            ///< must outlive the object
  std::vector<double> heights;  ///< coordinates of the levels along the axis, from back to front; at least 2
  ExtrusionAxis axis = ExtrusionAxis::z;
  /// Names of the two end patches; distinct from all boundary names.
  std::string back = "back", front = "front";
  const Field* solution = nullptr;      ///< the same on each level, and in each layer
  const PlaneBlocks* blocks = nullptr;  ///< of the plane; null: one block

  std::int64_t levels() const { return std::ssize(heights); }
  std::int64_t layers() const { return levels() - 1; }
  double height() const { return std::abs(heights.back() - heights.front()); }

  NodeNumber node(GlobalNodeId of_plane, std::int64_t level) const {
    return of_plane.value() * levels() + level;
  }
  std::int64_t point_rows() const { return plane.owned_nodes * levels(); }
  std::int64_t prism_rows() const { return std::ssize(plane.triangles) * layers(); }
  std::int64_t hexahedron_rows() const { return std::ssize(plane.quads) * layers(); }

  Point3 point(std::int64_t row) const {
    const Point p = plane.points[row / levels()];
    const double along = heights[row % levels()];
    return axis == ExtrusionAxis::z ? Point3{p.x, p.y, along} : Point3{p.x, along, p.y};
  }
  std::array<NodeNumber, 6> prism(std::int64_t row) const { return column(plane.triangles, row); }
  std::array<NodeNumber, 8> hexahedron(std::int64_t row) const { return column(plane.quads, row); }

  /// Returns the face of layer `layer` on a boundary edge of the plane, counter-clockwise as seen from
  /// outside.
  std::array<NodeNumber, 4> side(GlobalNodeId from, GlobalNodeId to, std::int64_t layer) const {
    return {node(from, layer), node(to, layer), node(to, layer + 1), node(from, layer + 1)};
  }
  /// Return the faces of a plane cell on the two ends, counter-clockwise as seen from outside.
  template <std::size_t width>
  std::array<NodeNumber, width> back_face(const std::array<NodeId, width>& cell) const {
    std::array<NodeNumber, width> face;
    for (std::size_t i = 0; i < width; ++i) face[i] = node(plane.global(cell[width - 1 - i]), 0);
    return face;
  }
  template <std::size_t width>
  std::array<NodeNumber, width> front_face(const std::array<NodeId, width>& cell) const {
    return face_at(cell, layers());
  }
  /// Counter-clockwise as seen from the front.
  template <std::size_t width>
  std::array<NodeNumber, width> face_at(const std::array<NodeId, width>& cell, std::int64_t level) const {
    std::array<NodeNumber, width> face;
    for (std::size_t i = 0; i < width; ++i) face[i] = node(plane.global(cell[i]), level);
    return face;
  }

 private:
  template <std::size_t width>
  std::array<NodeNumber, 2 * width> column(const std::vector<std::array<NodeId, width>>& cells,
                                           std::int64_t row) const {
    const std::array<NodeId, width>& cell = cells[row / layers()];
    std::array<NodeNumber, 2 * width> nodes;
    for (std::size_t i = 0; i < width; ++i) {
      nodes[i] = node(plane.global(cell[i]), row % layers());
      nodes[i + width] = nodes[i] + 1;
    }
    return nodes;
  }
};

/// `heights` must be ascending. The ends get names that no boundary has: "front" or the first free one of
/// "front_2", ..., and likewise "back".
ExtrudedMesh extruded(const Mesh& plane, std::vector<double> heights, ExtrusionAxis axis,
                      const Field* solution = nullptr);

/// Numbers over all ranks. *Collective.*
struct ExtrudedCounts {
  ExtrudedCounts(const Communicator& comm, const ExtrudedMesh& mesh);

  std::int64_t nodes = 0, prisms = 0, hexahedra = 0;
  std::int64_t triangles = 0, quads = 0;  ///< of the plane

  std::int64_t cells() const { return prisms + hexahedra; }
};

/// A variable of the 3D solution: a column of the plane's solution, or 0 everywhere.
struct ExtrudedVariable {
  static constexpr std::int64_t zero = -1;
  std::string name;
  std::int64_t column = zero;
};

/// Returns the variables of the 3D solution for those of the plane. Velocity and momentum remain in the
/// plane: for extrusion along y, the component along the plane's y becomes that along z. A complete pair gets
/// the third component, which is 0.
std::vector<ExtrudedVariable> extruded_variables(const std::vector<std::string>& plane, ExtrusionAxis axis);

}  // namespace quadloop::io
