#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/exchange.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// An order of a whole mesh's nodes and cells in which neighbours stand near each other, so that ranks which
/// take it in pieces share little. Entry i is the number, in the whole mesh, of the i-th node or cell.
struct MeshOrder {
  std::vector<std::int32_t> nodes, triangles, quads;
};

/// Nodes along a space-filling curve over the mesh's box, cells by their first node along it. A function of
/// the mesh alone, linear but for sorting.
MeshOrder space_filling_order(const Mesh& whole);

/// Nodes and cells as the mesh numbers them.
MeshOrder own_order(const Mesh& whole);

/// The mesh's own order where neighbours stand near each other in it, as in meshes that were made along a
/// curve, else space_filling_order(): what is computed on such a mesh again goes the same way, bit for bit.
MeshOrder order_for_parts(const Mesh& whole);

/// Spreads a mesh that the root rank holds whole over all ranks, in the order given: an even share of nodes,
/// triangles, quads and boundary edges for each. `whole` and `order` count on the root alone. *Collective.*
Mesh scatter_mesh(const Communicator& comm, const Mesh& whole, const MeshOrder& order);

/// The values of each rank's owned nodes, from one for each node of the whole mesh on the root, or from none.
/// *Collective.*
template <std::ranges::contiguous_range Values>
std::vector<std::ranges::range_value_t<Values>> scatter_nodes(const Communicator& comm,
                                                              const Values& of_whole, const MeshOrder& order);

/// The same for each rank's triangles. *Collective.*
template <class T>
std::vector<T> scatter_triangles(const Communicator& comm, const std::vector<T>& of_whole,
                                 const MeshOrder& order);

/// The root's field on a whole mesh, spread over the ranks as scatter_mesh() spread the mesh, into `part`, in
/// the same order. `of_whole` and `order` count on the root alone. *Collective.*
Field scatter_field(const Communicator& comm, const Field& of_whole, const Mesh& part,
                    const MeshOrder& order);

/// The way back: on the root the field on the whole mesh, elsewhere one without values. Rows of copies must
/// not stand in `field`. *Collective.*
Field gather_field(const Communicator& comm, const Field& field, const Mesh& part, const MeshOrder& order);

/// Puts the parts' positions and cells back into their places in the whole mesh on the root. *Collective.*
void gather_mesh(const Communicator& comm, const Mesh& part, const MeshOrder& order, Mesh& whole);

/// A distributed mesh whole on the root, nodes and cells in their global order, with its boundaries and
/// strips; elsewhere one without nodes. *Collective.*
Mesh gather_whole(const Communicator& comm, const Mesh& part);

/// Even shares of the root's values, in the order of ranks. *Collective.*
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
