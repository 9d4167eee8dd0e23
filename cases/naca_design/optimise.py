#!/usr/bin/env python3
"""Least wave drag of an airfoil at the lift and with the area of NACA 0012: SLSQP over ten Hicks-Henne bumps and the incidence. Needs python3-scipy.

    python3 cases/naca_design/optimise.py -o optimum [--quadloop PROGRAM] [--iterations N] [--jobs N] [--lift CL] [--set KEY=VALUE ...]

The first shape is adapted once, in first/. Every other one is a single command, `quadloop adapt --from first --geometry SHAPE --cycles 0 --json`: its mesh is
that of the first shape, morphed, so that drag and lift are smooth functions of the shape, and gradients are differences. Left behind: the best shape as
shape.geom with its run in best/, history.json with the figures and the outline of each iterate, evaluations/ (the shapes asked for; their runs are removed).
"""
import argparse
import json
import math
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from scipy.optimize import minimize
from shapes import airfoil, write_geometry

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
THICKNESS = 0.12
PLACES = (0.15, 0.35, 0.55, 0.75, 0.9)  # where the bumps are highest, in chords
LARGEST = 2.0       # of a bump, in hundredths of a chord
ALPHAS = (-2.0, 6.0)
HELD = 2e-3         # what lift and area may lack of what is asked, relative
STEP = 0.01         # of differences, in hundredths of a chord and in degrees


def bump(x, place):
    """Hicks and Henne, J. Aircraft 15 (1978): 1 at its place, 0 at both ends of the chord."""
    return math.sin(math.pi * x ** (math.log(0.5) / math.log(place)))**3 if 0 < x < 1 else 0.0


def outline(heights):
    """NACA 0012 with bumps, in hundredths of a chord: the first heights are those of the upper side, upwards, the others those of the lower one, downwards."""
    points = airfoil(0, THICKNESS)
    upper, lower = heights[:len(PLACES)], heights[len(PLACES):]

    def lift_of(x, y):
        return sum(h * bump(x, place) for h, place in zip(upper, PLACES)) if y > 0 else -sum(h * bump(x, place) for h, place in zip(lower, PLACES))
    return [(x, y + lift_of(x, y) / 100) for x, y in points]


def area(heights):
    points = outline(heights)
    return abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(points, points[1:] + points[:1]))) / 2


class Flows:
    """Lift and drag of shapes; `values` are the heights of the bumps, in hundredths of a chord, and the incidence, in degrees: numbers of like effect, which
    SLSQP takes them for."""

    def __init__(self, quadloop, folder, jobs, options):
        self.quadloop, self.folder, self.options = str(quadloop), folder, options
        self.pool = ThreadPoolExecutor(jobs)
        self.known = {}
        (folder / "evaluations").mkdir(parents=True)

    def adapt(self, out, alpha, *words):
        command = [self.quadloop, "adapt", str(HERE / "optimise.toml"), "-o", str(out), "--json", *map(str, words), "--set", f"solver.alpha={alpha!r}",
                   *self.options]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)}\n{done.stderr}")
        return json.loads(done.stdout)["cycles"][-1]

    def first(self, alpha):
        """NACA 0012, adapted to its own flow."""
        return self.adapt(self.folder / "first", alpha)

    def evaluate(self, values, keep=None):
        """One shape, one command."""
        key = tuple(map(float, values))
        if key in self.known and keep is None:
            return self.known[key]
        name = self.folder / "evaluations" / f"{len(self.known):04d}_{abs(hash(key)) % 10**8:08d}"
        write_geometry(f"{name}.geom", outline(key[:-1]))
        found = self.adapt(keep or name, key[-1], "--from", self.folder / "first", "--geometry", f"{name}.geom", "--cycles", 0)
        if keep is None:
            shutil.rmtree(name)
        self.known[key] = found
        return found

    def gradients(self, values):
        """Of drag and of lift, by differences to one side."""
        shifted = [[v + (STEP if i == k else 0) for i, v in enumerate(values)] for k in range(len(values))]
        here, *there = self.pool.map(self.evaluate, [list(values), *shifted])
        return {name: [(one[name] - here[name]) / STEP for one in there] for name in ("cd", "cl")}


class Problem:
    """What SLSQP asks for; gradients of drag and lift come together."""

    def __init__(self, flows, lift, scale):
        self.flows, self.lift, self.scale, self.slopes = flows, lift, scale, {}

    def drag(self, values):
        return self.flows.evaluate(values)["cd"] / self.scale

    def missing_lift(self, values):
        return self.flows.evaluate(values)["cl"] / self.lift - 1

    def slope(self, values, name):
        key = tuple(map(float, values))
        if key not in self.slopes:
            self.slopes = {key: self.flows.gradients(key)}
        return [slope / (self.scale if name == "cd" else self.lift) for slope in self.slopes[key][name]]

    def constraints(self, least_area):
        def area_slope(values):
            heights = list(map(float, values[:-1]))
            return [(area([h + (STEP if i == k else 0) for i, h in enumerate(heights)]) - area(heights)) / STEP / least_area
                    for k in range(len(heights))] + [0.0]
        return [{"type": "eq", "fun": self.missing_lift, "jac": lambda v: self.slope(v, "cl")},
                {"type": "ineq", "fun": lambda v: area(list(map(float, v[:-1]))) / least_area - 1, "jac": area_slope}]


def row_of(number, values, found):
    return {"iteration": number, "cd": found["cd"], "cl": found["cl"], "alpha": float(values[-1]), "area": area(list(map(float, values[:-1]))),
            "morphed": found["morphed"], "heights": [float(h) for h in values[:-1]]}


def show(row):
    print(f"| {row['iteration']} | {row['cd']:.6f} | {row['cl']:.5f} | {row['alpha']:.3f} | {row['area']:.5f} |", flush=True)


def optimise(flows, lift, iterations):
    """The rows of the history, and why it ended."""
    start = [0.0] * (2 * len(PLACES)) + [2.0]
    history = []

    def note(values):
        history.append(row_of(len(history), values, flows.evaluate(values)))
        show(history[-1])
    flows.first(start[-1])
    print("| iteration | CD | CL | incidence | area |\n|---|---|---|---|---|", flush=True)
    note(start)
    lift = history[0]["cl"] if lift is None else lift
    problem = Problem(flows, lift, history[0]["cd"])
    found = minimize(problem.drag, start, jac=lambda v: problem.slope(v, "cd"), method="SLSQP", callback=note,
                     bounds=[(-LARGEST, LARGEST)] * (len(start) - 1) + [ALPHAS], constraints=problem.constraints(area(start[:-1])),
                     options={"maxiter": iterations, "ftol": 1e-4})
    return history, found.message


def best_of(history, lift):
    """The row of least drag of those that hold lift and area: steps of SLSQP may leave them for a while."""
    least_area = history[0]["area"] * (1 - HELD)
    return min((row for row in history if abs(row["cl"] / lift - 1) <= HELD and row["area"] >= least_area), key=lambda row: row["cd"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", default=str(ROOT / "build" / "release" / "app" / "quadloop"))
    parser.add_argument("-o", "--out", required=True, type=Path)
    parser.add_argument("--iterations", type=int, default=15)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--lift", type=float, help="that of the first shape, without this")
    parser.add_argument("--set", action="append", default=[])
    args = parser.parse_args()
    flows = Flows(args.quadloop, args.out, args.jobs, [word for text in args.set for word in ("--set", text)])
    history, message = optimise(flows, args.lift, args.iterations)
    best = best_of(history, args.lift or history[0]["cl"])
    write_geometry(args.out / "shape.geom", outline(best["heights"]))
    flows.evaluate([*best["heights"], best["alpha"]], keep=args.out / "best")
    result = {"history": history, "evaluations": len(flows.known), "message": message, "best": best}
    (args.out / "history.json").write_text(json.dumps(result, indent=1) + "\n")
    print(f"\n{len(flows.known)} flows; {message}; CD {history[0]['cd']:.6f}, at iteration {best['iteration']} {best['cd']:.6f}")


if __name__ == "__main__":
    main()
