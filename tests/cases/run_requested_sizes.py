#!/usr/bin/env python3
"""Requested cell sizes: along a wall with a spacing, and in the field with spacing.max, the median edge is within 10 % of the request, for
random sizes, for each shape of the far field and for both types of mesh. A few meshes are made on several numbers of ranks.

    run_requested_sizes.py --quadloop PROGRAM [--count N] [--ranks 2 3 5]
"""
import argparse
import math
import random
import statistics
import tempfile
from pathlib import Path

from quadloop_runs import NativeMesh, digest, fail, judge_mesh, mesh_case

TOLERANCE = 0.1
SHAPES = ("square", "rectangle", "circle", "c")
RADIUS = 5.0
FORMATS = "[output]\nformats = [\"mesh\", \"cgns\"]\n"


def write_outlines(folder):
    """Curves of few points, so that these request no small cells; and polygons."""
    lens = [(math.cos(t), 0.6 * math.sin(t)) for t in (-2 * math.pi * i / 16 for i in range(16))]
    lines = {"wall": lens, "frame": [(0, 0), (2.5, 0), (2.5, 1), (0, 1)], "step": [(0, 0), (1, 0), (1, -0.4), (3, -0.4), (3, 1), (0, 1)],
             "lozenge": [(0, -1), (2.2, 0.3), (0.4, 1.1), (-1.3, 0)]}
    for name, points in lines.items():
        rows = "".join(f"{x!r} {y!r}\n" for x, y in points)
        (folder / f"{name}.geom").write_text(f"1\n{name}\n{len(points)}\n{rows}")


def length(mesh, edge):
    a, b = (mesh.nodes[node] for node in edge)
    return math.hypot(a[0] - b[0], a[1] - b[1])


def edges_in_field(mesh):
    """All edges of cells that do not touch the boundary."""
    on_boundary = {node for edges in mesh.boundaries.values() for edge in edges for node in edge}
    edges = set()
    for cell in mesh.cells:
        if on_boundary.isdisjoint(cell):
            edges |= {tuple(sorted(edge)) for edge in zip(cell, cell[1:] + cell[:1])}
    return edges


def median(mesh, edges):
    return statistics.median(length(mesh, edge) for edge in edges)


class Trial:
    """Meshes of cases in one folder."""

    def __init__(self, quadloop, folder, ranks):
        self.quadloop, self.folder, self.ranks = quadloop, folder, ranks
        write_outlines(folder)

    def mesh(self, text, mesh_type, with_ranks):
        case, prefix = self.folder / "case.toml", self.folder / "mesh"
        case.write_text(text + FORMATS)
        mesh_case(self.quadloop, case, prefix, options=["--type", mesh_type])
        judge_mesh(prefix, delaunay=mesh_type == "delaunay")
        for ranks in self.ranks if with_ranks else ():
            other = self.folder / "other"
            mesh_case(self.quadloop, case, other, ranks, ["--type", mesh_type])
            for suffix in (".mesh", ".tree.h5"):
                if digest(f"{prefix}{suffix}") != digest(f"{other}{suffix}"):
                    fail(f"{text}: another {suffix} on {ranks} ranks")
        return NativeMesh(f"{prefix}.mesh")

    def expect(self, text, mesh_type, what, mesh, edges, request):
        ratio = median(mesh, edges) / request
        print(f"{mesh_type}, {what}: {ratio:.3f} of the requested {request:.4g}", flush=True)
        if abs(ratio - 1) > TOLERANCE:
            fail(f"{what} is {ratio:.3f} of the requested {request} in\n{text}")

    def far_field(self, shape, mesh_type, spacing, with_ranks):
        """The spacing of the far field is that of the wall times a power of two."""
        outside = spacing * 2 ** round(math.log2(0.14 / spacing))
        text = (f'[geometry]\nfile = "wall.geom"\nspline = true\nfar_field = {{ shape = "{shape}", radius = {RADIUS}, spacing = {outside} }}\n'
                f"[spacing]\nmax = {2 * outside}\n[boundary.wall]\nspacing = {spacing}\n")
        mesh = self.mesh(text, mesh_type, with_ranks)
        self.expect(text, mesh_type, f"a wall in a far field of shape {shape}", mesh, mesh.boundaries["wall"], spacing)
        self.expect(text, mesh_type, f"a far field of shape {shape}", mesh, mesh.boundaries["farfield"], outside)
        if shape in ("circle", "c"):
            self.expect_round(mesh, shape)

    def expect_round(self, mesh, shape):
        for edge in mesh.boundaries["farfield"]:
            x, y = mesh.nodes[edge[0]]
            if (shape == "circle" or x < 0) and abs(math.hypot(x, y) - RADIUS) > 1e-11 * RADIUS:
                fail(f"the node ({x}, {y}) of the far field is not on its circle")

    def largest_size(self, outline, mesh_type, size, with_ranks):
        text = f'[geometry]\nfile = "{outline}.geom"\n[spacing]\nmax = {size}\n'
        mesh = self.mesh(text, mesh_type, with_ranks)
        self.expect(text, mesh_type, f"spacing.max in the outline {outline}", mesh, edges_in_field(mesh), size)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--count", type=int, default=1, help="random sizes of each kind")
    parser.add_argument("--ranks", type=int, nargs="*", default=[2, 3, 5])
    args = parser.parse_args()
    sizes = random.Random(20261126)
    with tempfile.TemporaryDirectory(prefix="quadloop_requested_sizes_") as name:
        trial = Trial(args.quadloop, Path(name), args.ranks)
        for i in range(args.count):
            for mesh_type in ("hybrid", "delaunay"):
                for shape in SHAPES:
                    trial.far_field(shape, mesh_type, math.exp(sizes.uniform(math.log(0.01), math.log(0.04))), i == 0)
                for outline in ("frame", "step", "lozenge"):
                    trial.largest_size(outline, mesh_type, math.exp(sizes.uniform(math.log(0.03), math.log(0.12))), i == 0)
    print("good")


if __name__ == "__main__":
    main()
