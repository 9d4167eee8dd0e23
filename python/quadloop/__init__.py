"""Parallel 2D mesh generation, smoothing and adaptive remeshing for flow solvers.

    import numpy as np, quadloop as ql
    case = ql.Case(outlines={"airfoil": ql.spline(points)}, geometry={"far_field": 50.0}, spacing={"max": 5.0},
                   boundary={"airfoil": {"spacing": 0.01, "bc": "wall"}})
    mesh = ql.mesh(case)
    mesh.points, mesh.triangles, mesh.quads, mesh.edges["airfoil"]
    mesh.write("airfoil.su2")

The keyword arguments of `Case` are the tables of a case file, with the same keys. On several ranks pass mpi4py's
communicator as `comm`: each rank holds its part of the mesh, and all ranks call the same functions in the same
order. The mesh is the same, bit for bit, on any number of ranks. Lengths are in the unit of the outlines.

Errors: InputError (a ValueError) for a case, mesh or field that cannot be used; TooFar (an InputError) for a mesh that cannot
follow a change of its outline, with the share of the change that it can follow; SolverError (a RuntimeError);
OutputError (an OSError). The message names the key or the place, and a remedy. Warnings go to `warnings.warn` with
the category QuadloopWarning, log lines to the logger "quadloop", which is silent without a handler. Ctrl-C takes effect at the
next stage of a call.
"""
import atexit

from . import _core
from ._adaptation import AdaptationCycle, TransferMap, adapt
from ._cases import Case, Outline, curve, keys, polygon, spline
from ._common import Progress, QuadloopWarning, log
from ._core import Cancelled, InputError, OutputError, SolverError, TooFar
from ._design import Evaluation, Morphed, Run
from ._flow import Flow, Functional, solve
from ._meshes import LayerReport, Mesh, Quality, from_arrays, from_meshio, mesh, read, smooth

__all__ = ["AdaptationCycle", "Cancelled", "Case", "Evaluation", "Flow", "Functional", "InputError", "LayerReport", "Mesh", "Morphed", "Outline",
           "OutputError", "Progress", "QuadloopWarning", "Quality", "Run", "SolverError", "TooFar", "TransferMap", "adapt", "curve", "from_arrays", "from_meshio",
           "keys", "mesh", "polygon", "read", "smooth", "solve", "spline"]

_core.log_to(log)
atexit.register(_core.finish)
