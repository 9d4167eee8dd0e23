#!/usr/bin/env python3
"""`quadloop adapt --from`: one command for each shape of a design cycle. Cells are kept while they are good enough, else meshed anew, and the record says
which; the flow is carried over; the same outline keeps the mesh to the last bit; cycles follow as asked, also after --resume; the same bytes on any ranks.

    run_continued.py --quadloop PROGRAM [--ranks 1 3]
"""
import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from quadloop_runs import ROOT, NativeMesh, fail, run

sys.path.insert(0, str(ROOT / "cases" / "naca_design"))
from shapes import airfoil, write_geometry

CASE = ROOT / "cases" / "naca_design" / "optimise.toml"
COARSE = [word for text in ("adapt.cycles=1", "adapt.min=0.012", "spacing.min=0.012", "spacing.max=7", "spacing.curvature=20", "solver.mach=0.6",
                            "boundary.airfoil.spacing=0.05", "adapt.max_nodes=9000", "solver.tolerance=1e-6") for word in ("--set", text)]


class Runs:
    def __init__(self, quadloop, folder):
        self.quadloop, self.folder = quadloop, folder

    def adapt(self, out, *words, ranks=1):
        """What --json says; the run is in `out`."""
        launcher = [ROOT / "scripts" / "mpirun", "-n", ranks] if ranks > 1 else []
        return json.loads(run([*launcher, self.quadloop, "adapt", CASE, "-o", self.folder / out, "--json", *COARSE, *words]))

    def refused(self, pieces, *words):
        folder = [] if "-o" in words else ["-o", self.folder / "none"]
        done = subprocess.run([str(w) for w in (self.quadloop, "adapt", CASE, *folder, *words, *COARSE)], capture_output=True, text=True, check=False)
        if done.returncode != 1 or any(piece not in done.stderr for piece in pieces):
            fail(f"{words}: exit status {done.returncode}, not the refusal that was expected: {done.stderr}")

    def shape(self, name, camber, thickness):
        write_geometry(self.folder / name, airfoil(camber, thickness))
        return self.folder / name

    def mesh(self, cycle):
        return NativeMesh(self.folder / cycle / "mesh.mesh")

    def steps(self, cycle):
        return len((self.folder / cycle / "mesh.history.csv").read_text().splitlines()) - 1

    def steps_afresh(self, cycle):
        """From the free stream, on the same mesh."""
        (self.folder / "bare.mesh").write_text((self.folder / cycle / "mesh.mesh").read_text().partition("#Number of constants")[0])
        return json.loads(run([self.quadloop, "solve", CASE, self.folder / "bare.mesh", "-o", self.folder / "afresh.mesh", "--json", *COARSE]))["steps"]


def require(holds, what):
    if not holds:
        fail(what)


def tables_of(case):
    """The text of a case file, a piece for each table."""
    return re.split(r"^(?=\[)", case.read_text(), flags=re.MULTILINE)


def cells_of(mesh):
    return mesh.cells, mesh.boundaries


def files_of(folder):
    """All that is the same on any ranks."""
    files = {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.suffix in (".mesh", ".h5", ".geom", ".csv")}
    for path in folder.rglob("record.json"):
        record = json.loads(path.read_text())
        del record["seconds"]
        files[str(path.relative_to(folder))] = record
    return files


def require_same(one, other):
    first, second = files_of(one), files_of(other)
    require(len(first) >= 5 and first.keys() == second.keys(), f"{one} has {sorted(first)}, {other} has {sorted(second)}")
    for name, held in first.items():
        require(held == second[name], f"{name}: {other} has another one than {one}")


def check_kept_cells(runs, ranks):
    """Morphed, on its outline, with the flow to start from; then a shape after that."""
    near = runs.shape("near.geom", 0.005, 0.118)
    said = runs.adapt("near_1", "--from", runs.folder / "first", "--geometry", near, "--cycles", 0)
    found, = said["cycles"]
    require(found["morphed"] and not any("new mesh" in warning or "arc length" in warning for warning in said["warnings"]), f"cells were to be kept: {said}")
    require(found["cl"] > 0.2 and found["residual"] < 1e-5, f"a flow was to come: {found}")
    require(cells_of(runs.mesh("near_1/cycle_00")) == cells_of(runs.mesh("first/cycle_01")), "the cells are not those of the first shape")
    shutil.copytree(runs.folder / "first", runs.folder / "undesigned_start")
    (runs.folder / "undesigned_start/cycle_01/mesh.geom").unlink()  # as without [design]
    other = runs.adapt("of_undesigned", "--from", runs.folder / "undesigned_start", "--geometry", near, "--cycles", 0)
    require(other["cycles"][0]["morphed"] and any("cycle_01/mesh.mesh: the geometry" in warning and "[design]" in warning for warning in other["warnings"]),
            f"a morph without the former geometry was to be said: {other}")
    run([runs.quadloop, "-q", "check", runs.folder / "near_1/cycle_00/mesh.mesh", "--geometry", runs.folder / "near_1/cycle_00/mesh.geom"])
    require(runs.steps("near_1/cycle_00") < runs.steps_afresh("near_1/cycle_00"), "a flow that is carried over was to need fewer steps")
    for number in ranks[1:]:
        runs.adapt(f"near_{number}", "--from", runs.folder / "first", "--geometry", near, "--cycles", 0, ranks=number)
        require_same(runs.folder / "near_1", runs.folder / f"near_{number}")
    after = runs.adapt("after", "--from", runs.folder / "near_1" / "cycle_00", "--geometry", runs.shape("after.geom", 0.01, 0.116), "--cycles", 0)
    require(after["cycles"][0]["morphed"] and after["cycles"][0]["cl"] > found["cl"], f"more camber, more lift: {after}")


def check_same_outline(runs):
    """Of another incidence, as for a polar: the nodes stay to the last bit."""
    said = runs.adapt("polar", "--from", runs.folder / "first", "--cycles", 0, "--set", "solver.alpha=3")
    require(runs.mesh("polar/cycle_00").nodes == runs.mesh("first/cycle_01").nodes, "the same outline was to keep its mesh")
    first = json.loads((runs.folder / "first/cycle_01/record.json").read_text())
    require(said["cycles"][0]["cl"] > first["cl"], "more incidence, more lift")
    moved = runs.adapt("polar_of_near", "--from", runs.folder / "near_1", "--geometry", runs.folder / "near.geom", "--cycles", 0, "--set", "solver.alpha=3")
    require(moved["cycles"][0]["morphed"] and runs.mesh("polar_of_near/cycle_00").nodes == runs.mesh("near_1/cycle_00").nodes, "nor does a morphed mesh change")


def check_what_is_told(runs):
    """Whatever the reason is for other cells, or for cells that other settings made."""
    start, near = ["--cycles", 0, "--from", runs.folder / "first"], ["--geometry", runs.folder / "near.geom"]
    coarser = ["--set", "spacing.gradation=1.4"]
    for name, words, morphed, pieces in (
            ("wall_kept", [*start, "--set", "boundary.airfoil.spacing=0.06"], True, ["its cells are kept", "(mesh, spacing, layers)"]),
            ("wall_moved", [*start, *near, "--set", "boundary.airfoil.spacing=0.06"], True,
             ["its cells are kept", "boundary.airfoil.spacing was 0.05, is now 0.06"]),
            ("set_kept", [*start, *near, *coarser], True, ["its cells are kept", "(mesh, spacing, layers)"]),
            ("set_anew", [*start, *coarser], False, ["a new mesh was generated instead of", "(mesh, spacing, layers)"])):
        said = runs.adapt(name, *words)
        require(said["cycles"][0]["morphed"] == morphed, f"{name}: {said}")
        require(any(all(piece in warning for piece in pieces) for warning in said["warnings"]), f"{name}: it was to be said: {said['warnings']}")
    case = runs.folder / "undesigned.toml"
    case.write_text("".join(part for part in tables_of(CASE) if not part.startswith("[design]")))
    words = [runs.quadloop, "adapt", case, "-o", runs.folder / "undesigned", "--json", *start, *near, *COARSE]
    said = json.loads(run(words))
    require(any("a new mesh was generated instead of" in warning and "because the geometry " in warning and "design.morph_to" in warning for warning in said["warnings"]),
            f"it was to be said: {said['warnings']}")
    without_marks = re.sub(r"^(indicator|threshold) = .*\n", "", case.read_text(), flags=re.MULTILINE)
    case.write_text(without_marks.replace("variable = ", "norm = 2\nvariable = "))
    said = json.loads(run([*words[:4], runs.folder / "metric", *words[5:], "--set", 'mesh.type="metric"']))
    require(any("without anisotropic cells" in warning for warning in said["warnings"]), f"it was to be said: {said['warnings']}")


def check_meshed_anew(runs):
    """Where no mesh is good enough; then cycles as asked, resumed too."""
    words = ["--from", runs.folder / "first", "--geometry", runs.folder / "near.geom", "--set", "design.morph_to=1"]
    said = runs.adapt("anew", *words, "--cycles", 1)
    zero, one = said["cycles"]
    require(not zero["morphed"] and "morphed" not in one, f"no mesh has the quality 1: {said}")
    require(any("near.geom: a new mesh was generated" in warning and "design.morph_to" in warning for warning in said["warnings"]), f"it was to be said: {said['warnings']}")
    require(cells_of(runs.mesh("anew/cycle_00")) != cells_of(runs.mesh("first/cycle_01")), "its cells are the old ones")
    check_what_is_told(runs)
    shutil.copytree(runs.folder / "anew", runs.folder / "resumed")
    shutil.rmtree(runs.folder / "resumed" / "cycle_01")
    runs.adapt("resumed", *words, "--cycles", 1, "--resume")
    require_same(runs.folder / "anew", runs.folder / "resumed")


def check_first_cycle_resumed(runs):
    """A run that ended in its first cycle goes on as it was begun, or not at all."""
    words = ["--geometry", runs.folder / "near.geom", "--cycles", 0]
    (runs.folder / "killed/cycle_00.part").mkdir(parents=True)
    shutil.copy(runs.folder / "near_1/start.txt", runs.folder / "killed")
    for others in ([], ["--from", runs.folder / "first/cycle_00"]):
        runs.refused(["began with the mesh of", "first/cycle_01"], "--resume", "-o", runs.folder / "killed", *words, *others)
    runs.adapt("killed", "--resume", "--from", runs.folder / "first", *words)
    require_same(runs.folder / "near_1", runs.folder / "killed")


def check_last_whole_cycle(runs):
    """Where the last cycle is not whole, the one before counts, and that is said."""
    shutil.copytree(runs.folder / "first", runs.folder / "torn")
    (runs.folder / "torn/cycle_01/record.json").unlink()
    said = runs.adapt("from_torn", "--from", runs.folder / "torn", "--cycles", 0)
    require(any("torn/cycle_01: is not whole" in warning and "cycle_00" in warning for warning in said["warnings"]), f"it was to be said: {said['warnings']}")
    require(runs.mesh("from_torn/cycle_00").nodes == runs.mesh("first/cycle_00").nodes, "the cycle before was to count")


def check_mesh_beside_its_tree(runs):
    """As `mesh` writes them, without a flow yet; and what is refused."""
    run([runs.quadloop, "-q", "mesh", CASE, "-o", runs.folder / "bare", *COARSE, "--set", 'output.formats=["mesh"]'])
    said = runs.adapt("from_mesh", "--from", runs.folder / "bare.mesh", "--geometry", runs.folder / "near.geom", "--cycles", 0)
    require(said["cycles"][0]["morphed"] and said["cycles"][0]["cl"] > 0.2, f"a flow was to come: {said}")
    runs.refused(["nothing_here", "--from"], "--from", runs.folder / "nothing_here")
    (runs.folder / "alone.mesh").write_bytes((runs.folder / "bare.mesh").read_bytes())
    runs.refused(["alone.tree.h5: is not there"], "--from", runs.folder / "alone.mesh")
    shutil.copy(runs.folder / "first/cycle_01/mesh.tree.h5", runs.folder / "alone.tree.h5")
    runs.refused(["alone.mesh", "alone.tree.h5"], "--from", runs.folder / "alone.mesh")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True, type=Path)
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 3])
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_continued_") as name:
        runs = Runs(args.quadloop.resolve(), Path(name))
        runs.adapt("first")
        check_kept_cells(runs, args.ranks)
        check_same_outline(runs)
        check_meshed_anew(runs)
        check_first_cycle_resumed(runs)
        check_last_whole_cycle(runs)
        check_mesh_beside_its_tree(runs)
    print("good")


if __name__ == "__main__":
    main()
