#!/usr/bin/env python3
"""Gradients of lift and drag in cases/naca_design/optimise.py: those by the adjoint, taken back along the morph, against central differences of flows solved anew.

    run_gradient.py --quadloop PROGRAM

At Mach 0.5, where the limiter's factors are differentiated, they agree to the digits that differences have. At Mach 0.75 the solver keeps factors, other
ones for each shape, which the adjoint takes as constants: there they agree to some hundredths.
"""
import argparse
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from quadloop_runs import ROOT, fail, skip

sys.path.insert(0, str(ROOT / "cases" / "naca_design"))
VALUES = [0.1, -0.05, 0.2, 0.1, 0.0, 0.05, 0.1, -0.1, 0.05, 0.1, 1.9]  # ten bumps, in hundredths of a chord, and the incidence
PICKED = (1, 6, 10)
OTHER = {"lift": "cl", "drag": "cd"}


def difference(flows, which, step):
    """Of lift and drag by one of the values."""
    ends = [flows.evaluate([v + (sign * step if i == which else 0) for i, v in enumerate(VALUES)]) for sign in (1, -1)]
    return {goal: (ends[0][name] - ends[1][name]) / (2 * step) for goal, name in OTHER.items()}


def check(make_flows, mach, step, digits):
    options = [word for text in (f"solver.mach={mach}", "solver.tolerance=1e-11", "adapt.cycles=0") for word in ("--set", text)]
    by_adjoint, plain = make_flows(f"adjoint_{mach}", options, True), make_flows(f"plain_{mach}", options, False)
    for flows in (by_adjoint, plain):
        flows.first(VALUES[-1])
    here = by_adjoint.evaluate(VALUES)
    if not here["morphed"] or here["cl"] != plain.evaluate(VALUES)["cl"]:
        fail(f"Mach {mach}: the adjoint was to change no flow: {here}")
    for which in PICKED:
        found = difference(plain, which, step)
        for goal in OTHER:
            slope = here["gradients"][goal][which]
            size = max(map(abs, here["gradients"][goal][:-1] if which < len(VALUES) - 1 else [slope]))
            print(f"| {mach} | d {goal} / d {which} | {slope:.7g} | {found[goal]:.7g} | {(slope - found[goal]) / size:.1e} |", flush=True)
            if not abs(slope - found[goal]) < digits * size:
                fail(f"Mach {mach}: d {goal} by value {which} is {slope}, by differences {found[goal]}")


def check_on_request(make_flows):
    """The optimiser's own differences, to one side."""
    options = ["--set", "solver.mach=0.5", "--set", "solver.tolerance=1e-11", "--set", "adapt.cycles=0"]
    by_adjoint, plain = make_flows("adjoint", options, True), make_flows("plain", options, False)
    for flows in (by_adjoint, plain):
        flows.first(VALUES[-1])
    found, asked = by_adjoint.gradients(VALUES), plain.gradients(VALUES)
    for goal in OTHER:
        apart = max(abs(a - b) for a, b in zip(found[goal], asked[goal]))
        if not 0 < apart < 2e-2 * max(map(abs, found[goal])):
            fail(f"d {goal}: {found[goal]}, by differences {asked[goal]}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True, type=Path)
    quadloop = parser.parse_args().quadloop.resolve()
    try:
        import optimise
        from optimise import Flows
    except ImportError:
        skip("python3-scipy is not installed")
    optimise.STEP /= 2  # differences to one side are off in proportion to the step, 2 % for the optimiser's own
    with tempfile.TemporaryDirectory(prefix="quadloop_gradient_") as name:
        def make_flows(folder, options, by_adjoint):
            return Flows(quadloop, Path(name) / folder, 1, options, by_adjoint)
        print("| Mach | | adjoint | differences | apart |\n| --- | --- | --- | --- | --- |")
        check(make_flows, 0.5, 1e-4, 1e-5)
        check_on_request(make_flows)
        check(make_flows, 0.75, 1e-3, 0.02)


if __name__ == "__main__":
    main()
