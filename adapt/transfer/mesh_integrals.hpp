#pragma once

#include <vector>

#include "adapt/transfer/locate/cell_triangles.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop::adapt {

/// For each variable the sum of area times mean corner value over the triangles (parts_of()) of all ranks;
/// the same bits on any number of ranks. The field has rows for ghost copies. *Collective.*
std::vector<double> integrate(const Communicator& comm, const Mesh& mesh, Point centre, const Field& field);

/// Same, together with the integrals of the variables' absolute values. *Collective.*
struct NodalIntegrals {
  std::vector<double> values, sizes;
};
NodalIntegrals integrate_with_sizes(const Communicator& comm, const Mesh& mesh, Point centre,
                                    const Field& field);

/// For each cell variable the sums of area times mean, and of area times absolute mean, over the cells of all
/// ranks; the same bits on any number of ranks.
struct CellIntegrals {
  std::vector<double> values, sizes;
};
/// *Collective.*
CellIntegrals integrate_cells(const Communicator& comm, const Mesh& mesh, const CellValues& cells);

/// Total area of the cells of all ranks; the same bits on any number of ranks. *Collective.*
double total_area(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop::adapt
