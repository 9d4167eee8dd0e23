#pragma once

#include <functional>
#include <string>

#include "flow/flow_solver.hpp"

namespace quadloop {

/// A solver of OpenFOAM's, by a case of the user's.
struct OpenfoamSolver {
  static constexpr const char* folder_name = "openfoam";  ///< of the copy, in the cycle's folder

  std::string case_template;  ///< folder with 0, constant and system, absolute
  int ranks = 0;              ///< 0: as many as quadloop runs on
  double timeout = 3600;      ///< seconds
};

/// The solver that the template's system/controlDict names as application. For each mesh the template is
/// copied (openfoam_template.hpp) into the cycle's folder, with the mesh as a polyMesh of one layer, one unit
/// thick, and, from the second mesh on, the values of cells carried over in the place of internalField in the
/// fields of its folder 0 (a folder 0.orig becomes 0). Where there is a system/controlDict.start it runs by
/// that first, a few careful steps, as a state on another mesh is none that the scheme has come to by itself.
/// It runs there alone, or on several ranks between decomposePar and reconstructPar (by its
/// system/decomposeParDict, else in slices along x), or, where the template has an executable Allrun, that
/// runs with the number of ranks as its argument. The solution is what it leaves in the folder of the latest
/// time: fields of cells. Throws InputError for a template that is none, SolverError for what the solver does
/// or leaves.
FlowSolver openfoam_solver(OpenfoamSolver solver, std::function<std::string(int cycle)> folder_of);

}  // namespace quadloop
