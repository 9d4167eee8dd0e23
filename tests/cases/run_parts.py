#!/usr/bin/env python3
"""Partitions of a case with blocks, inner lines, baffles or periodic pairs: the same bytes on 1, 2, 3, 5 and 8 ranks; each is a valid mesh; together
they are the whole mesh, byte for byte, from each format; an edge of an inner line is either in one partition, with the line's name, or between two.

    run_parts.py --quadloop PROGRAM --case CASE.toml
"""
import argparse
import json
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

from quadloop_runs import beside_the_checkout, digest, fail, mesh_case, run
from run_lines import points_and_lines

PARTS = 5


def options(formats):
    return ["--set", f"output.partitions={PARTS}", "output.formats=" + json.dumps(formats).replace(" ", "")]


def whole_mesh(quadloop, case, work, formats):
    """Makes the partitions on several numbers of ranks; returns the prefix of those of one rank."""
    made = {}
    for ranks in (1, 2, 3, 5, 8):
        folder = work / f"{'_'.join(formats)}_{ranks}"
        folder.mkdir()
        mesh_case(quadloop, case, folder / "a", ranks, options(formats))
        found = {path.name: digest(path) for path in folder.iterdir() if path.suffix != ".cgns"}
        made = made or found
        if found != made:
            fail(f"on {ranks} ranks differ {sorted(name for name in {*found, *made} if found.get(name) != made.get(name))}")
    return work / f"{'_'.join(formats)}_1" / "a"


def check_joined(quadloop, prefix, whole, work):
    joined = work / "joined.mesh"
    run([quadloop, "-q", "convert", f"{prefix}.parts", joined])
    if joined.read_bytes() != Path(whole).read_bytes():
        fail(f"{prefix}.parts is another mesh than {whole}")


def check_each(quadloop, prefix, has_baffles):
    """Each partition is valid for the program and the other judge, which takes the two sides of a baffle for a fault."""
    script = beside_the_checkout("QUADLOOP_MESHCHECK", "tools/meshcheck.py")
    for number in range(1, PARTS + 1):
        for suffix in ("mesh", "vtu"):
            run([quadloop, "check", f"{prefix}.part_{number:04}.{suffix}"])
        if script is not None and not has_baffles:
            run([sys.executable, script, f"{prefix}.part_{number:04}.mesh"])


def global_nodes(prefix, number):
    rows = [row for row in Path(f"{prefix}.part_{number:04}.links").read_text().splitlines() if not row.startswith("#")]
    return [int(row.split()[0]) - 1 for row in rows[2:2 + int(rows[1])]]


def check_lines(prefix, whole):
    """The edges of each line in the partitions are those of the whole mesh whose two cells are in one partition."""
    wanted = points_and_lines(whole)[1]
    part_of, cells = {}, Path(f"{prefix}.part_0001.mesh")
    if not cells.exists():
        fail("no partitions")
    found = {name: [] for name in wanted}
    for number in range(1, PARTS + 1):
        nodes = global_nodes(prefix, number)
        for name, edges in points_and_lines(f"{prefix}.part_{number:04}.mesh")[1].items():
            found[name] += [(nodes[a], nodes[b]) for a, b in edges]
    cut = 0
    for name, edges in wanted.items():
        if len(set(found[name])) != len(found[name]) or not set(found[name]) <= set(edges):
            fail(f"line {name} has other edges in the partitions")
        cut += len(edges) - len(found[name])
    shared = set()
    for number in range(1, PARTS + 1):
        nodes = set(global_nodes(prefix, number))
        shared |= nodes & set(part_of)
        part_of.update(dict.fromkeys(nodes, number))
    for name, edges in wanted.items():
        for edge in set(edges) - set(found[name]):
            if not set(edge) <= shared:
                fail(f"the edge {edge} of line {name} is in no partition, although it is not between two")
    print(f"{sum(map(len, found.values()))} edges of lines within partitions, {cut} between two")


def check_cgns(quadloop, case, work, blocks):
    """A CGNS partition has one zone: with several blocks it is left out, or refused if it is the only format."""
    for formats, status in ((["mesh", "cgns"], 0), (["cgns"], 1 if blocks else 0)):
        prefix = work / "zones" / "_".join(formats)
        prefix.parent.mkdir(exist_ok=True)
        done = subprocess.run([quadloop, "mesh", case, "-o", prefix, *options(formats)], capture_output=True, text=True, check=False)
        has_cgns = Path(f"{prefix}.part_0001.cgns").exists()
        if done.returncode != status or has_cgns == blocks or ("a CGNS partition has one zone" in done.stderr) != blocks:
            fail(f"{formats}: exit status {done.returncode}, {done.stderr}")
        if has_cgns:
            check_joined(quadloop, prefix, f"{work}/mesh_vtu_1/a.mesh", work)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path)
    args = parser.parse_args()
    tables = tomllib.loads(args.case.read_text())
    has_baffles = any(line.get("kind") == "baffle" for line in tables.get("line", []))
    with tempfile.TemporaryDirectory(prefix="quadloop_parts_") as folder:
        work = Path(folder)
        prefix = whole_mesh(args.quadloop, args.case, work, ["mesh", "vtu"])
        whole = f"{prefix}.mesh"
        check_joined(args.quadloop, prefix, whole, work)
        check_each(args.quadloop, prefix, has_baffles)
        check_lines(prefix, whole)
        of_vtu = work / "of_vtu"
        run([args.quadloop, "-q", "mesh", args.case, "-o", of_vtu, *options(["vtu"])])
        check_joined(args.quadloop, of_vtu, whole, work)
        again = work / "again"
        run([args.quadloop, "-q", "convert", whole, f"{again}.mesh", "--parts", "3"])
        check_joined(args.quadloop, again, whole, work)
        check_cgns(args.quadloop, args.case, work, "block" in tables)
    print("good")


if __name__ == "__main__":
    main()
