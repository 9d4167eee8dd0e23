#include "adapt/remesh/tree_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "adapt/remesh/demands/restart.hpp"
#include "adapt/remesh/smoothed_mesh.hpp"
#include "generate/digests.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/check/compare_meshes.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/scatter_mesh.hpp"

namespace quadloop {

namespace {

/// All ranks' parts as one mesh on the root, as it would be read from its file; an empty one elsewhere.
/// *Collective.*
Mesh whole_at_root(const Communicator& comm, const Mesh& mesh) {
  Mesh whole = gather_whole(comm, mesh);
  std::erase_if(whole.boundaries, [](const BoundaryEdges& boundary) { return boundary.edges.empty(); });
  return whole;
}

/// Cells alone: whether the file names the boundaries does not matter here.
void require_valid_cells(const Mesh& mesh, const std::string& path) {
  for (const MeshFault& fault : validate(mesh)) {
    if (fault.rule != MeshRule::indices && fault.rule != MeshRule::positive &&
        fault.rule != MeshRule::coincident)
      continue;
    throw InputError(fmt::format(
        "{}: is no mesh of this tree: {} at ({}, {}); give the mesh that was written with the tree", path,
        fault.what, fault.place.x, fault.place.y));
  }
}

}  // namespace

bool is_mesh_of_tree(const Mesh& whole, const TreeAttributes& tree) {
  const auto count = [](const auto& rows) { return std::ssize(rows); };
  const bool counts = count(whole.points) == tree.nodes && count(whole.triangles) == tree.triangles &&
                      count(whole.quads) == tree.quads;
  return counts && digest_of_owned(whole) == tree.coordinate_digest && validate(whole).empty();
}

TreeMesh mesh_of_tree(const Communicator& comm, const TreeRecord& tree, const Mesh& solved,
                      const std::function<std::optional<Mesh>()>& find, std::span<const MeshInput> inputs) {
  TreeMesh result;
  const auto fits = [&](const MeshInput& input) {
    return input.geometry.digest() == tree.attributes.geometry_digest &&
           input.digest == tree.attributes.case_digest;
  };
  for (const MeshInput& input : inputs) {
    if (input.geometry.digest() == tree.attributes.geometry_digest) result.outline = &input.geometry;
  }
  std::optional<Mesh> found;
  if (comm.is_root()) {
    result.is_solved = is_mesh_of_tree(solved, tree.attributes);
    if (!result.is_solved) found = find();
  }
  const auto input = std::ranges::find_if(inputs, fits);
  result.known = comm.any(result.is_solved || found.has_value());
  if (!result.known && input != inputs.end()) {
    const GeneratedMesh made =
        generate_mesh(comm, *input, DemandedSplits(comm, adapted_splits(tree)), tree.measured_wall);
    result.known = made.result.tree.attributes.coordinate_digest == tree.attributes.coordinate_digest;
    if (result.known) found = whole_at_root(comm, made.result.mesh);
  }
  if (found && comm.is_root()) result.whole = std::move(*found);
  return result;
}

void settle_mesh(const TreeMesh& of_tree, Mesh& loaded, const std::string& path) {
  if (of_tree.is_solved) return;
  if (!of_tree.known) return require_valid_cells(loaded, path);
  const std::string other = difference(loaded, of_tree.whole);
  if (other.empty()) {
    loaded = of_tree.whole;
    return;
  }
  const std::string fault = fault_of_smoothed(of_tree.whole, loaded, of_tree.outline);
  if (!fault.empty())
    throw InputError(path + ": " + other + " (nor is it the tree's mesh smoothed: " + fault + ")");
  if (!same_cells_in_any_order(loaded, of_tree.whole)) return;
  std::vector<Point> points = std::move(loaded.points);
  loaded = of_tree.whole;
  loaded.points = std::move(points);
}

}  // namespace quadloop
