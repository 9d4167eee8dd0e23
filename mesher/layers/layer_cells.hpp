#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "mesher/delaunay/tie_order.hpp"
#include "mesher/layers/front_columns.hpp"

namespace quadloop {

/// A cell or a boundary edge, with the leaf that it belongs to.
template <std::size_t width>
struct OfLeaf {
  std::int32_t leaf = 0;
  std::array<GlobalNodeId, width> nodes;
};

/// What stands between the walls and the front on this rank.
struct LayerCells {
  std::vector<OfLeaf<3>> triangles;
  std::vector<OfLeaf<4>> quads;
  std::vector<std::vector<OfLeaf<2>>> edges;  ///< of each boundary: all of them, the wall's for the front's
  std::map<GlobalNodeId, Point> foreign;      ///< nodes among these that other ranks own
  std::optional<Point> bad;                   ///< where on the front the first cell is that is not positive
};

/// The cells of all columns over the boundary edges of the mesh outside. `edge_leaves` and `divide` are as
/// add_layers has them.
LayerCells layer_cells(const FrontColumns& columns, const Mesh& outside,
                       const std::vector<std::vector<std::int32_t>>& edge_leaves,
                       const std::function<TieRank(Point)>& divide);

}  // namespace quadloop
