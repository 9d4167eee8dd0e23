#!/usr/bin/env python3
"""Least wave drag of an airfoil at the lift and with the area of NACA 0012: SLSQP over Hicks-Henne bumps and the incidence. Needs python3-scipy.

    python3 cases/naca_design/optimise.py -o optimum [--bumps N] [--gradient adjoint|differences] [--quadloop PROGRAM] [--iterations N] [--jobs N] [--lift CL]
                                          [--set KEY=VALUE ...]

The first shape is adapted once, in first/. Every other one is a single command, `quadloop adapt --from first --geometry SHAPE --cycles 0 --json`: its mesh is
that of the first shape, morphed, so that drag and lift are smooth functions of the shape. Its adjoint solutions for lift and drag, taken back along the morph
by `quadloop morph --nodal-gradient`, are the derivatives by all points of the outline, so that gradients cost the same for any number of bumps. Left behind:
the best shape as shape.geom with its run in best/, history.json with the figures and the outline of each iterate, evaluations/ (the shapes asked for; their
runs are removed).
"""
import argparse
import csv
import json
import math
import resource
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
LARGEST = 2.0       # of a bump, in hundredths of a chord
ALPHAS = (-2.0, 6.0)
HELD = 2e-3         # what lift and area may lack of what is asked, relative
STEP = 0.01         # of differences, in hundredths of a chord and in degrees
GOALS = {"lift": "cl", "drag": "cd"}  # as the solver and its record name them


def bump(x, place):
    """Hicks and Henne, J. Aircraft 15 (1978): 1 at its place, 0 at both ends of the chord."""
    return math.sin(math.pi * x ** (math.log(0.5) / math.log(place)))**3 if 0 < x < 1 else 0.0


def bumps_at(x, y, count):
    """How far each of `count` bumps moves the point (x, y) of NACA 0012 upwards, per hundredth of a chord of its height: those of the first half stand on the
    upper side, upwards, the others on the lower one, downwards, at even distances."""
    side = count // 2
    heights = [bump(x, (k + 1) / (side + 1)) / 100 for k in range(side)]
    none = [0.0] * side
    return [*heights, *none] if y > 0 else [*none, *(-height for height in heights)]


def outline(heights):
    """NACA 0012 with bumps, in hundredths of a chord."""
    return [(x, y + sum(h * unit for h, unit in zip(heights, bumps_at(x, y, len(heights))))) for x, y in airfoil(0, THICKNESS)]


def area(heights):
    points = outline(heights)
    return abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(points, points[1:] + points[:1]))) / 2


def run(command, may_fail=False):
    """What a command prints; None where it fails and may."""
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    if done.returncode == 0:
        return done.stdout
    return None if may_fail else sys.exit(f"{' '.join(map(str, command))}\n{done.stderr}")


def processor_seconds():
    """Of all commands so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Flows:
    """Lift, drag and their gradients; `values` are the heights of the bumps, in hundredths of a chord, and the incidence, in degrees: numbers of like effect,
    which SLSQP takes them for."""

    def __init__(self, quadloop, folder, jobs=1, options=(), by_adjoint=True):
        self.quadloop, self.folder, self.options, self.by_adjoint = str(quadloop), folder, list(options), by_adjoint
        self.pool = ThreadPoolExecutor(jobs)
        self.known = {}
        (folder / "evaluations").mkdir(parents=True)

    def adapt(self, out, alpha, *words):
        return json.loads(run([self.quadloop, "adapt", HERE / "optimise.toml", "-o", out, "--json", *words, "--set", f"solver.alpha={alpha!r}",
                               *self.options]))["cycles"][-1]

    def first(self, alpha):
        """NACA 0012, adapted to its own flow."""
        return self.adapt(self.folder / "first", alpha)

    def evaluate(self, values, keep=None):
        """One shape, one command; with the adjoint its gradients too."""
        key = tuple(map(float, values))
        if key in self.known and keep is None:
            return self.known[key]
        name = self.folder / "evaluations" / f"{len(self.known):04d}_{abs(hash(key)) % 10**8:08d}"
        shape, out = Path(f"{name}.geom"), keep or name
        write_geometry(shape, outline(key[:-1]))
        adjoint = ["--set", 'solver.goal=["lift","drag"]', "--set", 'solver.goal_adjoint="write"'] if self.by_adjoint else []
        found = self.adapt(out, key[-1], "--from", self.folder / "first", "--geometry", shape, "--cycles", 0, *adjoint)
        if self.by_adjoint:
            found["gradients"] = dict(zip(GOALS, self.pool.map(lambda goal: self.along_the_morph(goal, key, shape, out / "cycle_00", found), GOALS)))
        if keep is None:
            shutil.rmtree(out)
        self.known[key] = found
        return found

    def along_the_morph(self, goal, key, shape, cycle, found):
        """The gradient of a goal from how it answers to the places of nodes. Where they have no derivative by the way from the first shape, as the mesh was
        made anew or smoothed, they have one from here."""
        table = cycle / f"{goal}.csv"

        def taken_back(before, may_fail):
            return run([self.quadloop, "-q", "morph", before / "mesh.mesh", "--from", before / "mesh.geom", "--geometry", shape, "--nodal-gradient",
                        cycle / "mesh.mesh", "--fields", f"{goal}_by_x", f"{goal}_by_y", "--outline-gradient", table], may_fail)
        first = max((self.folder / "first").glob("cycle_*"))
        if not found["morphed"] or taken_back(first, may_fail=True) is None:
            taken_back(cycle, may_fail=False)
        with open(table, encoding="ascii") as file:
            by_y = [float(row["dJ_dy"]) for row in csv.DictReader(file)]
        bumps = [bumps_at(x, y, len(key) - 1) for x, y in airfoil(0, THICKNESS)]
        by_heights = [sum(slope * at_point[k] for slope, at_point in zip(by_y, bumps)) for k in range(len(key) - 1)]
        return [*by_heights, found["goals"][goal]["by_alpha"]]

    def gradients(self, values):
        """Of lift and of drag: by the adjoint, or by differences to one side."""
        if self.by_adjoint:
            return self.evaluate(values)["gradients"]
        shifted = [[v + (STEP if i == k else 0) for i, v in enumerate(values)] for k in range(len(values))]
        here, *there = self.pool.map(self.evaluate, [list(values), *shifted])
        return {goal: [(one[name] - here[name]) / STEP for one in there] for goal, name in GOALS.items()}


class Problem:
    """What SLSQP asks for; gradients of drag and lift come together."""

    def __init__(self, flows, lift, scale):
        self.flows, self.lift, self.scale, self.slopes = flows, lift, scale, {}

    def drag(self, values):
        return self.flows.evaluate(values)["cd"] / self.scale

    def missing_lift(self, values):
        return self.flows.evaluate(values)["cl"] / self.lift - 1

    def slope(self, values, goal):
        key = tuple(map(float, values))
        if key not in self.slopes:
            self.slopes = {key: self.flows.gradients(key)}
        return [slope / (self.scale if goal == "drag" else self.lift) for slope in self.slopes[key][goal]]

    def constraints(self, least_area):
        def area_slope(values):
            heights = list(map(float, values[:-1]))
            return [(area([h + (STEP if i == k else 0) for i, h in enumerate(heights)]) - area(heights)) / STEP / least_area
                    for k in range(len(heights))] + [0.0]
        return [{"type": "eq", "fun": self.missing_lift, "jac": lambda v: self.slope(v, "lift")},
                {"type": "ineq", "fun": lambda v: area(list(map(float, v[:-1]))) / least_area - 1, "jac": area_slope}]


def row_of(number, values, found, flows):
    return {"iteration": number, "cd": found["cd"], "cl": found["cl"], "alpha": float(values[-1]), "area": area(list(map(float, values[:-1]))),
            "morphed": found["morphed"], "heights": [float(h) for h in values[:-1]], "flows": len(flows.known), "seconds": round(processor_seconds(), 1)}


def show(row):
    print(f"| {row['iteration']} | {row['cd']:.6f} | {row['cl']:.5f} | {row['alpha']:.3f} | {row['area']:.5f} | {row['flows']} | {row['seconds']:.0f} |", flush=True)


def optimise(flows, bumps, lift, iterations):
    """The rows of the history, and why it ended."""
    start = [0.0] * bumps + [2.0]
    history = []

    def note(values):
        history.append(row_of(len(history), values, flows.evaluate(values), flows))
        show(history[-1])
    flows.first(start[-1])
    print("| iteration | CD | CL | incidence | area | flows | s |\n|---|---|---|---|---|---|---|", flush=True)
    note(start)
    lift = history[0]["cl"] if lift is None else lift
    problem = Problem(flows, lift, history[0]["cd"])
    found = minimize(problem.drag, start, jac=lambda v: problem.slope(v, "drag"), method="SLSQP", callback=note,
                     bounds=[(-LARGEST, LARGEST)] * bumps + [ALPHAS], constraints=problem.constraints(area(start[:-1])),
                     options={"maxiter": iterations, "ftol": 1e-4})
    return history, found.message


def best_of(history, lift):
    """The row of least drag of those that hold lift and area: steps of SLSQP may leave them for a while."""
    least_area = history[0]["area"] * (1 - HELD)
    return min((row for row in history if abs(row["cl"] / lift - 1) <= HELD and row["area"] >= least_area), key=lambda row: row["cd"])


def arguments_given():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", default=str(ROOT / "build" / "release" / "app" / "quadloop"))
    parser.add_argument("-o", "--out", required=True, type=Path)
    parser.add_argument("--bumps", type=int, default=10, help="an even number: half of them on each side")
    parser.add_argument("--gradient", choices=["adjoint", "differences"], default="adjoint")
    parser.add_argument("--iterations", type=int, default=20)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--lift", type=float, help="that of the first shape, without this")
    parser.add_argument("--set", action="append", default=[])
    args = parser.parse_args()
    if args.bumps < 2 or args.bumps % 2:
        parser.error("--bumps must be even, and 2 or more")
    return args


def main():
    args = arguments_given()
    flows = Flows(args.quadloop, args.out, args.jobs, [word for text in args.set for word in ("--set", text)], args.gradient == "adjoint")
    history, message = optimise(flows, args.bumps, args.lift, args.iterations)
    best = best_of(history, args.lift or history[0]["cl"])
    result = {"gradient": args.gradient, "history": history, "evaluations": len(flows.known), "seconds": history[-1]["seconds"], "message": message, "best": best}
    write_geometry(args.out / "shape.geom", outline(best["heights"]))
    flows.evaluate([*best["heights"], best["alpha"]], keep=args.out / "best")
    (args.out / "history.json").write_text(json.dumps(result, indent=1) + "\n")
    print(f"\n{result['evaluations']} flows, {result['seconds']:.0f} s of a processor; {message}; CD {history[0]['cd']:.6f}, at iteration {best['iteration']} {best['cd']:.6f}")


if __name__ == "__main__":
    main()
