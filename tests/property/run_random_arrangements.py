#!/usr/bin/env python3
"""Random arrangements (arrangements.py) of outlines, curves, blocks, inner lines, baffles, layers and periodic pairs, meshed on 1 and 3 ranks: with
the same bytes, valid for `quadloop check`, the tests' own judge and, where it is at hand, another one; or refused with a place and a remedy.

    run_random_arrangements.py --quadloop PROGRAM --count 12 [--first 0] [--ranks 3] [--keep FOLDER] [--list-refusals]
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tests" / "judge"), str(ROOT / "tests" / "cases")]
from arrangements import Arrangement  # noqa: E402
from quadloop_runs import JUDGE, MPIRUN, beside_the_checkout  # noqa: E402

SECONDS = 300
PLACE = re.compile(r"\(-?[0-9.e+-]+, ?-?[0-9.e+-]+\)|\.(toml|geom|dat):\d+")


def mesh(program, ranks, folder):
    """(exit status, what it said)"""
    launcher = [str(MPIRUN), "-n", str(ranks)] if ranks > 1 else []
    command = [*launcher, program, "mesh", "case.toml", "-o", f"on_{ranks}", "--quiet", "--geometry-out", f"on_{ranks}.geom"]
    try:
        at_once = dict(os.environ, OMPI_MCA_odls_base_sigkill_timeout="0")
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=SECONDS, env=at_once, check=False)
    except subprocess.TimeoutExpired:
        return None, "no end"
    return done.returncode, [line for line in done.stderr.splitlines() if line.startswith("quadloop")]


def refusal_faults(said):
    errors = [line for line in said if "error" in line]
    if len(errors) != 1:
        return [f"{len(errors)} error lines: {said}"]
    found = [] if PLACE.search(errors[0]) else [f"no place: {errors[0]}"]
    return found + ([] if ";" in errors[0] or ". " in errors[0] else [f"no remedy: {errors[0]}"])


def closed_baffles(path):
    """The mesh with the two sides of each baffle joined, which the judges allow: coincident nodes become one, and edges that then have cells of
    one block on both sides are no boundary."""
    import numpy as np
    from judge import Edges
    from mesh_files import read_mesh
    found = read_mesh(path)
    _, first, same = np.unique(found.points, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)
    number = np.empty(len(order), int)
    number[order] = np.arange(len(order))
    to = number[same.ravel()]
    found.points = found.points[first[order]]
    found.triangles, found.quads = to[found.triangles], to[found.quads]
    found.boundaries = {name: to[edges] for name, edges in found.boundaries.items()}
    edges = Edges(found)
    taken, kept = set(), {}
    for name, rows in found.boundaries.items():
        left, right = edges.blocks_beside(edges.number(rows))
        rows = rows[(right < 0) | (left != right)]
        left, right = edges.blocks_beside(edges.number(rows))
        turned = (right >= 0) & (left > right)
        rows[turned] = rows[turned][:, ::-1]
        new = np.array([(a, b) not in taken for a, b in rows.tolist()], dtype=bool)
        taken.update(map(tuple, rows.tolist()))
        if new.any():
            kept[name] = rows[new]
    found.boundaries = kept
    write_native(path.with_suffix(".closed.mesh"), found)
    return path.with_suffix(".closed.mesh")


def write_native(path, found):
    rows = [str(len(found.points)), *(f"{x!r} {y!r}" for x, y in found.points.tolist()), str(len(found.blocks))]
    block = found.block_of()
    for b in range(len(found.blocks)):
        for cells, of in ((found.triangles, block[:len(found.triangles)]), (found.quads, block[len(found.triangles):])):
            mine = cells[of == b] + 1
            rows += [str(len(mine)), *(" ".join(map(str, row)) for row in mine.tolist())]
    rows.append(str(len(found.boundaries)))
    for k, (name, edges) in enumerate(found.boundaries.items()):
        rows += [f"#Number of edges for boundary {k + 1} ({name})", str(len(edges)), *(f"{a + 1} {b + 1}" for a, b in edges.tolist())]
    Path(path).write_text("\n".join(rows) + "\n")


def judge_faults(program, arrangement, folder):
    path = folder / "on_1.mesh"
    delaunay = ["--delaunay"] * (arrangement.type == "delaunay" and not arrangement.layers and not arrangement.has_lines)
    own = ["--geometry", folder / "on_1.geom"] * (not arrangement.has_lines)
    judged = closed_baffles(path) if "baffle" in arrangement.files["case.toml"] else path
    commands = [[program, "check", path, "--geometry", folder / "on_1.geom"], [sys.executable, "-B", JUDGE, judged, *delaunay, *own]]
    other = beside_the_checkout("QUADLOOP_MESHCHECK", "tools/meshcheck.py")
    if other is not None:
        commands.append([sys.executable, "-B", other, judged, *delaunay])
    for command in commands:
        done = subprocess.run([*map(str, command)], cwd=folder, capture_output=True, text=True, check=False)
        if done.returncode:
            yield f"{Path(command[0]).name} {Path(command[1]).name}: {(done.stdout + done.stderr)[-600:]}"


def faults(program, seed, ranks, folder):
    """(faults, the refusal or None) of the arrangement of one seed."""
    arrangement = Arrangement(seed)
    folder.mkdir(parents=True)
    for name, text in arrangement.files.items():
        (folder / name).write_text(text)
    (status, said), other = (mesh(program, n, folder) for n in (1, ranks))
    found = []
    if (status, said) != other:
        found.append(f"{status} {said} on 1 rank, {other} on {ranks}")
    if status == 1:
        return found + refusal_faults(said), said[-1:]
    if status != 0:
        return [*found, f"exit status {status}: {said}"], None
    for suffix in ("mesh", "tree.h5", "geom"):
        if (folder / f"on_{ranks}.{suffix}").exists() and (folder / f"on_1.{suffix}").read_bytes() != (folder / f"on_{ranks}.{suffix}").read_bytes():
            found.append(f".{suffix} differs on {ranks} ranks")
    return found + list(judge_faults(program, arrangement, folder)), None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--count", type=int, required=True)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--ranks", type=int, default=3)
    parser.add_argument("--keep", type=Path, help="the folder that keeps the cases")
    parser.add_argument("--list-refusals", action="store_true")
    args = parser.parse_args()
    failed = refused = 0
    with tempfile.TemporaryDirectory(prefix="quadloop_arrangements_") as temporary:
        for seed in range(args.first, args.first + args.count):
            found, refusal = faults(str(Path(args.quadloop).resolve()), seed, args.ranks, (args.keep or Path(temporary)) / str(seed))
            for what in found:
                print(f"seed {seed}: {what}", flush=True)
            if refusal and args.list_refusals:
                print(f"seed {seed} refused: {refusal}", flush=True)
            failed += len(found) > 0
            refused += refusal is not None
    print(f"{args.count} arrangements, {refused} refused, {failed} with faults")
    return 1 if failed or 2 * refused > args.count else 0


if __name__ == "__main__":
    sys.exit(main())
