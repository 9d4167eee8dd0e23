#!/usr/bin/env python3
"""`quadloop morph` of a case with blocks, inner lines, baffles or periodic pairs: onto its own geometry not a bit changes; onto a bent one the cells are
the same, the mesh is valid and on the new geometry, coincident nodes stay coincident, with the same bytes on 1, 2, 3, 5 and 8 ranks; the two sides of a
pair must move alike.

    run_morph_pieces.py --quadloop PROGRAM --case CASE.toml
"""
import argparse
import math
import subprocess
import sys
import tempfile
import tomllib
from collections import Counter
from pathlib import Path

from quadloop_runs import MPIRUN, NativeMesh, beside_the_checkout, fail, mesh_case, run


def moved_geometry(text, move):
    """The rows of a .geom file without curves, each point moved."""
    rows = []
    for row in text.splitlines():
        words = row.split()
        try:
            x, y = map(float, words)
        except ValueError:
            rows.append(row)
            continue
        rows.append("{!r} {!r}".format(*move(x, y)))
    return "\n".join(rows) + "\n"


def points_of(text):
    found = []
    for row in text.splitlines():
        words = row.split()
        if len(words) == 2 and words[1] != "open":
            found.append(tuple(map(float, words)))
    return found


def bend(text, share=0.03):
    """Moves the inside of the box; its sides stay."""
    xs, ys = zip(*points_of(text))
    x0, y0, width, height = min(xs), min(ys), max(xs) - min(xs), max(ys) - min(ys)

    def move(x, y):
        hump = math.sin(math.pi * (x - x0) / width) * math.sin(math.pi * (y - y0) / height)
        return (x, y) if abs(hump) < 1e-12 else (x + share * width * hump, y - 0.5 * share * height * hump)
    return moved_geometry(text, move)


def morph(quadloop, mesh, new, old, out, ranks=1, accept=(0,)):
    launcher = [MPIRUN, "-n", str(ranks)] if ranks > 1 else []
    command = [str(word) for word in [*launcher, quadloop, "-q", "morph", mesh, "--geometry", new, *(["--from", old] if old else []), "-o", out]]
    print("+", " ".join(command), flush=True)
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode not in accept:
        fail(f"exit status {done.returncode}: {done.stderr}")
    return done.stderr


def rows_after_nodes(path):
    rows = Path(path).read_text().splitlines()
    return rows[2 + int(rows[1]):]


def twice(path):
    """Places with two nodes, as on a baffle."""
    return sum(count > 1 for count in Counter(NativeMesh(path).nodes).values())


def check_bent(quadloop, work, has_pairs):
    mesh, old, new = work / "a.mesh", work / "old.geom", work / "new.geom"
    new.write_text(bend(old.read_text()))
    made = None
    for ranks in (1, 2, 3, 5, 8):
        out = work / f"bent_{ranks}.mesh"
        morph(quadloop, mesh, new, old, out, ranks)
        made = made or out.read_bytes()
        if out.read_bytes() != made:
            fail(f"another mesh on {ranks} ranks")
    if rows_after_nodes(out) != rows_after_nodes(mesh):
        fail("other cells, boundaries or lines")
    if out.read_bytes() == mesh.read_bytes():
        fail("nothing has moved")
    if twice(out) != twice(mesh):
        fail(f"{twice(mesh)} places had two nodes, {twice(out)} have")
    run([quadloop, "check", out, *([] if has_pairs else ["--geometry", new])])
    script = beside_the_checkout("QUADLOOP_MESHCHECK", "tools/meshcheck.py")
    if script is not None and twice(out) == 0:
        run([sys.executable, script, out])


def check_pair(quadloop, pair, work):
    """One side alone may not move."""
    old = (work / "old.geom").read_text()
    nodes = NativeMesh(work / "a.mesh")
    side = {nodes.nodes[a] for edge in nodes.boundaries[pair["from"]] for a in edge}
    corners = {p for p in points_of(old) if p in side}
    (work / "torn.geom").write_text(moved_geometry(old, lambda x, y: (x + 0.01 * y * y, y) if (x, y) in corners else (x, y)))
    said = morph(quadloop, work / "a.mesh", work / "torn.geom", work / "old.geom", work / "torn.mesh", accept=(1,))
    if "do not move alike" not in said or (work / "torn.mesh").exists():
        fail(said)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path)
    args = parser.parse_args()
    pairs = tomllib.loads(args.case.read_text()).get("pair", [])
    with tempfile.TemporaryDirectory(prefix="quadloop_morph_") as folder:
        work = Path(folder)
        mesh_case(args.quadloop, args.case, work / "a", 1, ["--geometry-out", work / "old.geom", "--set", 'output.formats=["mesh"]'])
        morph(args.quadloop, work / "a.mesh", work / "old.geom", work / "old.geom", work / "same.mesh")
        if (work / "same.mesh").read_bytes() != (work / "a.mesh").read_bytes():
            fail("the mesh changes on its own geometry")
        check_bent(args.quadloop, work, bool(pairs))
        if pairs:
            check_pair(args.quadloop, pairs[0], work)
        else:
            (work / "fewer.geom").write_text("1\nnobody\n3\n0 0\n1 0\n0 1\n")
            said = morph(args.quadloop, work / "a.mesh", work / "fewer.geom", work / "old.geom", work / "none.mesh", accept=(1,))
            if "its pieces are not those of" not in said and "has more loops of 'nobody'" not in said:  # the latter with closed loops only
                fail(said)
    print("good")


if __name__ == "__main__":
    main()
