#pragma once

#include <string>
#include <vector>

#include "adapt/metric/algebra/tensor.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// The absolute Hessians, 1 / length^2, of the variables at owned nodes and ghost copies, each variable
/// scaled to its range; for several variables their intersection. Each keeps its determinant but has the mean
/// shape of those around the node, as shapes are noisy along shocks. The aspect ratio is limited to 15. Empty
/// if all variables are linear. Throws InputError for a value that is not finite. *Collective.*
std::vector<Symmetric> variable_bends(const Communicator& comm, const Mesh& mesh, const Field& field);

/// The replacement of these Hessians if a solver provides an error estimate, the only variable of `error`:
/// the shapes of `bends`, scaled so that linear interpolation of a function with these Hessians would have on
/// this mesh, in the mean around each node, the same error per area as the estimate (anisotropy from the
/// flow, sizes from the output functional: Venditti and Darmofal, J. Comput. Phys. 187, 2003). Empty if there
/// is no error. Throws InputError for an error that is negative or not finite. *Collective.*
std::vector<Symmetric> error_bends(const Communicator& comm, const Mesh& mesh, const Field& error,
                                   std::vector<Symmetric> bends);

}  // namespace quadloop::adapt
