#pragma once

#include <vector>

#include "adapt/metric/algebra/tensor.hpp"
#include "adapt/transfer/transfer.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// Symmetric matrices as field variables xx, xy, yy, one row per node.
Field rows_of(const std::vector<Symmetric>& matrices, std::int32_t owned_nodes);

/// Transfers matrices from the owned nodes of one mesh to the owned nodes and ghost copies of another mesh of
/// the same domain. *Collective.*
template <class Value>
std::vector<Value> transferred(const Communicator& comm, const Mesh& from, const Field& rows,
                               const Mesh& to) {
  const Field there = with_ghosts(comm, to, transfer(comm, from, rows, to).field);
  std::vector<Value> values;
  for (std::size_t i = 0; i < there.values.size(); i += 3)
    values.emplace_back(Symmetric{there.values[i], there.values[i + 1], there.values[i + 2]});
  return values;
}

/// The L^p norm (p >= 1) of the linear interpolation error on a mesh for a function with these absolute
/// second derivatives at its owned nodes and ghost copies. Each cell uses the mean of its nodes; the mean
/// error is as in interpolation_error(). The same bits on any number of ranks. *Collective.*
double norm_by_bends(const Communicator& comm, const Mesh& mesh, const std::vector<Symmetric>& bends,
                     double p);

/// Keeps the node positions with the smallest norm among those tested; the second derivatives of the solved
/// mesh are transferred to each set of positions.
class BestPlaces {
 public:
  /// `bends`: rows_of() of the solved mesh's nodes. Initial positions are those of `mesh`. All arguments
  /// except `mesh` must outlive it. *Collective.*
  BestPlaces(const Communicator& comm, const Mesh& solved, const Field& bends, double p, const Mesh& mesh);

  /// Tests the same cells with other node positions. *Collective.*
  void look_at(const Mesh& mesh);

  double first() const { return first_; }  ///< norm before any move
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

}  // namespace quadloop::adapt
