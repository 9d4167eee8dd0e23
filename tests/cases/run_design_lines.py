#!/usr/bin/env python3
"""`adapt --from` with design.morph_to of a mesh with baffles and a measuring line: on a changed plate the mesh is morphed, with the same cells and lines,
on the new geometry, and with the same bytes on 1, 2 and 3 ranks.

    run_design_lines.py --quadloop PROGRAM
"""
import argparse
import json
import sys
import tempfile
from pathlib import Path

import run_adapted_lines
from quadloop_runs import MPIRUN, NativeMesh, fail, run
from run_morph_pieces import rows_after_nodes, twice


def case_text(lean):
    """The plate leans, and with it the end of the shelf; the line and the box stay."""
    def moved(points):
        return [[x + lean * y, y] for x, y in points]
    return run_adapted_lines.CASE.format(plate=moved(run_adapted_lines.PLATE), shelf=moved(run_adapted_lines.SHELF), python=sys.executable,
                                         script=run_adapted_lines.__file__, transfer="") + "\n[design]\nmorph_to = 0.1\n"


def adapt(quadloop, case, out, ranks, *options):
    launcher = [MPIRUN, "-n", str(ranks)] if ranks > 1 else []
    run([*launcher, quadloop, "-q", "adapt", case, "-o", out, "--cycles", "0", *options])
    return out / "cycle_00"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_design_") as folder:
        work = Path(folder)
        for name, lean in (("first", 0.0), ("second", 0.05)):
            (work / f"{name}.toml").write_text(case_text(lean))
        base = adapt(args.quadloop, work / "first.toml", work / "base", 1)
        made = None
        for ranks in (1, 2, 3):
            cycle = adapt(args.quadloop, work / "second.toml", work / f"on_{ranks}", ranks, "--from", work / "base")
            mesh = (cycle / "mesh.mesh").read_bytes()
            made = made or mesh
            if mesh != made:
                fail(f"another mesh on {ranks} ranks")
        if json.loads((cycle / "record.json").read_text()).get("morphed") is not True:
            fail("the mesh was generated again")
        before, after = base / "mesh.mesh", cycle / "mesh.mesh"
        cells = [rows_after_nodes(path) for path in (before, after)]
        ends = [rows.index("#Number of constants") for rows in cells]
        if cells[0][:ends[0]] != cells[1][:ends[1]] or NativeMesh(before).nodes == NativeMesh(after).nodes:
            fail("other cells or lines, or the same nodes")
        if twice(before) != twice(after) or twice(after) == 0:
            fail(f"{twice(after)} places have two nodes, {twice(before)} had")
        run([args.quadloop, "check", after, "--geometry", cycle / "mesh.geom"])
    print("good")


if __name__ == "__main__":
    main()
