#!/usr/bin/env python3
"""A case with several blocks, both types of mesh: valid for `quadloop check` and the judges, the same bytes on 1, 2, 3 and 5 ranks in every
format that holds blocks, as expected (expected.toml); what does not work with blocks is refused in one line.

    run_blocks.py --quadloop PROGRAM --case CASE.toml [--write-expected]
"""
import argparse
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

from quadloop_runs import beside_the_checkout, digest, fail, mesh_case, run
from run_case import compare, values_of, write_expected

FORMATS = ("mesh", "qmesh", "vtu", "msh", "su2")


def judge(prefix, mesh_type):
    script = beside_the_checkout("QUADLOOP_MESHCHECK", "tools/meshcheck.py")
    if script is None:
        print("no other judge at hand")
        return
    run([sys.executable, script, f"{prefix}.mesh", *(["--delaunay"] if mesh_type == "delaunay" else [])])


def check_refusals(quadloop, case, work):
    for assignment, part in (("mesh.mirror=\"x\"", "mesh.mirror"), ("output.partitions=2", "output.partitions"),
                             ("boundary.interface.layers={first=1e-3,growth=1.2,count=3}", "layers"),
                             ("adapt.variable=\"density\"", "[adapt]")):
        done = subprocess.run([str(quadloop), "mesh", str(case), "-o", str(work / "refused"), "--set", assignment], capture_output=True,
                              text=True, check=False)
        lines = [line for line in done.stderr.splitlines() if "error" in line]
        if done.returncode != 1 or len(lines) != 1 or part not in lines[0] or "[[block]]" not in lines[0]:
            fail(f"{assignment}: exit status {done.returncode}, {done.stderr}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path)
    parser.add_argument("--write-expected", action="store_true")
    args = parser.parse_args()
    options = ["--set", "output.formats=[" + ",".join(f'"{name}"' for name in FORMATS) + "]"]
    with tempfile.TemporaryDirectory(prefix="quadloop_blocks_") as folder:
        work = Path(folder)
        for mesh_type in ("hybrid", "delaunay"):
            prefix = work / mesh_type
            for ranks in (1, 2, 3, 5):
                other = prefix if ranks == 1 else work / "other"
                mesh_case(args.quadloop, args.case, other, ranks, [*options, "--type", mesh_type])
                for name in (*FORMATS, "tree.h5"):
                    if digest(f"{other}.{name}") != digest(f"{prefix}.{name}"):
                        fail(f"{name} differs on {ranks} ranks")
            for name in ("mesh", "qmesh", "vtu", "msh"):
                said = run([args.quadloop, "check", f"{prefix}.{name}"])
                if not any(line.split() == ["blocks", "2"] for line in said.splitlines()):
                    fail(f"{name} has not two blocks: {said}")
            judge(prefix, mesh_type)
            found = values_of(prefix)
            stem = "expected" if args.case.stem == "case" else f"expected_{args.case.stem}"
            expected = args.case.with_name(f"{stem}{'' if mesh_type == 'hybrid' else '_delaunay'}.toml")
            if args.write_expected:
                write_expected(expected, found)
            elif expected.exists():
                compare(found, tomllib.loads(expected.read_text()))
        if args.case.stem == "case":
            check_refusals(args.quadloop, args.case, work)
    print("good")


if __name__ == "__main__":
    main()
