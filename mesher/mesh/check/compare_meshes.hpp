#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Of a local edge: how far a node may lie off and still be the same; other programs write coordinates with
/// few digits.
inline constexpr double same_place_tolerance = 1e-6;

/// A flag for each node of a whole mesh whose place in `points` is farther off than that, of the shortest
/// cell edge at it. As many points as nodes.
NodeFlags nodes_elsewhere(const std::vector<Point>& points, const Mesh& mesh);

/// The nodes of the first cell that only `found` has, in ascending order; none where both lists, of the same
/// length, have the same cells.
std::optional<std::array<NodeId, 3>> other_cell(const std::vector<std::array<NodeId, 3>>& found,
                                                const std::vector<std::array<NodeId, 3>>& wanted);
std::optional<std::array<NodeId, 4>> other_cell(const std::vector<std::array<NodeId, 4>>& found,
                                                const std::vector<std::array<NodeId, 4>>& wanted);

/// How a solution at so many nodes differs from one on `mesh`, in words for a message; empty where it does
/// not. `points` are those of its nodes, or none where they are not known.
std::string node_difference(std::int64_t nodes, const std::vector<Point>& points, const Mesh& mesh);

/// The same of a solution on the mesh `found`: its nodes, each within the tolerance above, and its cells in
/// any order.
std::string difference(const Mesh& found, const Mesh& whole);

}  // namespace quadloop
