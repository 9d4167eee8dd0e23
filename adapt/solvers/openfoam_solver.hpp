#pragma once

#include <functional>
#include <string>

#include "flow/flow_solver.hpp"

namespace quadloop::adapt {

/// An OpenFOAM solver, specified by a case of the user.
struct OpenfoamSolver {
  static constexpr const char* folder_name = "openfoam";  ///< of the copied case, in the cycle's folder

  std::string case_template;  ///< folder with 0, constant and system; absolute path
  int ranks = 0;              ///< 0: as many as quadloop uses
  double timeout = 3600;      ///< seconds
};

/// Returns the solver that the template's system/controlDict names as application. For each mesh the template
/// (openfoam_template.hpp) is copied into the cycle's folder, with the mesh as a polyMesh extruded by one
/// cell of unit thickness. From the second mesh on, the transferred cell values replace internalField in the
/// fields of its folder 0 (a folder 0.orig becomes 0). If there is a system/controlDict.start, it is used
/// first for a few careful steps, because a transferred state does not satisfy the scheme. The solver runs
/// serially, or in parallel between decomposePar and reconstructPar (with system/decomposeParDict, else in
/// slices along x); if the template has an executable Allrun, that is run with the number of ranks as its
/// argument. The solution is read from the latest time: cell fields. Throws InputError for an invalid
/// template, SolverError if the solver fails or its solution is unusable.
flow::FlowSolver openfoam_solver(OpenfoamSolver solver, std::function<std::string(int cycle)> folder_of);

}  // namespace quadloop::adapt
