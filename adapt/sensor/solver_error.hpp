#pragma once

#include <vector>

#include "adapt/sensor/interpolation_error.hpp"

namespace quadloop::adapt {

/// A solver's own error estimate (the field's only variable) in the form used by size fields: each cell's
/// contribution to a total error, as a mean over the cell. A nodal estimate is distributed to the cells
/// around each node by their areas. As contributions fall with the square of the cell size, `mean` over the
/// cell's area replaces the second derivatives. Throws InputError on all ranks for an error that is negative
/// or not finite. The same bits on any number of ranks. *Collective.*
InterpolationError solver_error(const Communicator& comm, const Mesh& mesh, const Field& field);

/// Same at owned nodes and ghost copies: a node's estimate over the node's area; each cell's area is divided
/// equally among its nodes. *Collective.*
std::vector<double> error_densities(const Communicator& comm, const Mesh& mesh, const Field& field);

}  // namespace quadloop::adapt
