#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/parallel/row_move.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// An order of a distributed mesh's nodes and cells: the global numbers, in the mesh, of the nodes and cells
/// that this rank has in the new order. Each rank has an even share.
struct PartOrder {
  std::vector<std::int64_t> nodes, triangles, quads;
};

/// The mesh's own order. *Collective.*
PartOrder own_order(const Communicator& comm, const Mesh& mesh);

/// As space_filling_order() of the whole mesh. *Collective.*
PartOrder space_filling_order(const Communicator& comm, const Mesh& mesh);

/// As order_for_parts() of the whole mesh. *Collective.*
PartOrder order_for_parts(const Communicator& comm, const Mesh& mesh);

/// Moves a distributed mesh, and values on it, to another order, and back.
class ReorderedMesh {
 public:
  /// `comm` must outlive the object. *Collective.*
  ReorderedMesh(const Communicator& comm, const Mesh& mesh, PartOrder order);

  /// Returns the mesh in the new order, without blocks; each boundary edge remains on its rank. *Collective.*
  Mesh mesh(const Mesh& old) const;
  /// As mesh(), and frees the points and cells of the old mesh until put_back(). *Collective.*
  Mesh take(Mesh& old) const;
  /// Returns values in the new order. *Collective.*
  template <std::ranges::contiguous_range Rows>
  auto of_nodes(const Rows& rows, std::size_t width = 1) const {
    return nodes_.forth(rows, width);
  }
  template <std::ranges::contiguous_range Rows>
  auto of_triangles(const Rows& rows, std::size_t width = 1) const {
    return triangles_.forth(rows, width);
  }
  MeshBlocks blocks(const MeshBlocks& old) const;
  Field field(const Field& old) const;

  /// Copies the positions and cells of the mesh in the new order, which may have changed, to the old one;
  /// adds ghosts to it if it needs more. *Collective.*
  void put_back(const Mesh& changed, Mesh& old) const;
  /// Inverse of field(). *Collective.*
  Field field_back(const Field& changed) const;

 private:
  void put_cells_back(const Mesh& changed, Mesh& old) const;

  const Communicator& comm_;
  RowMove nodes_, triangles_, quads_;
  std::vector<std::int64_t> old_nodes_;  ///< numbers in the old order of the nodes in the new one
};

}  // namespace quadloop
