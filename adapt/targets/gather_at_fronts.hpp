#pragma once

#include <string>
#include <vector>

#include "generate/generate.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop {

/// What cells are to be stretched by.
struct TargetDemand {
  std::vector<std::string> variables;  ///< at the nodes of the mesh that was solved on
  double norm = 2;                     ///< the p of the L^p norm of the interpolation error
  double min = 0;                      ///< the edge of the smallest leaves, in the geometry's unit
  double stretch = 8;                  ///< a cell is made thinner by this at most
  bool facets = false;                 ///< whether edges at facets may be shorter than half of their segments
};

/// Moves the nodes of a mesh that a tree has made, without layers, towards the shocks and layers of a
/// solution on another mesh of the domain: r-adaptation by target matrices. The metric that makes the
/// interpolation error least for as many nodes says how thin each cell is to be where it lies; the smoother
/// then lowers the cost of the cells against these targets, which are made anew where nodes have got to.
/// Cells stay, valid ones valid, boundary nodes on the outline, the front of layers where it is. Cells of
/// which the metric asks no more than the tree gave, far from others, stay as they are. Nothing moves where
/// all variables are linear: a warning is added to the report. The same bits on any number of ranks. Throws
/// InputError where the solution has no such variables. *Collective.*
void gather_at_fronts(const Communicator& comm, const MeshInput& input, const Mesh& solved,
                      const Field& solution, const TargetDemand& demand, MeshResult& result);

}  // namespace quadloop
