#pragma once

#include <string>
#include <vector>

#include "adapt/metric/algebra/tensor.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The absolute hessians, 1 / length^2, of the variables at owned nodes and copies, each variable over its
/// range, of several the intersection. Each has its own determinant, but the shape that those round the node
/// have in the mean: along a front they are noise. No metric asks for cells longer than 15 times their width.
/// Empty where all variables are linear. Throws InputError for a value that is not finite. *Collective.*
std::vector<Symmetric> variable_bends(const Communicator& comm, const Mesh& mesh, const Field& field);

/// What stands in their place where a solver has told its error, `error`'s only variable: the shapes of
/// `bends`, so large that the linear interpolation of a function with these hessians would lose on this mesh,
/// in the mean round each node, as much for each area as the error there (anisotropy from the flow, sizes
/// from the goal: Venditti and Darmofal, J. Comput. Phys. 187, 2003). Empty where there is no error. Throws
/// InputError for an error that is negative or not finite. *Collective.*
std::vector<Symmetric> error_bends(const Communicator& comm, const Mesh& mesh, const Field& error,
                                   std::vector<Symmetric> bends);

}  // namespace quadloop
