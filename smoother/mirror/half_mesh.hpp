#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mirror_images.hpp"

namespace quadloop {

/// Of a mesh that is its own mirror image the cells on the side where heights over the axis are above 0, as a
/// mesh of its own, and the way back: what became of the half is reflected. The half's nodes, triangles and
/// quadrilaterals keep their order, on their ranks. Edges along the axis are a boundary of the half.
class HalfMesh {
 public:
  /// `axis_name` is that of the boundary along the axis. `flips`: the half's triangles may come to be others;
  /// then each triangle must have its image. `whole` must outlive it and stay as it is until reflect().
  /// Throws InputError as find_node_images() does. *Collective.*
  HalfMesh(const Communicator& comm, const Mesh& whole, MirrorAxis axis, const std::string& axis_name,
           bool flips);

  Mesh& mesh() { return half_; }

  /// Flags for the half's owned nodes: where the node or its image is flagged (none need be), and nodes of
  /// cells across the axis. *Collective.*
  NodeFlags pinned(const NodeFlags& of_whole) const;

  /// Of a value for each triangle of the whole those for the half's; none of none.
  template <class T>
  std::vector<T> of_triangles(const std::vector<T>& values) const;
  /// The same of one for each triangle, then for each quadrilateral.
  template <class T>
  std::vector<T> of_cells(const std::vector<T>& values) const;

  /// Brings nodes, and with `flips` triangles, of `whole`, which is still as it was, to what they are in the
  /// half; on the other side to the image of that. `standing` says how many triangles stand in the slot of
  /// each of the half's; none: one in each. Returns the same for the whole mesh, empty without flips.
  /// *Collective.*
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

  /// Of each of the half's nodes, copies too, its number in the whole, and its image's.
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
  IdVector<NodeId, NodeId> in_half_;    ///< of each node of the whole; none for those on the other side
  std::vector<NodeId> owned_in_whole_;  ///< of each owned node of the half
  std::vector<std::int32_t> triangles_, quads_;  ///< of the half, by their index in the whole
  std::vector<GlobalNodeId> across_;             ///< nodes of this rank's cells across the axis
  std::vector<char> stays_;                      ///< a flag for each triangle of the whole: across the axis
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

}  // namespace quadloop
