#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// A cell, or half of one, counter-clockwise. Numbers run over all ranks: twice the cell's (triangles first,
/// then quads), one more for the second half of a quad.
struct CellTriangle {
  std::array<NodeId, 3> nodes;
  std::int64_t number = 0;
};

/// The centre of the box of all ranks' nodes. *Collective.*
Point centre_of_nodes(const Communicator& comm, const Mesh& mesh);

/// The two triangles of a quad: split along the diagonal through its corner of the highest tie rank, the one
/// farthest from `centre` along an axis, so that mirror images of a mesh are split alike. Where a half would
/// not be counter-clockwise (the quad is not convex there) the other diagonal.
std::array<std::array<NodeId, 3>, 2> split_quad(const Mesh& mesh, Point centre,
                                                const std::array<NodeId, 4>& quad);

/// A cell's triangles, one or the two of split_quad(). One without area is left out, one that runs clockwise
/// turned.
struct TrianglesOfCell {
  std::array<std::array<NodeId, 3>, 2> nodes;
  std::array<std::int8_t, 2> half{};  ///< of each, whether it is the first or the second
  std::size_t count = 0;
};
TrianglesOfCell parts_of(const Mesh& mesh, Point centre, const std::array<NodeId, 3>& triangle);
TrianglesOfCell parts_of(const Mesh& mesh, Point centre, const std::array<NodeId, 4>& quad);

/// All of this rank's cells as triangles, or those with a box that is wanted. *Collective.*
std::vector<CellTriangle> cell_triangles(const Communicator& comm, const Mesh& mesh, Point centre);
std::vector<CellTriangle> cell_triangles(const Communicator& comm, const Mesh& mesh, Point centre,
                                         const std::function<bool(const Box&)>& wanted);

}  // namespace quadloop
