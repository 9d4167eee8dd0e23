#include "adapt/remesh/own_mesh.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>

#include "adapt/remesh/demands/restart.hpp"
#include "adapt/sensor/cells_of_leaves.hpp"
#include "generate/digests.hpp"
#include "generate/leaf_quadrant.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/check/surely_valid.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"
#include "mesher/mesh/scatter_mesh.hpp"

namespace quadloop::adapt {

namespace {

/// Returns a coordinate of the centroids of this rank's cells, triangles, then quads; `in_layers` for cells
/// in layers, which extend from their quadtree cell to the wall.
std::vector<double> centres(const Mesh& mesh, const LayerPlaces& places, double Point::*coordinate,
                            double in_layers) {
  std::vector<double> values;
  const auto append = [&](const auto& cells) {
    for (const auto& nodes : cells) {
      double sum = 0;
      for (const NodeId node : nodes) sum += mesh.point(node).*coordinate;
      values.push_back(is_layer_cell(places, nodes) ? in_layers : sum / size32(nodes));
    }
  };
  append(mesh.triangles);
  append(mesh.quads);
  return values;
}

TreeGrid grid_of(const TreeAttributes& a) { return {root_box(a), a.trees_x, a.trees_y}; }

bool is_untouched(const Communicator& comm, const SolvedMesh& solved) {
  return coordinate_digest(comm, solved.mesh) == solved.tree.attributes.coordinate_digest;
}

}  // namespace

void require_counts(const MeshCounts& of_mesh, const TreeAttributes& of_tree, const std::string& shown,
                    const std::string& tree) {
  if (of_mesh.nodes == of_tree.nodes && of_mesh.triangles == of_tree.triangles &&
      of_mesh.quads == of_tree.quads)
    return;
  throw InputError(
      fmt::format("{}: belongs to another mesh than {}: {} nodes, {} triangles, {} quads, but the tree's "
                  "mesh has {}, {}, {}",
                  shown, tree, of_mesh.nodes, of_mesh.triangles, of_mesh.quads, of_tree.nodes,
                  of_tree.triangles, of_tree.quads));
}

bool is_mesh_of_tree(const Communicator& comm, const Mesh& mesh, const TreeAttributes& tree) {
  const MeshCounts counts = count(comm, mesh);
  const bool same_counts =
      counts.nodes == tree.nodes && counts.triangles == tree.triangles && counts.quads == tree.quads;
  if (!same_counts || coordinate_digest(comm, mesh) != tree.coordinate_digest) return false;
  if (is_surely_valid(comm, mesh)) return true;
  const Mesh whole = gather_whole(comm, mesh);
  return !comm.any(comm.is_root() && !validate(whole, cell_blocks(whole)).empty());
}

void require_own_mesh(const Communicator& comm, const SolvedMesh& solved, const std::string& shown,
                      const std::string& tree) {
  constexpr double reach = 2;
  require_counts(count(comm, solved.mesh), solved.tree.attributes, shown, tree);
  if (is_untouched(comm, solved)) return;
  const CellsOfLeaves cells(comm, solved.mesh, solved.tree.leaves);
  const LayerPlaces places = layer_places(comm, solved.mesh);
  const auto of_all = [&](double Point::*coordinate, double in_layers) {
    return centres(solved.mesh, places, coordinate, in_layers);
  };
  constexpr double none = std::numeric_limits<double>::infinity();
  const auto left = cells.smallest(comm, of_all(&Point::x, none)),
             right = cells.largest(comm, of_all(&Point::x, -none)),
             bottom = cells.smallest(comm, of_all(&Point::y, none)),
             top = cells.largest(comm, of_all(&Point::y, -none));
  const TreeGrid grid = grid_of(solved.tree.attributes);
  comm.together([&] {
    for (std::size_t i = 0; i < solved.tree.leaves.size(); ++i) {
      if (!has_cells(solved.tree.leaves[i])) continue;
      const Quadrant q = quadrant_of(solved.tree.leaves[i]);
      const Box box = grid.box_of(q);
      const double far = reach * grid.edge(q.level);
      const bool near = left[i] > box.low.x - far && right[i] < box.high.x + far &&
                        bottom[i] > box.low.y - far && top[i] < box.high.y + far;
      if (near) continue;
      throw InputError(
          fmt::format("{}: belongs to another mesh than {}: a cell at ({}, {}) does not belong to the "
                      "quadtree cell at ({}, {}); give the mesh that was written with the tree",
                      shown, tree, left[i], bottom[i], box.centre().x, box.centre().y));
    }
  });
}

void require_untouched_mesh(const Communicator& comm, const SolvedMesh& solved, const std::string& shown,
                            const std::string& tree) {
  require_own_mesh(comm, solved, shown, tree);
  if (is_untouched(comm, solved)) return;
  throw InputError(fmt::format("{}: its nodes differ in position from those of the mesh of {}", shown, tree));
}

}  // namespace quadloop::adapt
