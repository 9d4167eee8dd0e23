#pragma once

#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// Interpolation error in each local cell (triangles, then quadrilaterals) for linear (bilinear)
/// interpolation of variables scaled to their range; the largest of several variables.
struct InterpolationError {
  std::vector<double> mean;   ///< mean of the absolute error over the cell
  std::vector<double> bends;  ///< largest second derivative in any direction at any node, 1 / length^2
  std::vector<double> areas;  ///< of the cells
};

/// Computed from the Hessians recovered in the cells. For a quadratic with Hessian H the mean error is
/// sum(e^T |H| e) / 24 over the edges e of a triangle, or of a parallelogram along the axes of H; for other
/// cells this is a bound in the same units. Throws InputError on all ranks for a value that is not finite.
/// The same bits on any number of ranks. *Collective.*
InterpolationError interpolation_error(const Communicator& comm, const Mesh& mesh, const Field& field);

/// The L^p norm of the error over the mesh: (sum of area * mean^p)^(1/p). The same bits on any number of
/// ranks. *Collective.*
double norm_of(const Communicator& comm, const InterpolationError& error, double p);

/// For each cell the node density, up to a common factor, that minimises the L^p norm for a given number of
/// nodes: bends^(p / (p + 1)). For a complexity N, the integral of 1 / h^2, the sizes are h = (integral of
/// the density / (N * density))^(1/2): the optimum of Loseille and Alauzet's continuous meshes (SIAM J.
/// Numer. Anal. 49, 2011) among isotropic meshes.
std::vector<double> cell_densities(const InterpolationError& error, double p);

}  // namespace quadloop::adapt
