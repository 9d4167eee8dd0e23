#pragma once

#include <vector>

#include "adapt/sensor/interpolation_error.hpp"

namespace quadloop {

/// A solver's own estimate of errors, the field's only variable, as wanted sizes take it: what each cell adds
/// to an error that is their sum, as a mean over the cell. An estimate at nodes is shared out among the cells
/// round each node by their areas. As these parts fall with the second power of the size of cells, to
/// `mean` over the cell's area stands in the place of second derivatives. Throws InputError on all ranks for
/// an error that is negative or not finite. The same bits on any number of ranks. *Collective.*
InterpolationError solver_error(const Communicator& comm, const Mesh& mesh, const Field& field);

/// The same at owned nodes and copies: a node's own estimate over the area that is the node's, of each of its
/// cells as much as of the cell's other nodes. *Collective.*
std::vector<double> error_densities(const Communicator& comm, const Mesh& mesh, const Field& field);

}  // namespace quadloop
