#!/usr/bin/env python3
"""The optimiser of cases/naca_design, by the adjoint: after some iterations drag has fallen, lift and area are held, and every shape was evaluated on the first one's cells.

    run_optimum.py --quadloop PROGRAM [--small]
"""
import argparse
import json
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from quadloop_runs import ROOT, fail, run, skip

CASE = ROOT / "cases" / "naca_design"
COARSE = ["adapt.cycles=0"]  # the first mesh as it is cut


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True, type=Path)
    parser.add_argument("--small", action="store_true")
    args = parser.parse_args()
    try:
        import scipy  # noqa: F401
    except ImportError:
        skip("python3-scipy is not installed")
    iterations, options, share = (5, COARSE, 0.5) if args.small else (6, [], 0.4)
    with tempfile.TemporaryDirectory(prefix="quadloop_optimum_") as name:
        out = Path(name) / "optimum"
        print(run([sys.executable, "-B", CASE / "optimise.py", "--quadloop", args.quadloop.resolve(), "-o", out, "--iterations", iterations,
                   *(word for text in options for word in ("--set", text))]))
        said = json.loads((out / "history.json").read_text())
        history, last = said["history"], said["best"]
        best = json.loads((out / "best" / "cycle_00" / "record.json").read_text())
    if said["evaluations"] > 3 * len(history):
        fail(f"{said['evaluations']} flows for {len(history)} iterations: each was to need one, and one more for each shorter step")
    first = history[0]
    if len(history) < 2 or not last["cd"] < share * first["cd"]:
        fail(f"drag went from {first['cd']} to {last['cd']}, not below {share} of it")
    if abs(last["cl"] - first["cl"]) > 1e-3 or last["area"] < first["area"] * (1 - 2e-3):
        fail(f"lift or area are not held: {first}, {last}")
    if not all(row["morphed"] for row in history) or (best["cd"], best["cl"]) != (last["cd"], last["cl"]):
        fail(f"a shape is a function of its values alone: {last}, {best}")


if __name__ == "__main__":
    main()
