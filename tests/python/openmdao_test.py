"""quadloop.openmdao by the calls that OpenMDAO makes of a component, on this number of ranks. OpenMDAO is not in Debian: a stand-in has these calls."""
import sys
import types
import unittest

import numpy as np
from mpi4py import MPI

import quadloop as ql

comm = MPI.COMM_WORLD


class Options(dict):
    def declare(self, name, default=None, desc=""):
        self.setdefault(name, default)


class ExplicitComponent:
    """Stands in for that of OpenMDAO."""

    def __init__(self, **options):
        self.options, self.inputs, self.outputs, self.metadata = Options(), {}, {}, {}
        self.initialize()
        self.options.update(options)
        self.setup()

    def add_input(self, name, value, **metadata):
        self.inputs[name], self.metadata[name] = np.array(value), metadata

    def add_output(self, name, value, **metadata):
        self.outputs[name], self.metadata[name] = np.array(value), metadata


api = types.ModuleType("openmdao.api")
api.ExplicitComponent, api.AnalysisError = ExplicitComponent, type("AnalysisError", (Exception,), {})
package = types.ModuleType("openmdao")
package.api = api
sys.modules.update({"openmdao": package, "openmdao.api": api})

from quadloop.openmdao import MeshComponent  # noqa: E402

ANGLES = np.linspace(0, 2 * np.pi, 40, endpoint=False)
OVAL = np.column_stack([np.cos(ANGLES), 0.5 * np.sin(ANGLES)])
RUN = ql.Run(ql.Case(outlines={"body": OVAL, "flap": 0.2 * OVAL + [2.0, 0.0]}, geometry={"far_field": 8.0}, spacing={"max": 1.0, "min": 0.02},
                     boundary={"body": {"spacing": 0.1}, "flap": {"spacing": 0.05}}), comm)


class Components(unittest.TestCase):
    def test_nodes_and_derivatives(self):
        component = MeshComponent(run=RUN, min_quality=0.1)
        self.assertEqual(set(component.inputs), {"body", "flap"})
        self.assertEqual(component.metadata["x_aero0"], {"distributed": True, "tags": ["mphys_coordinates"]})
        self.assertEqual(component.outputs["x_aero0"].shape, (3 * RUN.mesh.owned,))
        component.inputs["body"] += 0.02 * np.sin(3 * OVAL[:, ::-1])
        component.compute(component.inputs, component.outputs)
        nodes = component.outputs["x_aero0"].reshape(-1, 3)
        np.testing.assert_array_equal(nodes[:, :2], RUN.morph(component.inputs).mesh.points[:RUN.mesh.owned])
        self.assertFalse(nodes[:, 2].any())

        ways, weights = {name: np.cos(points) for name, points in component.inputs.items()}, np.sin(1 + component.outputs["x_aero0"])
        ahead = {"x_aero0": np.zeros_like(weights)}
        back = {name: np.zeros_like(points) for name, points in component.inputs.items()}
        component.compute_jacvec_product(component.inputs, ways, ahead, "fwd")
        component.compute_jacvec_product(component.inputs, back, {"x_aero0": weights}, "rev")
        products = comm.allreduce(weights @ ahead["x_aero0"]), sum((ways[name] * back[name]).sum() for name in ways)
        self.assertLess(abs(products[0] - products[1]), 1e-11 * abs(products[0]))
        of_body = {"body": np.zeros_like(OVAL)}  # as OpenMDAO asks when only this input matters
        component.compute_jacvec_product(component.inputs, of_body, {"x_aero0": weights}, "rev")
        np.testing.assert_array_equal(of_body["body"], back["body"])

        ends, step = [], 1e-5
        for sign in (1, -1):
            component.compute({name: points + sign * step * ways[name] for name, points in component.inputs.items()}, component.outputs)
            ends.append(component.outputs["x_aero0"].copy())
        self.assertLess(np.abs((ends[0] - ends[1]) / (2 * step) - ahead["x_aero0"]).max(), 1e-8 * np.abs(ahead["x_aero0"]).max())

    def test_a_change_that_is_too_large_fails_the_analysis(self):
        component = MeshComponent(run=RUN, outlines=["body"], output="nodes")
        self.assertEqual(set(component.inputs), {"body"})
        turn = np.array([[-0.9, -0.4], [0.4, -0.9]])
        with self.assertRaisesRegex(api.AnalysisError, "of the change"):
            component.compute({"body": OVAL @ turn}, component.outputs)


unittest.main(argv=["openmdao_test"])
