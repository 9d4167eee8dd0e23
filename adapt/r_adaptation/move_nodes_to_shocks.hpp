#pragma once

#include <string>
#include <vector>

#include "generate/generate.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop::adapt {

/// Parameters of r-adaptation.
struct TargetDemand {
  std::vector<std::string> variables;  ///< nodal variables of the solution
  double norm = 2;                     ///< the p of the L^p norm of the interpolation error
  double min = 0;                      ///< edge of the smallest leaves, in the geometry's unit
  double stretch = 8;                  ///< largest factor by which a cell is made thinner
  bool facets = false;                 ///< edges at facets may be shorter than half of their segments
};

/// r-adaptation by target matrices: moves the nodes of a tree's mesh, without layers, towards the shocks and
/// shear layers of a solution on another mesh of the domain. The metric of least interpolation error for the
/// same number of nodes gives the target thickness of each cell; the smoother then reduces the cost of the
/// cells against these targets, which are recomputed at the moved nodes. Connectivity and validity of cells
/// are kept; boundary nodes stay on the geometry, and the outer edge of layers does not move. Cells for which
/// the metric requires no smaller sizes, far from others, do not change. If all variables are linear nothing
/// moves and the report gets a warning. The same bits on any number of ranks. Throws InputError if the
/// solution lacks the variables. *Collective.*
void move_nodes_to_shocks(const Communicator& comm, const MeshInput& input, const Mesh& solved,
                          const Field& solution, const TargetDemand& demand, MeshResult& result);

}  // namespace quadloop::adapt
