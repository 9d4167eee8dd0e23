#pragma once

#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// What is lost in each of this rank's cells, triangles, then quads, where variables are taken to be linear
/// in it (in quads bilinear), each over its range; of several variables the most.
struct InterpolationError {
  std::vector<double> mean;   ///< mean of the absolute error over the cell
  std::vector<double> bends;  ///< the largest second derivative in any direction at any node, 1 / length^2
  std::vector<double> areas;  ///< of the cells
};

/// From the hessians recovered in the cells: the mean error of a quadratic of hessian H is
/// sum(e^T |H| e) / 24 over the edges e of a triangle, or of a parallelogram along the axes of H, and for
/// others a bound in the same units. Throws InputError on all ranks for a value that is not finite. The same
/// bits on any number of ranks. *Collective.*
InterpolationError interpolation_error(const Communicator& comm, const Mesh& mesh, const Field& field);

/// The L^p norm of the error over the mesh: the p-th root of the sum of area * mean^p. The same bits on any
/// number of ranks. *Collective.*
double norm_of(const Communicator& comm, const InterpolationError& error, double p);

/// For each cell nodes per area, but for a factor, that make the L^p norm least for their number:
/// bends^(p / (p + 1)). For a complexity N, the integral of 1 / h^2, the sizes are
/// h = (integral of the density / (N * density))^(1/2): the optimum of Loseille and Alauzet's continuous
/// meshes (SIAM J. Numer. Anal. 49, 2011) among those that do not stretch.
std::vector<double> cell_densities(const InterpolationError& error, double p);

}  // namespace quadloop
