#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/exchange.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// An order of a whole mesh's nodes and cells in which neighbours are close, so that contiguous partitions
/// have short interfaces. Entry i is the number, in the whole mesh, of the i-th node or cell.
struct MeshOrder {
  std::vector<std::int32_t> nodes, triangles, quads;
};

/// Nodes along a space-filling curve over the mesh's bounding box, cells by their first node along it.
/// Depends on the mesh only; linear except for sorting.
MeshOrder space_filling_order(const Mesh& whole);

/// The numbering of the mesh itself.
MeshOrder own_order(const Mesh& whole);

/// Returns the mesh's own order if neighbours are close in it, as in meshes generated along a curve, else
/// space_filling_order(). A repeated computation on such a mesh is thus bitwise identical.
MeshOrder order_for_parts(const Mesh& whole);

/// Distributes a mesh that the root holds, in the given order: an even number of nodes, triangles, quads and
/// boundary edges on each rank. `whole` and `order` are used on the root only. *Collective.*
Mesh scatter_mesh(const Communicator& comm, const Mesh& whole, const MeshOrder& order);

/// Distributes nodal values of the whole mesh on the root to the owned nodes; an empty range gives none.
/// *Collective.*
template <std::ranges::contiguous_range Values>
std::vector<std::ranges::range_value_t<Values>> scatter_nodes(const Communicator& comm,
                                                              const Values& of_whole, const MeshOrder& order);

/// Distributes values of triangles in the same way. *Collective.*
template <class T>
std::vector<T> scatter_triangles(const Communicator& comm, const std::vector<T>& of_whole,
                                 const MeshOrder& order);

/// Distributes the root's field on a whole mesh as scatter_mesh() distributed the mesh to `part` in the same
/// order. `of_whole` and `order` are used on the root only. *Collective.*
Field scatter_field(const Communicator& comm, const Field& of_whole, const Mesh& part,
                    const MeshOrder& order);

/// Inverse of scatter_field(): returns the field on the whole mesh on the root, a field without values
/// elsewhere. `field` must not have ghost rows. *Collective.*
Field gather_field(const Communicator& comm, const Field& field, const Mesh& part, const MeshOrder& order);

/// Copies the parts' positions and cells back to the whole mesh on the root. *Collective.*
void gather_mesh(const Communicator& comm, const Mesh& part, const MeshOrder& order, Mesh& whole);

/// Gathers a distributed mesh on the root, nodes and cells in global order, with its boundaries and strips;
/// other ranks return a mesh without nodes. *Collective.*
Mesh gather_whole(const Communicator& comm, const Mesh& part);

/// Gathers the boundaries alone on the root: a mesh of their nodes, in ascending order, without cells; empty
/// on other ranks, but with the same boundaries. *Collective.*
Mesh gather_boundaries(const Communicator& comm, const Mesh& part);

/// Distributes the root's values evenly, in the order of ranks. *Collective.*
template <class T>
std::vector<T> scatter_evenly(const Communicator& comm, std::span<const T> values) {
  const std::size_t ranks = comm.size();
  std::vector<std::int64_t> counts;
  for (std::size_t rank = 0; rank < ranks; ++rank)
    counts.push_back(values.size() * (rank + 1) / ranks - values.size() * rank / ranks);
  return scatter_from_root(comm, values, counts);
}

template <class T>
std::vector<T> scatter_ordered(const Communicator& comm, std::span<const T> of_whole,
                               const std::vector<std::int32_t>& order) {
  std::vector<T> ordered;
  for (const std::int32_t i : order) {
    if (!of_whole.empty()) ordered.push_back(of_whole[i]);
  }
  return scatter_evenly(comm, std::span<const T>(ordered));
}

template <std::ranges::contiguous_range Values>
std::vector<std::ranges::range_value_t<Values>> scatter_nodes(const Communicator& comm,
                                                              const Values& of_whole,
                                                              const MeshOrder& order) {
  return scatter_ordered(comm, std::span<const std::ranges::range_value_t<Values>>(of_whole), order.nodes);
}

template <class T>
std::vector<T> scatter_triangles(const Communicator& comm, const std::vector<T>& of_whole,
                                 const MeshOrder& order) {
  return scatter_ordered(comm, std::span<const T>(of_whole), order.triangles);
}

}  // namespace quadloop
