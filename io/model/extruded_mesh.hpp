#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/model/point3.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Where a plane mesh is drawn out to: along z the plane keeps its x and y; along y its y becomes z, so that
/// flow and angle of attack lie in the x-z plane.
enum class ExtrusionAxis { y, z };

/// Heights of `layers` layers of the same thickness, from 0 to `thickness`, which is that of all together.
std::vector<double> even_heights(std::int64_t layers, double thickness);

/// A node of the 3D mesh, numbered over all ranks, from 0.
using NodeNumber = std::int64_t;

/// The blocks of a plane mesh, those of this rank's cells by their places among the names, which are the same
/// on all ranks.
struct PlaneBlocks {
  std::vector<std::string> names;
  std::vector<std::int32_t> of_triangles, of_quads;
};

/// A 3D mesh of prisms and hexahedra that is never held: a distributed plane mesh and the levels on which its
/// nodes stand. Level 0 is the back, the last the front, from which the plane looks as it was drawn: cells
/// are right-handed on both axes, the first three or four nodes of each on the level nearer to the back and
/// counter-clockwise as seen from the front, the others in front of them (the order of CGNS).
/// Numbers over all ranks, each from 0: node n of the plane on level k is n * levels() + k; between the
/// levels k and k + 1 stands cell c * layers() + k on cell c of the plane, triangles before quads.
/// Rows below are this rank's, in the order of those numbers.
struct ExtrudedMesh {
  const Mesh& plane;            ///< outlives it
  std::vector<double> heights;  ///< coordinates of the levels along the axis, from back to front; at least 2
  ExtrusionAxis axis = ExtrusionAxis::z;
  std::string back = "back", front = "front";  ///< names of the two ends; no boundary has one of them
  const Field* solution = nullptr;             ///< the same on each level, and in each layer
  const PlaneBlocks* blocks = nullptr;         ///< of the plane; null: one

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

  /// The face of layer `layer` on a boundary edge of the plane, seen from outside counter-clockwise.
  std::array<NodeNumber, 4> side(GlobalNodeId from, GlobalNodeId to, std::int64_t layer) const {
    return {node(from, layer), node(to, layer), node(to, layer + 1), node(from, layer + 1)};
  }
  /// The faces of a cell of the plane on the two ends, seen from outside counter-clockwise.
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
  /// As seen from the front counter-clockwise.
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

/// `heights` ascend; the ends get names that no boundary has: "front" or the first of "front_2", ... that is
/// free, "back" likewise.
ExtrudedMesh extruded(const Mesh& plane, std::vector<double> heights, ExtrusionAxis axis,
                      const Field* solution = nullptr);

/// Numbers over all ranks. *Collective.*
struct ExtrudedCounts {
  ExtrudedCounts(const Communicator& comm, const ExtrudedMesh& mesh);

  std::int64_t nodes = 0, prisms = 0, hexahedra = 0;
  std::int64_t triangles = 0, quads = 0;  ///< of the plane

  std::int64_t cells() const { return prisms + hexahedra; }
};

/// A variable of the 3D solution: that column of the plane's, or 0 everywhere.
struct ExtrudedVariable {
  static constexpr std::int64_t zero = -1;
  std::string name;
  std::int64_t column = zero;
};

/// The variables of a solution in space, by their names in the plane. Components of velocity and of momentum
/// stay in the plane: where it is drawn out along y, that along the plane's y becomes the one along z; of a
/// pair that is complete the third component is there too, 0.
std::vector<ExtrudedVariable> extruded_variables(const std::vector<std::string>& plane, ExtrusionAxis axis);

}  // namespace quadloop
