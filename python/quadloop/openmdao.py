"""A component of OpenMDAO. Importing this module needs openmdao."""
from __future__ import annotations

import numpy as np
import openmdao.api as om  # type: ignore

from ._core import TooFar


class MeshComponent(om.ExplicitComponent):  # type: ignore
    """The nodes of a mesh as a function of the points of its outlines, with matrix-free derivatives in both directions.

    Inputs: the points of each outline, by its name, shape (n, 2), the same on all ranks. Output: the coordinates of the rank's
    own nodes, flat, 3 numbers for each with 0 as the third; distributed, tagged "mphys_coordinates". A change that the cells
    cannot follow is an AnalysisError, from which optimisers go back.
    """

    def initialize(self):
        self.options.declare("run", desc="a quadloop.Run on the communicator of the component")
        self.options.declare("outlines", default=None, desc="names of the outlines that move; None: all closed polygons of the case")
        self.options.declare("min_quality", default=0.0, desc="least quality of the worst cell, from 0 to 1")
        self.options.declare("output", default="x_aero0", desc="name of the output")

    def setup(self):
        run = self.options["run"]
        self._names = list(self.options["outlines"] or run.outlines)
        self._morphed = None
        for name in self._names:
            self.add_input(name, run.outlines[name], tags=["mphys_coordinates"])
        self.add_output(self.options["output"], _in_space(run.mesh.points[:run.mesh.owned]), distributed=True, tags=["mphys_coordinates"])

    def compute(self, inputs, outputs):
        run = self.options["run"]
        try:
            self._morphed = run.morph({name: inputs[name] for name in self._names}, min_quality=self.options["min_quality"])
        except TooFar as error:
            raise om.AnalysisError(f"{error} ({error.share:.0%} of the change is possible)") from error
        outputs[self.options["output"]] = _in_space(self._morphed.mesh.points[:run.mesh.owned])

    def compute_jacvec_product(self, inputs, d_inputs, d_outputs, mode):
        output = self.options["output"]
        if self._morphed is None or output not in d_outputs:
            return
        if mode == "fwd":
            d_outputs[output] += _in_space(self._morphed.push_forward({name: d_inputs[name] for name in self._names if name in d_inputs}))
            return
        for name, gradient in self._morphed.pull_back(d_outputs[output].reshape(-1, 3)[:, :2]).items():
            if name in d_inputs:
                d_inputs[name] += gradient


def _in_space(plane) -> np.ndarray:
    return np.column_stack([plane, np.zeros(len(plane))]).ravel()
