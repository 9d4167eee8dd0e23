"""The programs of docs/how-to/python.md, word for word, on this number of ranks."""
import contextlib
import hashlib
import io
import os
import re
import sys
import tempfile
from pathlib import Path

from mpi4py import MPI

comm = MPI.COMM_WORLD


def programs(page):
    return re.findall(r"^```python\n(.*?)^```", Path(page).read_text(), re.M | re.S)


def run(text):
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        exec(compile(text, "program", "exec"), {"__name__": "__main__"})
    return said.getvalue().splitlines()


def digest(path):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def main():
    airfoil, adaptation = programs(sys.argv[1])
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
        names = {"comm": MPI.COMM_SELF}
        text = adaptation.replace("comm = MPI.COMM_WORLD", "comm = MPI.COMM_SELF")
        assert text != adaptation and names
        run(text)
        assert [digest(f"run/cycle_{k:02}/mesh.mesh") for k in range(5)] == meshes
        assert [digest(f"run/cycle_{k:02}/mesh.tree.h5") for k in range(5)] == [digest(f"../run/cycle_{k:02}/mesh.tree.h5") for k in range(5)]
    comm.Barrier()


main()
