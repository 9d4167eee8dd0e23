#!/usr/bin/env python3
"""Small case files with keys and outlines at random, meshed and sometimes adapted or smoothed: on any number of ranks the exit status, the words and
the bytes of the files are those of one rank, and a mesh that is written passes `check`. Seeded.

    run_random_cases.py --quadloop PROGRAM --count 30 [--first 0] [--ranks 3] [--keep FOLDER]
"""
import argparse
import filecmp
import math
import os
import random
import subprocess
import sys
import tempfile
from pathlib import Path

MPIRUN = Path(__file__).resolve().parents[2] / "scripts" / "mpirun"
STATUSES = (0, 1, 2, 3, 4)  # 70 is a mistake of the program's own
FORMATS = ["mesh", "vtu", "su2", "qmesh", "msh"]


def polygon(draw, x, y, radius):
    """Star-shaped, clockwise or not; corners now and then on lines of a lattice."""
    corners, lattice = draw.randrange(3, 12), draw.choice((0, 0, 8, 32))
    points = []
    for k in range(corners):
        angle, r = 2 * math.pi * (k + 0.7 * draw.random()) / corners, radius * (0.3 + 0.7 * draw.random())
        p = (x + r * math.cos(angle), y + r * math.sin(angle))
        points.append(tuple(round(c * lattice) / lattice for c in p) if lattice else p)
    return points[::draw.choice((1, -1))]


def loop_text(name, points):
    return f"{name}\n{len(points)}\n" + "".join(f"{x!r} {y!r}\n" for x, y in points)


def outline(draw):
    """(the file, the names of its boundaries): a box with one to three bodies in a row, or one body that holds the domain."""
    if draw.random() < 0.2:
        return "1\n" + loop_text("body_0", polygon(draw, 0, 0, 2)), ["body_0"]
    bodies = draw.randrange(1, 4)
    loops = [loop_text(f"body_{k}", polygon(draw, 1.5 * k - 1.5, 0.3 * k, 0.7)) for k in range(bodies)]
    box = loop_text("box", [(-4, -4), (4, -4), (4, 4), (-4, 4)])
    return f"{bodies + 1}\n" + box + "".join(loops), ["box", *(f"body_{k}" for k in range(bodies))]


def layers_text(draw):
    growth = draw.choice(("1.2", "1.5", "[1.1, 1.5]"))
    size = draw.choice(("count = 3", "count = 12", "thickness = 0.2"))
    return f"{{ first = {draw.choice((0.001, 0.01, 0.05))}, growth = {growth}, {size}, equal = {draw.choice((1, 1, 3))} }}"


def boundaries(draw, names):
    rows = []
    for name in names:
        if draw.random() < 0.3:
            continue
        rows += [f"[boundary.{name}]", 'bc = "farfield"' if name == "box" else 'bc = "wall"']
        for key, values in (("spacing", (0.1, 0.25, 0.5)), ("corner", (10, 30, 180)), ("corner_spacing", (0.05, 0.1))):
            if draw.random() < 0.3:
                rows.append(f"{key} = {draw.choice(values)}")
        if name != "box" and draw.random() < 0.35:
            rows.append(f"layers = {layers_text(draw)}")
    return rows


def line_in_domain(draw):
    if draw.random() < 0.85:
        return []
    return ["[[layer_line]]", "path = [[-2.5, -2.5], [0.5, -2.2], [2.5, -2.5]]", f"spacing = {draw.choice((0.1, 0.2))}", "first = 0.01", "count = 4"]


def case(draw, names):
    smallest = draw.choice((0.03, 0.05, 0.125, 0.2))
    rows = ["[geometry]", 'file = "outline.geom"', f'vanish = "{draw.choice(("allow", "error"))}"']
    if draw.random() < 0.3:
        rows.append(f"rotate = {draw.choice((90, 12.5, -7))}")
    if draw.random() < 0.2:
        rows.append("translate = [0.1, -1000.3]")
    rows += ["[spacing]", f"min = {smallest}", f"max = {smallest * draw.choice((2, 4, 16))}", f"gradation = {draw.choice((1.2, 1.5, 2.0))}"]
    rows += ["curvature = 12"] * (draw.random() < 0.3) + ["gap = 3"] * (draw.random() < 0.3)
    rows += ["[mesh]", f'type = "{draw.choice(("hybrid", "hybrid", "delaunay"))}"', f'quads = "{draw.choice(("all", "all", "parallel"))}"',
             f"snap = {draw.choice((0, 0.001, 0.3, 0.4, 0.49))}"]
    rows += ["root = [-6, -6, 4, 3, 3]"] * (draw.random() < 0.2)
    rows += ["[smooth]", f"sweeps = {draw.choice((0, 1, 3, 20))}", f'objective = "{draw.choice(("power", "thesis"))}"',
             f'method = "{draw.choice(("perturb", "perturb", "nlopt"))}"']
    if draw.random() < 0.3:
        rows += ["[[source]]", draw.choice(("disc = [0.3, 0.7, 0.2]", "box = [1, 2, -1, 0.5]", "line = [-3, -3, 3, 2.9]")), f"spacing = {smallest}"]
    rows += boundaries(draw, names) + line_in_domain(draw)
    rows += ["[output]", f"formats = {draw.sample(FORMATS, 2) + ['mesh']!r}".replace("'", '"')]
    rows += ["partitions = 3"] * (draw.random() < 0.15)
    rows += ["[solver]", "mach = 0.3", "iterations = 3", "[adapt]", "cycles = 1", f'threshold = "{draw.choice(("deviation", "fraction"))}"',
             f'indicator = "{draw.choice(("difference", "gradient", "hessian"))}"', f'transfer = "{draw.choice(("linear", "conservative"))}"']
    return "\n".join(rows) + "\n"


def commands(draw):
    """What is done with the case: it is meshed, and half of the meshes are then smoothed or solved on and remeshed."""
    yield ["mesh", "case.toml", "-o", "a"]
    then = draw.randrange(4)
    if then == 0:
        yield ["smooth", "a.mesh", "-o", "b.mesh", "--sweeps", "3"]
    if then == 1:
        yield ["solve", "case.toml", "a.mesh", "-o", "s.mesh"]
        yield ["remesh", "case.toml", "--tree", "a.tree.h5", "--solution", "s.mesh", "-o", "c"]


def run(program, ranks, arguments, folder):
    launcher = [str(MPIRUN), "-n", str(ranks)] if ranks > 1 else []
    at_once = dict(os.environ, OMPI_MCA_odls_base_sigkill_timeout="0")
    done = subprocess.run([*launcher, program, *arguments, "--quiet"], cwd=folder, capture_output=True, text=True, timeout=300, env=at_once)
    return done.returncode, [line for line in done.stderr.splitlines() if line.startswith("quadloop")]


def faults_of_meshes(program, folder):
    for name in ("a.mesh", "b.mesh", "c.mesh"):
        if not (folder / name).exists():
            continue
        status, said = run(program, 1, ["check", name], folder)
        if status != 0:
            yield f"{name}: {said}"


def faults(program, seed, ranks, folder):
    """(what is wrong, the status of the first command) with the case of one seed."""
    draw = random.Random(seed)
    text, names = outline(draw)
    folders = {n: folder / f"on_{n}" for n in (1, ranks)}
    case_text, chain = case(draw, names), list(commands(draw))
    for place in folders.values():
        place.mkdir(parents=True)
        (place / "outline.geom").write_text(text)
        (place / "case.toml").write_text(case_text)
    found, first = [], None
    for arguments in chain:
        one, other = (run(program, n, arguments, place) for n, place in folders.items())
        first = one[0] if first is None else first
        if one != other or one[0] not in STATUSES:
            found.append(f"{arguments[0]} ends with {one} on 1 rank and {other} on {ranks}")
        if one[0] != 0:
            break
    left = {n: sorted(path.name for path in place.iterdir()) for n, place in folders.items()}
    if left[1] != left[ranks]:
        found.append(f"files on 1 rank {left[1]}, on {ranks} {left[ranks]}")
    different = [name for name in left[1] if (folders[ranks] / name).exists() and not filecmp.cmp(folders[1] / name, folders[ranks] / name, shallow=False)]
    if different:
        found.append(f"these differ: {different}")
    return found + list(faults_of_meshes(program, folders[1])), first


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--count", type=int, required=True)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--ranks", type=int, default=3)
    parser.add_argument("--keep", type=Path, help="the folder that keeps the cases")
    args = parser.parse_args()
    failed = refused = 0
    with tempfile.TemporaryDirectory(prefix="quadloop_random_") as temporary:
        for seed in range(args.first, args.first + args.count):
            found, first = faults(str(Path(args.quadloop).resolve()), seed, args.ranks, (args.keep or Path(temporary)) / str(seed))
            for what in found:
                print(f"seed {seed}: {what}", flush=True)
            failed += len(found) > 0
            refused += first != 0
    print(f"{args.count} cases, {refused} refused, {failed} with faults")
    return 1 if failed or 2 * refused > args.count else 0


if __name__ == "__main__":
    sys.exit(main())
