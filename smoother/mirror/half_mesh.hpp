#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mirror_images.hpp"

namespace quadloop::smoother {

/// The half of a mirror-symmetric mesh: its cells on the side where the signed distance from the axis is
/// positive, as a mesh of its own. Changes of the half are reflected to the whole mesh. Nodes, triangles and
/// quadrilaterals of the half keep their order and rank. Edges along the axis are a boundary of the half.
class HalfMesh {
 public:
  /// `axis_name` names the boundary along the axis. `flips`: the half's triangles may be replaced by others;
  /// then each triangle of the whole must have a mirror image. `whole` must outlive it and stay unchanged
  /// until reflect(). Throws InputError as find_node_images() does. *Collective.*
  HalfMesh(const Communicator& comm, const Mesh& whole, MirrorAxis axis, const std::string& axis_name,
           bool flips);

  Mesh& mesh() { return half_; }

  /// Flags owned nodes of the half: nodes that are flagged or have a flagged image, and nodes of cells across
  /// the axis. `of_whole` may be empty. *Collective.*
  NodeFlags pinned(const NodeFlags& of_whole) const;

  /// Selects from one value per triangle of the whole those of the half's triangles; empty for empty input.
  template <class T>
  std::vector<T> of_triangles(const std::vector<T>& values) const;
  /// Same for one value per cell, triangles first, then quadrilaterals.
  template <class T>
  std::vector<T> of_cells(const std::vector<T>& values) const;

  /// Copies the half's node positions, and with `flips` its triangles, to the unchanged `whole`, and their
  /// images to the other side. `standing`: number of triangles stored in the slot of each of the half's
  /// original triangles; empty means one each. Returns the same counts for the whole mesh, empty without
  /// flips. *Collective.*
  std::vector<std::int32_t> reflect(const std::vector<std::int32_t>& standing, Mesh& whole) const;

 private:
  enum class Side : char { image, half, across };
  template <std::size_t width>
  Side side_of_cell(const std::array<NodeId, width>& cell) const;
  template <std::size_t width>
  void take_cells(const std::vector<std::array<NodeId, width>>& cells,
                  std::vector<std::array<NodeId, width>>& taken, std::vector<std::int32_t>& numbers);
  void take_nodes();
  void take_boundaries(const std::string& axis_name);
  void reflect_positions(Mesh& whole) const;
  std::vector<std::int32_t> reflect_triangles(const std::vector<std::int32_t>& standing, Mesh& whole) const;

  /// Global numbers in the whole mesh of each node of the half, ghost copies included, and of its image.
  struct NodesOfHalf {
    IdVector<NodeId, GlobalNodeId> own, image;
  };
  NodesOfHalf nodes_of_half() const;

  const Communicator& comm_;
  const Mesh& whole_;
  MirrorAxis axis_;
  bool flips_;
  NodeImages images_;
  std::vector<Partner> triangle_images_;
  Mesh half_;
  IdVector<NodeId, NodeId> in_half_;    ///< for each node of the whole; none for nodes on the other side
  std::vector<NodeId> owned_in_whole_;  ///< for each owned node of the half
  std::vector<std::int32_t> triangles_, quads_;  ///< indices in the whole of the half's cells
  std::vector<GlobalNodeId> across_;             ///< nodes of this rank's cells across the axis
  std::vector<char> stays_;                      ///< flags the triangles of the whole that cross the axis
};

template <class T>
std::vector<T> HalfMesh::of_triangles(const std::vector<T>& values) const {
  std::vector<T> taken;
  if (values.empty()) return taken;
  for (const std::int32_t i : triangles_) taken.push_back(values[i]);
  return taken;
}

template <class T>
std::vector<T> HalfMesh::of_cells(const std::vector<T>& values) const {
  std::vector<T> taken = of_triangles(values);
  if (values.empty()) return taken;
  for (const std::int32_t i : quads_) taken.push_back(values[whole_.triangles.size() + i]);
  return taken;
}

}  // namespace quadloop::smoother
