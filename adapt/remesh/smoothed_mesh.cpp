#include "adapt/remesh/smoothed_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "mesher/mesh/check/compare_meshes.hpp"
#include "mesher/mesh/check/delaunay_check.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "smoother/objective/condition_number.hpp"
#include "smoother/outline/outline_path.hpp"

namespace quadloop {

namespace {

/// What the smoother lowers, of one cell: the squared costs of its corners, those of a triangle being all the
/// same.
template <std::size_t width>
double squared_cost(const Mesh& mesh, const std::array<NodeId, width>& cell) {
  static const std::array<CornerTarget, width> targets = ideal_targets<width>();
  double sum = 0;
  for (std::size_t k = 0; k < (width == 3 ? 1 : width); ++k) {
    const CornerForm corner = corner_form(mesh.point(cell[k]), mesh.point(cell[(k + 1) % width]),
                                          mesh.point(cell[(k + width - 1) % width]));
    const double cost = corner_cost(corner, targets[k], 1);
    sum += cost * cost;
  }
  return sum;
}

/// Nodes of one cell that have moved belong to one patch.
class Patches {
 public:
  Patches(const Mesh& mesh, const NodeFlags& moved) : moved_{moved}, parent_(mesh.points.size()) {
    std::ranges::copy(parent_.ids(), parent_.begin());
    const auto join = [&](const auto& cell) {
      const NodeId first = patch_of(cell);
      for (const NodeId node : cell) {
        if (first.valid() && has_moved(node)) parent_[root_of(node)] = first;
      }
    };
    std::ranges::for_each(mesh.triangles, join);
    std::ranges::for_each(mesh.quads, join);
  }

  /// The patch that a cell belongs to, by one of its nodes; none where none of the cell's has moved.
  NodeId patch_of(std::span<const NodeId> cell) {
    const auto node = std::ranges::find_if(cell, [&](NodeId n) { return has_moved(n); });
    return node == cell.end() ? NodeId{} : root_of(*node);
  }

 private:
  bool has_moved(NodeId node) const { return moved_[node] != 0; }
  NodeId root_of(NodeId node) {
    while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
    return node;
  }

  const NodeFlags& moved_;
  IdVector<NodeId, NodeId> parent_;
};

std::string cost_fault(const Mesh& before, const Mesh& found, const NodeFlags& moved) {
  Patches patches(before, moved);
  IdVector<NodeId, double> gain(before.points.size(), 0);
  const auto add = [&](const auto& cell) {
    const NodeId patch = patches.patch_of(cell);
    if (patch.valid()) gain[patch] += squared_cost(before, cell) - squared_cost(found, cell);
  };
  std::ranges::for_each(before.triangles, add);
  std::ranges::for_each(before.quads, add);
  const auto worse = std::ranges::find_if(gain, [](double g) { return g < 0; });
  if (worse == gain.end()) return {};
  const Point place = found.points[worse - gain.begin()];
  return fmt::format("the cells round ({}, {}) are worse than they were", place.x, place.y);
}

/// Of a mesh whose edges have been flipped there are no cells to compare.
std::string flip_fault(const Mesh& before, const Mesh& found) {
  if (!before.quads.empty() || before.triangles.size() != found.triangles.size() || !is_delaunay(found))
    return "its cells are others";
  double largest_before = 0, largest_after = 0;
  for (const auto& cell : before.triangles)
    largest_before = std::max(largest_before, squared_cost(before, cell));
  for (const auto& cell : found.triangles) largest_after = std::max(largest_after, squared_cost(found, cell));
  return largest_after > largest_before ? "its worst cell is worse" : "";
}

std::string boundary_fault(const Mesh& before, const Mesh& found, const NodeFlags& moved,
                           const Geometry* outline) {
  std::optional<OutlinePath> curves;
  for (const BoundaryEdges& boundary : before.boundaries) {
    for (const auto& edge : boundary.edges) {
      const NodeId node = edge[0];
      if (moved[node] == 0) continue;
      if (outline != nullptr && !curves) curves.emplace(*outline);
      const double reach =
          curves ? std::max(curves->tolerance(),
                            same_place_tolerance * length(before.point(edge[1]) - before.point(edge[0])))
                 : 0;
      if (curves && curves->has(boundary.name) &&
          std::isfinite(curves->distance(found.point(node), boundary.name, reach)))
        continue;
      return fmt::format("node {} of the boundary '{}' lies off its outline", node.value() + 1,
                         boundary.name);
    }
  }
  return {};
}

}  // namespace

std::string fault_of_smoothed(const Mesh& before, const Mesh& found, const Geometry* outline) {
  if (found.points.size() != before.points.size()) return "it has another number of nodes";
  const bool same_cells = same_cells_in_any_order(found, before);
  Mesh judged = same_cells ? before : found;
  judged.points = found.points;
  judged.boundaries = before.boundaries;
  const std::vector<MeshFault> faults = validate(judged);
  if (!faults.empty())
    return fmt::format("it is invalid: {} at ({}, {})", faults.front().what, faults.front().place.x,
                       faults.front().place.y);
  const NodeFlags moved = nodes_elsewhere(found.points, before);
  std::string fault = boundary_fault(before, judged, moved, outline);
  if (fault.empty()) fault = same_cells ? cost_fault(before, judged, moved) : flip_fault(before, judged);
  return fault;
}

}  // namespace quadloop
