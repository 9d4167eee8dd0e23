#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Tolerance for equal node positions, relative to a local edge; other programs write coordinates with few
/// digits.
inline constexpr double same_place_tolerance = 1e-6;

/// Flags the nodes of a whole mesh whose position in `points` differs by more than this tolerance times the
/// shortest cell edge at the node. There must be as many points as nodes.
NodeFlags nodes_elsewhere(const std::vector<Point>& points, const Mesh& mesh);

/// Returns the nodes, ascending, of the first cell that only `found` has; empty if both lists, which must be
/// equally long, have the same cells.
std::optional<std::array<NodeId, 3>> other_cell(const std::vector<std::array<NodeId, 3>>& found,
                                                const std::vector<std::array<NodeId, 3>>& wanted);
std::optional<std::array<NodeId, 4>> other_cell(const std::vector<std::array<NodeId, 4>>& found,
                                                const std::vector<std::array<NodeId, 4>>& wanted);

/// Returns, for a message, how a solution at this many nodes differs from one on `mesh`; empty if it does
/// not. `points` are its node positions, empty if not known.
std::string node_difference(std::int64_t nodes, const std::vector<Point>& points, const Mesh& mesh);

/// Returns the difference of the meshes: nodes within the tolerance above, cells in any order.
std::string difference(const Mesh& found, const Mesh& whole);

/// Whether node_difference() and difference() of the whole meshes are empty, for distributed ones that have
/// even shares in their own order. *Collective.*
bool has_same_nodes(const Communicator& comm, std::int64_t nodes, const std::vector<Point>& points,
                    const Mesh& mesh);
bool is_same_mesh(const Communicator& comm, const Mesh& found, const Mesh& mesh);

}  // namespace quadloop
