#pragma once

#include <vector>

#include "adapt/transfer/locate/cell_triangles.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop {

/// For each variable area times the mean of the corners, summed over the triangles (parts_of()) of all ranks;
/// the same bits on any number of ranks. The field has rows for copies. *Collective.*
std::vector<double> integrate(const Communicator& comm, const Mesh& mesh, Point centre, const Field& field);

/// The same, and that of the variables' absolute values. *Collective.*
struct NodalIntegrals {
  std::vector<double> values, sizes;
};
NodalIntegrals integrate_with_sizes(const Communicator& comm, const Mesh& mesh, Point centre,
                                    const Field& field);

/// For each variable of the cells area times mean, and area times its absolute value, summed over the cells
/// of all ranks; the same bits on any number of ranks.
struct CellIntegrals {
  std::vector<double> values, sizes;
};
/// *Collective.*
CellIntegrals integrate_cells(const Communicator& comm, const Mesh& mesh, const CellValues& cells);

/// Of the cells of all ranks; the same bits on any number of ranks. *Collective.*
double total_area(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop
