#!/usr/bin/env python3
"""Lift over small changes of camber on morphed meshes: its second differences tell the noise that an optimiser by differences would meet.

    run_morph.py --quadloop PROGRAM
"""
import argparse
import json
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from quadloop_runs import ROOT, fail, run

CASE = ROOT / "cases" / "naca0012_m05" / "case.toml"
COARSE = [word for text in ("spacing.min=0.02", "boundary.airfoil.spacing=0.04", "spacing.curvature=20") for word in ("--set", text)]
FLOW = [word for text in ("solver.alpha=2.0", "solver.tolerance=1e-10", "solver.iterations=3000") for word in ("--set", text)]
STEP, STEPS = 1e-5, (-2, -1, 0, 1, 2)  # chords of camber
LARGEST_NOISE = 1e-6
CREST = 0.4  # where the camber is largest


def cambered(lines, camber):
    """The airfoil's points of a .geom, their mean line bent as NACA's four digits have it."""
    def line(x):
        x = min(max(x, 0), 1)
        return camber * ((2 * CREST * x - x * x) / CREST**2 if x < CREST else (1 - 2 * CREST + 2 * CREST * x - x * x) / (1 - CREST)**2)
    begin = lines.index("airfoil") + 2
    end = begin + int(lines[begin - 1])
    points = [tuple(map(float, row.split())) for row in lines[begin:end]]
    return ["1", "airfoil", str(len(points)), *(f"{x!r} {y + line(x)!r}" for x, y in points)]


def lift(quadloop, folder, outline, camber):
    (folder / "new.geom").write_text("\n".join(cambered(outline, camber)) + "\n")
    run([quadloop, "-q", "morph", folder / "in.mesh", "--from", folder / "old.geom", "--geometry", folder / "new.geom", "-o", folder / "out.mesh"])
    said = json.loads(run([quadloop, "solve", CASE, folder / "out.mesh", "-o", folder / "flow.mesh", "--json", *COARSE, *FLOW]))
    return said["cl"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True, type=Path)
    quadloop = parser.parse_args().quadloop.resolve()
    with tempfile.TemporaryDirectory(prefix="quadloop_morph_") as name:
        folder = Path(name)
        run([quadloop, "-q", "mesh", CASE, "-o", folder / "in", "--geometry-out", folder / "old.geom", *COARSE])
        outline = [line for line in (folder / "old.geom").read_text().splitlines() if not line.startswith("#")]
        lifts = [lift(quadloop, folder, outline, 0.01 + k * STEP) for k in STEPS]
    slopes = [(b - a) / STEP for a, b in zip(lifts, lifts[1:])]
    noise = max(abs(c - 2 * b + a) for a, b, c in zip(lifts, lifts[1:], lifts[2:]))
    print(f"cl {lifts[2]:.6f}, its slope {min(slopes):.3f} to {max(slopes):.3f} per chord of camber, noise {noise:.1e}")
    if noise > LARGEST_NOISE:
        fail(f"second differences of the lift reach {noise:.2e}, not below {LARGEST_NOISE}")
    if not 0 < min(slopes):
        fail("lift must grow with camber")
    return 0


if __name__ == "__main__":
    sys.exit(main())
