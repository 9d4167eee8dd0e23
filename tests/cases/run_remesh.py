#!/usr/bin/env python3
"""`quadloop remesh` and `mesh --tree`: what the loop does inside, from any format and on any number of ranks; a changed outline; refusals.

    run_remesh.py --quadloop PROGRAM [--ranks 1 2 3 5]
"""
import argparse
import math
import random
import re
import shutil
import tempfile
from pathlib import Path

from adapt_runs import RING, adapt, command_of, expect_refusal, require, tiny_case
from quadloop_runs import ROOT, NativeMesh, run

AIRFOIL = ROOT / "cases" / "naca0012" / "naca0012.geom"

# A step across the airfoil, 0.05 wide, as a shock would be.
STEP = (RING / "solver.py").read_text().replace("(math.hypot(x, y) - 0.6) / 0.01", "(x - 0.5) / 0.05 if abs(y) < 1 else x / 0.05")

AIRFOIL_CASE = """[geometry]
file = "airfoil.geom"
far_field = 5.0
[spacing]
min = 0.02
max = 2.0
curvature = 20.0
[boundary.airfoil]
spacing = 0.05
bc = "wall"
[adapt]
cycles = 2
variable = "height"
refine = 1.0
coarsen = 0.5
min = 0.02
[solver]
kind = "command"
command = ["python3", "{case}/solver.py", "{mesh}", "{solution}"]
"""


def without_table(text, name):
    return re.sub(rf"(?ms)^\[{name}\]$.*?(?=^\[|\Z)", "", text)


def mesh_of(path):
    """The lines of a native mesh up to its solution."""
    return Path(path).read_text().split("#Number of constants")[0]


def remesh(program, case, tree, solution, made, ranks=1, options=()):
    return run(command_of(program, ranks, "remesh", "--tree", tree, "--solution", solution, case, "-o", made, *options))


def require_equal_files(one, other, context):
    require(Path(one).read_bytes() == Path(other).read_bytes(), f"{context}: {other} has other bytes than {one}")


def check_pass(program, case, cycles, folder, ranks):
    """One pass is what the loop does between two cycles, on any number of ranks."""
    old, new = cycles / "cycle_01", cycles / "cycle_02"
    for count in ranks:
        made = folder / f"pass_{count}"
        remesh(program, case, old / "mesh.tree.h5", old / "mesh.mesh", made, count)
        require_equal_files(f"{folder}/pass_{ranks[0]}.mesh", f"{made}.mesh", f"{count} ranks")
        require_equal_files(new / "mesh.tree.h5", f"{made}.tree.h5", f"the loop and one pass on {count} ranks")
        require(mesh_of(f"{made}.mesh") == mesh_of(new / "mesh.mesh"), "one pass makes another mesh than the loop")


def write_csv(mesh, path, backwards):
    """As SU2 leaves its restart file, in the order of its points or not."""
    nodes = NativeMesh(mesh).nodes
    values = [row for row in Path(mesh).read_text().splitlines() if not row.startswith("#")][-len(nodes):]
    rows = [f"{i}, {x!r}, {y!r}, {value}" for i, ((x, y), value) in enumerate(zip(nodes, values))]
    path.write_text("\n".join(['"PointID","x","y","height"', *(reversed(rows) if backwards else rows)]) + "\n")


def check_formats(program, case, cycles, folder):
    old = cycles / "cycle_01"
    wanted = f"{folder}/pass_1.mesh"
    vtu = folder / "solution.vtu"
    run([program, "smooth", old / "mesh.mesh", "-o", vtu, "--sweeps", "0"])
    tables = [folder / "solution.csv", folder / "backwards.csv"]
    for table in tables:
        write_csv(old / "mesh.mesh", table, table.stem == "backwards")
    for solution in (old / "mesh.cgns", vtu, *tables):
        made = folder / f"from_{solution.stem}_{solution.suffix[1:]}"
        remesh(program, case, old / "mesh.tree.h5", solution, made)
        require(mesh_of(f"{made}.mesh") == mesh_of(wanted), f"{solution.name} leads to another mesh")
        if solution.suffix != ".cgns":  # has no constants, and names of its own
            rows = [Path(path).read_text().splitlines()[-1000:] for path in (f"{made}.mesh", wanted)]
            require(rows[0] == rows[1], f"{solution.name} leads to another solution")
    alone = folder / "alone.tree.h5"  # with no mesh beside it
    shutil.copy(old / "mesh.tree.h5", alone)
    remesh(program, case, alone, old / "mesh.cgns", folder / "from_alone")
    require(mesh_of(f"{folder}/from_alone.mesh") == mesh_of(wanted), "without the mesh beside the tree another mesh is made")
    expect_refusal(program, 1, ["alone.tree.h5", "beside"], "remesh", "--tree", alone, "--solution", tables[0], case, "-o", folder / "none")


def check_standing(program, case, cycles, folder, ranks):
    """Without [adapt] the tree stands: the same bytes, by remesh and by mesh --tree, whoever wrote it on however many ranks."""
    old = cycles / "cycle_02"
    still = case.with_name("still.toml")
    still.write_text(without_table(case.read_text(), "adapt"))
    for count in ranks:
        made = folder / f"still_{count}"
        remesh(program, still, old / "mesh.tree.h5", old / "mesh.mesh", made, count)
        require_equal_files(old / "mesh.tree.h5", f"{made}.tree.h5", f"no marks on {count} ranks")
        tree = folder / f"still_{ranks[(ranks.index(count) + 1) % len(ranks)]}.tree.h5"  # of another number of ranks, or the first
        run(command_of(program, count, "mesh", case, "--tree", tree if tree.exists() else old / "mesh.tree.h5", "-o", folder / f"tree_{count}"))
        require_equal_files(old / "mesh.tree.h5", f"{folder}/tree_{count}.tree.h5", f"mesh --tree on {count} ranks")
        require(mesh_of(f"{folder}/tree_{count}.mesh") == mesh_of(old / "mesh.mesh"), f"mesh --tree on {count} ranks makes another mesh")


def check_other_mesh(program, case, cycles, folder):
    """As many nodes and cells but elsewhere; other counts; values that are not finite in a variable that nothing is marked by."""
    first, old = cycles / "cycle_00", cycles / "cycle_01"

    def expect(parts, tree, solution):
        expect_refusal(program, 1, parts, "remesh", "--tree", tree, "--solution", solution, case, "-o", folder / "never")
        require(not list(folder.glob("never*")), "a refusal has left files")

    expect(["another mesh", "mesh.tree.h5", "nodes"], first / "mesh.tree.h5", old / "mesh.mesh")
    lines = (old / "mesh.mesh").read_text().splitlines()
    count = len(NativeMesh(old / "mesh.mesh").nodes)
    shifted = folder / "shifted.mesh"
    moved = [f"{float(x) + 0.7!r} {y}" for x, y in (row.split() for row in lines[2:count + 2])]
    shifted.write_text("\n".join([*lines[:2], *moved, *lines[count + 2:]]) + "\n")
    expect(["shifted.mesh", "another mesh", "node 1 lies"], old / "mesh.tree.h5", shifted)
    expect(["shifted.mesh", "cannot be compared", "alone.mesh", "--mesh"], folder / "alone.tree.h5", shifted)
    expect_refusal(program, 1, ["mesh.mesh", "another mesh", "alone.tree.h5", "nodes"], "remesh", "--tree", folder / "alone.tree.h5", "--solution", shifted,
                   "--mesh", first / "mesh.mesh", case, "-o", folder / "never")
    not_finite = folder / "not_finite.mesh"
    not_finite.write_text("\n".join([*lines[:-1], "nan"]) + "\n")
    expect([f"height at node {count}", "not finite"], old / "mesh.tree.h5", not_finite)
    try:
        import h5py
    except ImportError:
        print("without h5py: no .cgns with a NaN")
        return
    in_cgns = folder / "not_finite.cgns"
    shutil.copy(old / "mesh.cgns", in_cgns)
    with h5py.File(in_cgns, "r+") as file:
        file["Base/domain/FlowSolution/height/ data"][41] = float("inf")
    expect(["height", "node 42", "not finite"], old / "mesh.tree.h5", in_cgns)
    expect(["gone.mesh"], old / "mesh.tree.h5", folder / "gone.mesh")
    expect(["gone.tree.h5"], folder / "gone.tree.h5", old / "mesh.mesh")


def with_nodes(mesh, path, change):
    """The mesh with its solution, its nodes where change(number, place) puts them, as text."""
    lines = mesh.read_text().splitlines()
    nodes = NativeMesh(mesh).nodes
    lines[2:len(nodes) + 2] = [change(i, place) for i, place in enumerate(nodes)]
    path.write_text("\n".join(lines) + "\n")
    return path


def displaced(mesh, folder):
    """(file, what a refusal says of it): nodes a little off or far off; inside the ring's square [-1, 1]^2 the boundary nodes are known by their place."""
    nodes = NativeMesh(mesh).nodes
    inner = [i for i, (x, y) in enumerate(nodes) if max(abs(x), abs(y)) < 0.99]
    edge = min(math.dist(nodes[i], nodes[k]) for i in range(len(nodes)) for k in range(i))
    chosen, chance = inner[len(inner) // 2], random.Random(1)

    def off(i, dx, dy):
        return f"{nodes[i][0] + dx!r} {nodes[i][1] + dy!r}"

    def far(i, _):
        return off(i, *(chance.uniform(-2 * edge, 2 * edge) for _ in "xy")) if i in set_of_inner else off(i, 0, 0)

    set_of_inner = set(inner)
    swapped = {chosen: chosen + 1, chosen + 1: chosen}
    return [(with_nodes(mesh, folder / "one_node.mesh", lambda i, _: off(i, 1e-3 * edge, 0) if i == chosen else off(i, 0, 0)),
             [f"node {chosen + 1} lies at"]),
            (with_nodes(mesh, folder / "all_nodes.mesh", lambda i, _: off(i, 1e-3 * edge, 2e-3 * edge)), ["node 1 lies at"]),
            (with_nodes(mesh, folder / "far.mesh", far), ["lies at"]),
            (with_nodes(mesh, folder / "swapped.mesh", lambda i, _: off(swapped.get(i, i), 0, 0)), [f"node {chosen + 1} lies at"])]


def check_displaced(program, case, cycles, folder, ranks):
    """Nodes elsewhere are refused: with the tree's mesh beside it or named, also for a changed outline; a named mesh with invalid cells is, too."""
    old, alone = cycles / "cycle_01", folder / "alone.tree.h5"
    square = folder / "same_square.geom"
    square.write_text("1\nframe\n5\n-1 -1\n0.5 -1\n1 -1\n1 1\n-1 1\n")
    files = displaced(old / "mesh.mesh", folder)
    for solution, parts in files:
        named = ["--mesh", old / "mesh.mesh"]
        for tree, options in ((old / "mesh.tree.h5", []), (alone, named), (alone, [*named, "--geometry", square])):
            expect_refusal(program, 1, [solution.name, "another mesh", *parts], "remesh", "--tree", tree, "--solution", solution, case, "-o", folder / "never",
                           *options, ranks=ranks if tree == alone else 1)
    require(not list(folder.glob("never*")), "a refusal has left files")
    changed = ["--set", "spacing.gradation=1.4"]
    words = ["remesh", "--tree", alone, case, "-o", folder / "never", *changed]
    far, one_node = folder / "far.mesh", folder / "one_node.mesh"
    expect_refusal(program, 1, ["far.mesh: is not a mesh of this tree", "give the mesh that was written with the tree"], *words, "--solution", far, "--mesh", far)
    expect_refusal(program, 1, ["one_node.mesh: cannot be compared", "--mesh"], *words, "--solution", one_node)
    for solution, options in ((old / "mesh.mesh", []), (one_node, ["--mesh", one_node])):
        remesh(program, case, alone, solution, folder / "changed", options=[*changed, *options])


def check_few_digits(program, case, cycles, folder):
    """A solver that writes nine digits, with the tree's mesh at hand or not: the same next mesh, to the last bit."""
    old = cycles / "cycle_01"
    short = with_nodes(old / "mesh.mesh", folder / "nine_digits.mesh", lambda _, place: f"{place[0]:.9g} {place[1]:.9g}")
    require(mesh_of(short) != mesh_of(old / "mesh.mesh"), "nine digits are enough here")
    for tree, options in ((old / "mesh.tree.h5", []), (folder / "alone.tree.h5", ["--mesh", old / "mesh.mesh"])):
        made = folder / f"nine_digits_{tree.stem}"
        remesh(program, case, tree, short, made, options=options)
        require_equal_files(f"{folder}/pass_1.mesh", f"{made}.mesh", "nine digits")


def check_smoothed(program, case, folder, mesh_type, objective, outline):
    """What `quadloop smooth` has made of the tree's mesh is a mesh of it too where --mesh names it; its nodes moved once more are not."""
    words = ["--set", f"mesh.type={mesh_type}"]
    raw, smooth = folder / f"raw_{mesh_type}", folder / f"smooth_{mesh_type}_{objective}"
    run([program, "mesh", case, "-o", raw, *words, "--set", "smooth.sweeps=0"])
    geometry = ["--geometry", outline] if outline else []
    run([program, "smooth", f"{raw}.mesh", "-o", f"{smooth}.mesh", "--objective", objective, *geometry])
    require(mesh_of(f"{raw}.mesh") != mesh_of(f"{smooth}.mesh"), "nothing was smoothed")
    solution = Path(f"{smooth}_solved.mesh")
    run(["python3", case.with_name("solver.py"), f"{smooth}.mesh", solution])
    words += ["--mesh", f"{smooth}.mesh"]
    remesh(program, case, f"{raw}.tree.h5", solution, f"{smooth}_next", options=[*words, "--set", "smooth.sweeps=0"])
    expect_refusal(program, 1, ["lies at", "--mesh"], "remesh", "--tree", f"{raw}.tree.h5", "--solution", solution, case, "-o", folder / "never", *words[:2])
    nodes = NativeMesh(solution).nodes
    moved = with_nodes(solution, Path(f"{smooth}_moved.mesh"), lambda i, _: f"{nodes[i][0] + 1e-4!r} {nodes[i][1]!r}")
    expect_refusal(program, 1, [moved.name, "lies at"], "remesh", "--tree", f"{raw}.tree.h5", "--solution", moved, case, "-o", folder / "never", *words)


def moved_outline(path, change):
    """The airfoil's points changed one by one."""
    lines = AIRFOIL.read_text().splitlines()
    points = [i for i, line in enumerate(lines) if len(line.split()) == 2 and not line.startswith("#")]
    for i in points:
        x, y = change(*map(float, lines[i].split()))
        lines[i] = f"{x!r} {y!r}"
    path.write_text("\n".join(lines) + "\n")


def root_of(tree):
    import h5py
    with h5py.File(tree) as file:
        return [float(file.attrs[name]) for name in ("root_x", "root_y", "tree_edge", "trees_x", "trees_y")]


def check_outline(program, case, folder, cycles, name, change, ranks):
    """The adapted tree and the solution go to an outline that has moved or grown by 2 % of the chord."""
    old, outline, made = cycles / "cycle_02", folder / f"{name}.geom", folder / name
    moved_outline(outline, change)
    words = remesh(program, case, old / "mesh.tree.h5", old / "mesh.mesh", made, 1, ["--geometry", outline])
    outside = re.search(r"nodes outside the old mesh +(\d+)", words)
    require(outside and (int(outside[1]) > 0) == (name == "moved"), f"a thicker airfoil uncovers nothing, a moved one does: {words}")
    require(root_of(f"{made}.tree.h5") == root_of(old / "mesh.tree.h5"), "the root has changed")
    whole = folder / f"{name}_whole.geom"
    old_whole = (folder / "whole.geom").read_text()
    far_field = re.search(r"(?ms)^farfield.*?(?=^airfoil|\Z)", old_whole)[0]
    whole.write_text("2\n" + "\n".join(line for line in outline.read_text().splitlines() if not line.startswith("#"))[2:] + "\n" + far_field)
    run([program, "check", f"{made}.mesh", "--geometry", whole])
    before, after = (len(NativeMesh(path).nodes) for path in (old / "mesh.mesh", f"{made}.mesh"))
    require(0.7 < after / before < 2.5, f"{after} nodes from {before}: adaptation is not kept")
    for count in ranks[1:]:
        remesh(program, case, old / "mesh.tree.h5", old / "mesh.mesh", f"{made}_{count}", count, ["--geometry", outline])
        for suffix in (".mesh", ".tree.h5"):
            require_equal_files(f"{made}{suffix}", f"{made}_{count}{suffix}", f"{name} on {count} ranks")


def check_own_triangles(program, case, folder, cycles, ranks, options):
    """Flips after smoothing leave triangles with leaves beside them, so that marks made from a file are the loop's own."""
    made = folder / f"delaunay_{ranks}"
    remesh(program, case, cycles / "cycle_01" / "mesh.tree.h5", cycles / "cycle_01" / "mesh.mesh", made, ranks, options)
    require_equal_files(cycles / "cycle_02" / "mesh.tree.h5", f"{made}.tree.h5", f"the loop and one pass with triangles on {ranks} ranks")


def check_outlines(program, folder, ranks):
    case = tiny_case(folder / "airfoil", STEP, AIRFOIL_CASE)
    shutil.copy(AIRFOIL, case.with_name("airfoil.geom"))
    run([program, "mesh", case, "-o", folder / "first", "--geometry-out", folder / "whole.geom"])
    cycles = folder / "airfoil_cycles"
    adapt(program, case, cycles)
    for mesh_type, objective, outline in (("hybrid", "power", folder / "whole.geom"), ("hybrid", "thesis", None), ("delaunay", "power", folder / "whole.geom")):
        check_smoothed(program, case, folder, mesh_type, objective, outline)
    check_outline(program, case, folder, cycles, "thicker", lambda x, y: (x, 1.02 * y), ranks[:2])
    check_outline(program, case, folder, cycles, "moved", lambda x, y: (x + 0.02, y + 0.01), ranks[:3])
    delaunay = ["--set", "mesh.type=delaunay"]
    adapt(program, case, folder / "delaunay_cycles", options=delaunay)
    for count in ranks[:2]:
        check_own_triangles(program, case, folder, folder / "delaunay_cycles", count, delaunay)
    moved_outline(folder / "far.geom", lambda x, y: (x + 6, y))
    last = cycles / "cycle_02"
    expect_refusal(program, 1, ["far field", "does not enclose"], "remesh", "--tree", last / "mesh.tree.h5", "--solution", last / "mesh.mesh", case,
                   "-o", folder / "far", "--geometry", folder / "far.geom")


def check_outside_the_root(program, case, cycles, folder):
    larger, old = folder / "larger.geom", cycles / "cycle_01"
    larger.write_text("1\nframe\n4\n-1 -1\n1.5 -1\n1.5 1\n-1 1\n")
    expect_refusal(program, 1, ["frame", "(1.5, -1)", "outside the root"], "remesh", "--tree", old / "mesh.tree.h5", "--solution", old / "mesh.mesh", case,
                   "-o", folder / "outside", "--geometry", larger)
    require(not list(folder.glob("outside*")), "a refusal has left files")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2, 3, 5])
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_remesh_") as name:
        folder = Path(name)
        case = tiny_case(folder / "ring", None, (RING / "case.toml").read_text())
        (folder / "ring" / "solver.py").write_text((RING / "solver.py").read_text())
        cycles = folder / "ring_cycles"
        adapt(args.quadloop, case, cycles, options=["--cycles", "2"])
        check_pass(args.quadloop, case, cycles, folder, args.ranks)
        check_formats(args.quadloop, case, cycles, folder)
        check_standing(args.quadloop, case, cycles, folder, args.ranks)
        check_other_mesh(args.quadloop, case, cycles, folder)
        check_displaced(args.quadloop, case, cycles, folder, args.ranks[-2])
        check_few_digits(args.quadloop, case, cycles, folder)
        check_outside_the_root(args.quadloop, case, cycles, folder)
        check_outlines(args.quadloop, folder, args.ranks)
    print("good")


if __name__ == "__main__":
    main()
