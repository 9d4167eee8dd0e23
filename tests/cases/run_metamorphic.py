#!/usr/bin/env python3
"""What must happen to the mesh when something is done to the geometry:

    scale_up, scale_down, mirror_x, mirror_y, turn, transpose    the same mesh under that map, bit for bit
    shift, split                            the same numbers and connectivity, nodes within 1e-12 of the extent
    reorder                                 the same mesh

The lattice is moved along by [mesh] root. Lengths are dyadic or given, so that the maps are exact in floating point.

    run_metamorphic.py --quadloop PROGRAM --subject NAME [--map NAME ...] [--type delaunay]
"""
import argparse
import tempfile
from dataclasses import dataclass, field, replace
from pathlib import Path

from outline import Entry, koch, map_outline, read_outline, split_at_midpoints, square, write_outline
from quadloop_runs import ROOT, NativeMesh, fail, mesh_case

CLOSE = 1e-12  # of the extent


@dataclass
class Subject:
    """A geometry with what a case file says about it; lengths in its own units."""
    entries: list
    root: tuple  # x0, y0, edge, trees along x and y
    min: float
    max: float
    spacing: float  # of every boundary but the far field
    corner: float = 30
    more: dict = field(default_factory=dict)  # keys of [spacing] without a length
    layers: tuple = ()  # of every boundary but the far field: first height over `spacing`, growth, count
    ties: bool = False  # distances on this lattice are equal but for rounding: shift and split, which round anew, may break them otherwise

    def write(self, folder):
        folder.mkdir()
        write_outline(folder / "outline.geom", self.entries)
        lines = ['[geometry]', 'file = "outline.geom"', '[spacing]', f"min = {self.min!r}", f"max = {self.max!r}", f"corner = {self.corner!r}"]
        lines += [f"{key} = {value!r}" for key, value in self.more.items()]
        for name in dict.fromkeys(entry.name for entry in self.entries):
            lines += [f'[boundary."{name}"]', f"spacing = {self.max if name == 'farfield' else self.spacing!r}"]
            if self.layers and name != "farfield":
                lines += [f"layers = {{ first = {self.layers[0] * self.spacing!r}, growth = {self.layers[1]!r}, count = {self.layers[2]} }}"]
        x0, y0, edge, columns, rows = self.root
        lines += ["[mesh]", f"root = [{x0!r}, {y0!r}, {edge!r}, {columns}, {rows}]", "[output]", 'formats = ["mesh"]']
        case = folder / "case.toml"
        case.write_text("\n".join(lines) + "\n")
        return case


def small():
    """Vertices on lattice lines and corners, edges along lattice lines, a tilted square, a thin wedge."""
    diamond = Entry("diamond", False, ((0.25, 0.0), (0.0, -0.25), (-0.25, 0.0), (0.0, 0.25)))
    wedge = Entry("wedge", False, ((0.5, 0.5), (0.5, 0.53125), (0.875, 0.515625)))
    step = Entry("step", False, ((-0.75, -0.75), (-0.75, -0.5), (-0.625, -0.5), (-0.625, -0.625), (-0.5, -0.625), (-0.5, -0.75)))
    return Subject([square("farfield", -1.0, -1.0, 2.0), diamond, wedge, step], (-1.0, -1.0, 2.0, 1, 1), 1 / 256, 0.25, 1 / 32)


def snowflake():
    return Subject([square("farfield", -2.0, -2.0, 4.0), koch("snow", (0.1, 0.05), 1.0, 3)], (-2.0, -2.0, 4.0, 1, 1), 1 / 128, 0.5, 1 / 16, ties=True)


def brick():
    """A domain that is not square, inside its root on no side."""
    channel = Entry("channel", False, ((0.11, 0.13), (2.87, 0.29), (2.87, 0.89), (1.61, 0.71), (0.11, 0.87)))
    return Subject([channel], (0.0, 0.0, 1.0, 3, 1), 1 / 256, 0.25, 1 / 32)


def shipped(path, root, minimum, maximum, spacing, corner=30, ties=False, **more):
    return Subject(read_outline(ROOT / "cases" / path), root, minimum, maximum, spacing, corner, more, ties=ties)


def layered_airfoil():
    """Its stations follow from where the points stand, so that others between them make another front: no split; nor do lengths add up alike when
    it is shifted."""
    airfoil = shipped("naca4412/naca4412.geom", (-9.5, -10.0, 20.0, 1, 1), 0.002, 1.0, 0.01, curvature=10.0)
    return with_far_field(replace(airfoil, layers=(1 / 512, 1.25, 20), ties=True))


SUBJECTS = {
    "small": small,
    "snowflake": snowflake,
    "brick": brick,
    "naca0012": lambda: with_far_field(shipped("naca0012/naca0012.geom", (-9.5, -10.0, 20.0, 1, 1), 0.004, 1.0, 0.01, curvature=10.0)),
    "naca4412_layers": layered_airfoil,
    "three_element": lambda: shipped("three_element/three_element.geom", (-9.5, -10.0, 20.0, 1, 1), 0.002, 1.0, 0.005, gap=2),
    "catamaran": lambda: shipped("catamaran_x_coarse/catamaran_x_mid.geom", (-64.0, -40.0, 128.0, 1, 1), 0.125, 16.0, 0.25, ties=True),
    "catamaran_askew": lambda: shipped("catamaran_x_coarse/catamaran_x_mid.geom", (-65.3125, -43.1875, 130.625, 1, 1), 0.125, 16.0, 0.25),
    "gulf": lambda: shipped("gulf_of_mexico/gulf_of_mexico_coarse.geom", (-1024.0, -1024.0, 2048.0, 1, 1), 2.0, 64.0, 4.0, corner=180),
}


def with_far_field(subject):
    x0, y0, edge, _, _ = subject.root
    return replace(subject, entries=[square("farfield", x0, y0, edge), *subject.entries])


def scaled(subject, factor):
    entries = map_outline(subject.entries, lambda x, y: (factor * x, factor * y))
    x0, y0, edge, columns, rows = subject.root
    return replace(subject, entries=entries, root=(factor * x0, factor * y0, factor * edge, columns, rows), min=factor * subject.min,
                   max=factor * subject.max, spacing=factor * subject.spacing)


def moved(subject, point_map, mirrored, turned=False):
    """Under a map that takes the axes to the axes; the root's box is mapped along."""
    x0, y0, edge, columns, rows = subject.root
    corners = [point_map(x0, y0), point_map(x0 + columns * edge, y0 + rows * edge)]
    if turned:
        columns, rows = rows, columns
    root = (min(c[0] for c in corners), min(c[1] for c in corners), edge, columns, rows)
    return replace(subject, entries=map_outline(subject.entries, point_map, mirrored), root=root)


def same_under(point_map, mirrored=False):
    def compare(before, after):
        expected, found = before.mapped(point_map, mirrored).canonical(), after.canonical()
        for what, left, right in zip(("nodes", "cells", "boundaries"), expected, found):
            if left != right:
                fail(f"the {what} are not the mapped ones: {difference(left, right)}")
    return compare


def difference(left, right):
    if isinstance(left, dict):
        names = [name for name in left.keys() | right.keys() if left.get(name) != right.get(name)]
        return f"boundaries {names[:4]}"
    return f"{len(left)} and {len(right)}, only before: {sorted(set(left) - set(right))[:3]}, only after: {sorted(set(right) - set(left))[:3]}"


def same_numbers(dx=0.0, dy=0.0):
    def rows_of(mesh):  # by node numbers, whichever corner of a cell comes first
        return sorted(cell[cell.index(min(cell)):] + cell[:cell.index(min(cell))] for cell in mesh.cells), mesh.boundaries

    def compare(before, after):
        if rows_of(before) != rows_of(after):
            fail(f"the connectivity changed: {len(before.cells)} and {len(after.cells)} cells")
        bound = CLOSE * before.extent()
        for (ax, ay), (bx, by) in zip(before.nodes, after.nodes):
            if max(abs(ax + dx - bx), abs(ay + dy - by)) > bound:
                fail(f"node ({ax!r}, {ay!r}) came to ({bx!r}, {by!r})")
    return compare


def map_table(subject):
    """{name: (the subject after it, how the meshes before and after compare)}"""
    edge = subject.root[2]
    dx, dy = 3 * edge, -edge  # exact in the lattice; the geometry's own points are rounded
    def scale(k):
        return scaled(subject, 2.0**k), same_under(lambda x, y: (2.0**k * x, 2.0**k * y))
    def move(point_map, mirrored, turned=False):
        return moved(subject, point_map, mirrored, turned), same_under(point_map, mirrored)
    return {
        "scale_up": scale(7),
        "scale_down": scale(-5),
        "mirror_x": move(lambda x, y: (-x, y), True),
        "mirror_y": move(lambda x, y: (x, -y), True),
        "turn": move(lambda x, y: (-y, x), False, True),
        "transpose": move(lambda x, y: (y, x), True, True),
        "shift": (moved(subject, lambda x, y: (x + dx, y + dy), False), same_numbers(dx, dy)),
        "split": (replace(subject, entries=split_at_midpoints(subject.entries)), same_numbers()),
        "reorder": (replace(subject, entries=subject.entries[::-1]), same_under(lambda x, y: (x, y))),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--subject", required=True, choices=SUBJECTS)
    parser.add_argument("--map", nargs="+")
    parser.add_argument("--type", choices=("hybrid", "delaunay"), default="hybrid")
    args = parser.parse_args()
    subject = SUBJECTS[args.subject]()
    with tempfile.TemporaryDirectory(prefix="quadloop_metamorphic_") as folder:
        work = Path(folder)

        def mesh_of(case_subject, name):
            mesh_case(args.quadloop, case_subject.write(work / name), work / f"{name}_out", options=["--type", args.type, "--set", "smooth.sweeps=0"])
            return NativeMesh(work / f"{name}_out.mesh")

        before = mesh_of(subject, "before")
        for name, (after, compare) in map_table(subject).items():
            if (args.map and name not in args.map) or (subject.ties and name in ("shift", "split")):
                continue
            print(f"{args.subject} under {name}")
            compare(before, mesh_of(after, name))
    print("good")


if __name__ == "__main__":
    main()
