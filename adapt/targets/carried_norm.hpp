#pragma once

#include <vector>

#include "adapt/metric/algebra/tensor.hpp"
#include "adapt/transfer/transfer.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Symmetric matrices as the variables xx, xy, yy of a field, a row for each node.
Field rows_of(const std::vector<Symmetric>& matrices, std::int32_t owned_nodes);

/// The matrices at the owned nodes of one mesh, brought to the owned nodes and copies of another one of the
/// same domain. *Collective.*
template <class Value>
std::vector<Value> carried(const Communicator& comm, const Mesh& from, const Field& rows, const Mesh& to) {
  const Field there = with_copies(comm, to, transfer(comm, from, rows, to).field);
  std::vector<Value> values;
  for (std::size_t i = 0; i < there.values.size(); i += 3)
    values.emplace_back(Symmetric{there.values[i], there.values[i + 1], there.values[i + 2]});
  return values;
}

/// The L^p norm of what linear interpolation in a mesh's cells loses of a function with these absolute second
/// derivatives at its owned nodes and copies; p >= 1. Each cell has the mean of its nodes; the mean error is
/// that of interpolation_error(). The same bits on any number of ranks. *Collective.*
double norm_by_bends(const Communicator& comm, const Mesh& mesh, const std::vector<Symmetric>& bends,
                     double p);

/// The places of a mesh's nodes, of all that were looked at, at which that norm is least: the second
/// derivatives of a solved mesh are brought to where nodes are.
class BestPlaces {
 public:
  /// `bends` are rows_of() the solved mesh's nodes. All must outlive it but `mesh`, whose places are the
  /// first. *Collective.*
  BestPlaces(const Communicator& comm, const Mesh& solved, const Field& bends, double p, const Mesh& mesh);

  /// The same cells with their nodes elsewhere. *Collective.*
  void look_at(const Mesh& mesh);

  double first() const { return first_; }  ///< the norm before any move
  double least() const { return least_; }
  const decltype(Mesh::points)& places() const { return places_; }

 private:
  double norm_on(const Mesh& mesh) const;

  const Communicator& comm_;
  const Mesh& solved_;
  const Field& bends_;
  double p_, first_, least_;
  decltype(Mesh::points) places_;
};

}  // namespace quadloop
