#!/usr/bin/env python3
"""Single points that must be nodes: exactly there in each type of mesh, smoothed, with layers and in an adapted run, with their names in each
format that holds them; the same bytes on several numbers of ranks; refused in layers.

    run_single_points.py --quadloop PROGRAM [--ranks 1,2,3,5,8]
"""
import argparse
import random
import subprocess
import sys
import tempfile
from pathlib import Path

from quadloop_runs import MPIRUN, digest, fail, judge_mesh, mesh_case, run

FORMATS = ("mesh", "qmesh", "vtu", "msh", "msh41", "cgns")

CASE = """
[[shape]]
name = "box"
kind = "rectangle"
box = [0, 2, 0, 1]

[[shape]]
name = "body"
kind = "circle"
centre = [0.6, 0.5]
radius = 0.1

[spacing]
max = 0.06
min = 0.005

[boundary.body]
spacing = 0.02
{more}
"""

LAYERS = "layers = { first = 0.002, growth = 1.3, count = 5 }"

ADAPT = """
[adapt]
cycles = 2
variable = "T"
indicator = "difference"
threshold = "fraction"
refine = 0.1
coarsen = 0.0
min = 0.004

[solver]
kind = "command"
command = ["{python}", "{script}", "--solve", "{{mesh}}", "{{solution}}"]
mesh = "mesh.mesh"
solution = "solution.mesh"
"""


def points_of_case():
    """Points away from the body, from the walls and from each other."""
    chosen = random.Random(5)
    points = [(1.0, 0.5), (0.25, 0.125)]  # on lines of the background grid
    while len(points) < 20:
        x, y = chosen.uniform(0.1, 1.9), chosen.uniform(0.1, 0.9)
        if all((x - u) ** 2 + (y - v) ** 2 > 0.1 ** 2 for u, v in points) and (x - 0.6) ** 2 + (y - 0.5) ** 2 > 0.2 ** 2:
            points.append((x, y))
    return {f"probe{i}": point for i, point in enumerate(points)} | {"corner": (2.0, 1.0)}


def tables(points):
    return "".join(f'[[line]]\nname = "{name}"\npath = [[{x!r}, {y!r}]]\n' for name, (x, y) in points.items())


def named_nodes(mesh):
    """The places of the named nodes of a .mesh file."""
    rows = Path(mesh).read_text().splitlines()
    found = {}
    for row in rows:
        if row.startswith("# node "):
            _, _, number, name = row.split()
            found[name] = tuple(map(float, rows[1 + int(number)].split()))
    return found


def said_by(command):
    """All that a command printed."""
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    return done.stdout + done.stderr


def expect_nodes(mesh, points):
    if named_nodes(mesh) != points:
        fail(f"{mesh} has the named nodes {named_nodes(mesh)}")


def solve(mesh, solution):
    rows = Path(mesh).read_text().split("#Number of constants")[0].rstrip("\n") + "\n"
    places = [tuple(map(float, row.split())) for row in rows.splitlines()[2:2 + int(rows.splitlines()[1])]]
    values = "".join(f"{1.0 if x > 1.2 + 0.2 * y else 0.0}\n" for x, y in places)
    Path(solution).write_text(rows + "#Number of constants\n0\n#Number of variables\n1\n#names: T\n" + values)


def check_meshes(args, work, points):
    for name, options in (("hybrid", ()), ("parallel", ("mesh.quads=\"parallel\"",)), ("delaunay", ("mesh.type=\"delaunay\"",)),
                          ("unsmoothed", ("smooth.sweeps=0",)), ("layers", (f"boundary.body.{LAYERS}",)),
                          ("layers_delaunay", (f"boundary.body.{LAYERS}", "mesh.type=\"delaunay\""))):
        case = work / "case.toml"
        prefix = work / name
        sets = [word for option in options for word in ("--set", option)]
        for ranks in args.ranks.split(","):
            other = prefix if ranks == "1" else work / "other"
            mesh_case(args.quadloop, case, other, int(ranks), sets)
            for file in ("mesh", "tree.h5"):
                if digest(f"{other}.{file}") != digest(f"{prefix}.{file}"):
                    fail(f"{name}: {file} differs on {ranks} ranks")
        expect_nodes(f"{prefix}.mesh", points)
        run([args.quadloop, "check", f"{prefix}.mesh"])
        judge_mesh(prefix)


def check_formats(args, work, points):
    for name in FORMATS:
        run([args.quadloop, "convert", work / "hybrid.mesh", work / f"other.{name}"])
        again = work / f"again_{name}.mesh"
        run([args.quadloop, "convert", work / f"other.{name}", again])
        expect_nodes(again, points)
    said = said_by([args.quadloop, "convert", work / "hybrid.mesh", work / "other.su2"])
    if "cannot store the names of nodes, which are omitted" not in said:
        fail(f"lost names of nodes are not reported: {said}")
    run([args.quadloop, "smooth", work / "unsmoothed.mesh", "-o", work / "smoothed.mesh"])
    expect_nodes(work / "smoothed.mesh", points)


def check_adapted(args, work, points):
    case = work / "adapt.toml"
    case.write_text(CASE.format(more="") + tables(points) + ADAPT.format(python=sys.executable, script=Path(__file__).resolve()))
    for ranks in ("1", "3"):
        run([MPIRUN, "-n", ranks, args.quadloop, "adapt", case, "-o", work / f"adapted_{ranks}"])
    for cycle in range(3):
        meshes = [work / f"adapted_{ranks}" / f"cycle_0{cycle}" / "mesh.mesh" for ranks in ("1", "3")]
        if digest(meshes[0]) != digest(meshes[1]):
            fail(f"the mesh of cycle {cycle} differs on 3 ranks")
        expect_nodes(meshes[0], points)


def main():
    if len(sys.argv) == 4 and sys.argv[1] == "--solve":
        return solve(*sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--ranks", default="1,2,3,5,8")
    args = parser.parse_args()
    points = points_of_case()
    with tempfile.TemporaryDirectory(prefix="quadloop_single_points_") as name:
        work = Path(name)
        (work / "case.toml").write_text(CASE.format(more="") + tables(points))
        check_meshes(args, work, points)
        check_formats(args, work, points)
        check_adapted(args, work, points)
        (work / "in_layers.toml").write_text(CASE.format(more=LAYERS) + tables({"near": (0.71, 0.5)}))
        said = said_by([args.quadloop, "mesh", work / "in_layers.toml", "-o", work / "refused"])
        if "point 'near' at (0.71, 0.5) lies in boundary layers" not in said:
            fail(f"a point in layers is refused so: {said}")
    print("good")
    return None


if __name__ == "__main__":
    main()
