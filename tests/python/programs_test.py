"""The programs of docs/how-to/python.md, word for word, on this number of ranks."""
import contextlib
import hashlib
import io
import os
import re
import sys
import tempfile
import types
from pathlib import Path

import numpy as np
from mpi4py import MPI

comm = MPI.COMM_WORLD


def programs(page):
    return re.findall(r"^```python\n(.*?)^```", Path(page).read_text(), re.M | re.S)


def run(text, names=None):
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        exec(compile(text, "program", "exec"), {"__name__": "__main__"} if names is None else names)
    return said.getvalue().splitlines()


class Component:
    """Stands in for the calls of OpenMDAO's ExplicitComponent."""

    def add_input(self, name, value):
        self.inputs = {name: np.array(value)}

    def add_output(self, name, value):
        self.outputs = {name: np.array(value)}


def use_component(text):
    api = types.ModuleType("openmdao.api")
    api.ExplicitComponent, api.AnalysisError = Component, type("AnalysisError", (Exception,), {})
    package = types.ModuleType("openmdao")
    package.api = api
    sys.modules.update({"openmdao": package, "openmdao.api": api})
    names = {"__name__": "component"}
    run(text, names)
    component = names["Nodes"]()
    component.setup()
    oval = component.inputs["outline"].copy()
    component.inputs["outline"] += 0.02 * np.sin(3 * oval[:, ::-1])
    component.compute(component.inputs, component.outputs)
    way, weights = np.cos(oval), np.sin(1 + component.outputs["nodes"])  # terms that do not cancel
    ahead, back = {"nodes": np.zeros_like(weights)}, {"outline": np.zeros_like(oval)}
    component.compute_jacvec_product(component.inputs, {"outline": way}, ahead, "fwd")
    component.compute_jacvec_product(component.inputs, back, {"nodes": weights}, "rev")
    products = (weights * ahead["nodes"]).sum(), (way * back["outline"]).sum()
    assert abs(products[0] - products[1]) < 1e-11 * abs(products[0]), products
    component.inputs["outline"] = 3 * oval
    component.inputs["outline"][::2] *= 0.5
    try:
        component.compute(component.inputs, component.outputs)
    except api.AnalysisError as error:
        assert "of the way" in str(error), error
    else:
        raise AssertionError("cells cannot follow this")


def digest(path):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def main():
    airfoil, adaptation, between, progress, component = programs(sys.argv[1])
    use_component(component)
    counts = [[int(number) for number in line.split()] for line in run(between)]
    assert counts[0][1] == counts[0][2] and all(0 < kept < nodes for _, nodes, kept in counts[1:]), counts
    *stages, reason = run(progress)
    assert "refinement: 0%" in stages and stages[-1] == "smoothing: 0%", stages
    assert reason == "cancelled in stage 'smoothing': the progress callback returned false", reason
    folder = comm.bcast(tempfile.mkdtemp() if comm.rank == 0 else None)
    alone = Path(folder, f"alone{comm.rank}")
    alone.mkdir()
    os.chdir(alone)
    first, second = run(airfoil)  # on each rank for itself
    nodes, angle, coverage = first.split()[:3]
    assert int(nodes) > 5000 and float(angle) > 0 and float(coverage) > 0.9, first
    assert Path("foil.su2").read_text().count("MARKER_TAG") == 2, second
    assert len({*comm.allgather(digest("foil.su2"))}) == 1

    os.chdir(folder)
    said = run(adaptation)
    if comm.rank == 0:
        nodes = [int(line.split()[1]) for line in said]
        assert len(nodes) == 5 and all(b > 1.3 * a for a, b in zip(nodes, nodes[1:])), said
        meshes = [digest(f"run/cycle_{k:02}/mesh.mesh") for k in range(5)]
        print(meshes[-1])
    # the same meshes on one rank
    if comm.rank == 0:
        os.mkdir("one")
        os.chdir("one")
        text = adaptation.replace("comm = MPI.COMM_WORLD", "comm = MPI.COMM_SELF")
        assert text != adaptation
        run(text)
        assert [digest(f"run/cycle_{k:02}/mesh.mesh") for k in range(5)] == meshes
        assert [digest(f"run/cycle_{k:02}/mesh.tree.h5") for k in range(5)] == [digest(f"../run/cycle_{k:02}/mesh.tree.h5") for k in range(5)]
    comm.Barrier()


main()
