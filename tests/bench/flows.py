#!/usr/bin/env python3
"""Flows of the built-in solver from the free stream to its tolerance: nodes, steps, processor seconds, orders by which the residual fell, forces and
a figure of the flow beside what is known. Each is meshed from an outline that this script writes, or on a stretched mesh of its own. One row a flow,
told as it ends; where a flow is not steady and is carried on in time, a line below the table tells of it. Standard library only.

    flows.py --quadloop PROGRAM [--only TEXT] [--set KEY=VALUE]... [--update docs/notes/flows.md] [--require]

--only     flows whose name contains the text
--set      put over every flow's case, as solver.iterations=100
--update   puts the figures into the file, between this script's two markers
--require  exit status 1 where a flow neither reaches its tolerance nor is carried on in time
"""
import argparse
import dataclasses
import math
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import exact_flows as exact
import flow_shapes as shapes
from figures import add_update, tell

AIRFOIL = {"spacing": {"min": 0.005, "max": 7.0, "gradation": 1.5, "curvature": 10.0}, "geometry": {"far_field": 50.0},
           "boundary.airfoil": {"spacing": 0.0125, "corner_spacing": 0.0065, "bc": "wall"}, "boundary.farfield": {"bc": "farfield"}}
CIRCLE = {"spacing": {"min": 0.02, "max": 2.0, "gradation": 1.5}, "geometry": {"far_field": 20.0},
          "boundary.circle": {"spacing": 0.02, "bc": "wall"}, "boundary.farfield": {"bc": "farfield"}}
NEAR_CIRCLE = {**CIRCLE, "geometry": {"far_field": 6.0}, "spacing": {"min": 0.02, "max": 0.17, "gradation": 1.5}}
RAMP = {"spacing": {"min": 0.02, "max": 0.034, "gradation": 1.5},
        "boundary.inlet": {"bc": "inflow"}, "boundary.top": {"bc": "inflow"},
        "boundary.outlet": {"bc": "outflow"}, "boundary.floor": {"bc": "symmetry"}, "boundary.ramp": {"bc": "wall"}}
BUMP = {"spacing": {"min": 0.015, "max": 0.04, "gradation": 1.5}, "boundary.inlet": {"bc": "farfield"},
        "boundary.bump": {"bc": "wall", "spacing": 0.02},
        "boundary.outlet": {"bc": "outflow", "pressure": 1.0}, "boundary.floor": {"bc": "symmetry"}, "boundary.behind": {"bc": "symmetry"},
        "boundary.top": {"bc": "symmetry"}}
STEP = {"spacing": {"min": 0.012, "max": 0.03, "gradation": 1.5}, "boundary.inlet": {"bc": "inflow"}, "boundary.outlet": {"bc": "outflow"},
        "boundary.wall": {"bc": "wall"}, "boundary.top": {"bc": "symmetry"}}
BLUNT = {"spacing": {"min": 0.03, "max": 0.07, "gradation": 1.5}, "boundary.body": {"bc": "wall", "spacing": 0.04},
         "boundary.outlet": {"bc": "outflow"},
         "boundary.inlet": {"bc": "inflow"}, "boundary.axis": {"bc": "symmetry"}}
LAYERS = {**AIRFOIL, "boundary.airfoil": {**AIRFOIL["boundary.airfoil"], "layers": {"first": 1e-3, "growth": 1.3, "count": 8}}}
ALEMBERT = "d'Alembert"


@dataclasses.dataclass
class Flow:
    name: str
    case: dict
    mach: float
    alpha: float
    outline: str = ""   # a .geom text
    mesh: str = ""      # a .mesh text instead of one made by the program
    lift: str = ""      # what is known of CL and CD, and by whom
    drag: str = ""
    source: str = ""
    figure: str = ""    # "stagnation": the largest pressure against the exact one
    solver: dict = dataclasses.field(default_factory=dict)


def number(value):
    return f"{value:.4f}"


def about_airfoil(mach, alpha, **known):
    return Flow(f"NACA 0012, M {mach}, {alpha} degrees", AIRFOIL, mach, alpha, shapes.airfoil(0, 0, 0.12), **known)


def in_far_field(half_width, kind):
    """The airfoil in a square of this half width, in chords, against what lies beyond it."""
    flow = about_airfoil(0.8, 1.25)
    case = {**AIRFOIL, "geometry": {"far_field": half_width}}
    return dataclasses.replace(flow, name=f"{flow.name}, {kind} far field {half_width:.0f} chords away", case=case, solver={"far_field": kind})


def on_ramp(mach, degrees):
    lift, drag = exact.ramp_forces(mach, degrees)
    return Flow(f"ramp of {degrees} degrees, M {mach}", RAMP, mach, 0, shapes.ramp(degrees),
                lift=number(lift), drag=number(drag), source="oblique shock")


def about_diamond(alpha):
    lift, drag = exact.diamond_forces(2, 5, alpha)
    case = {**AIRFOIL, "geometry": {"far_field": 4.0}, "spacing": {"min": 0.006, "max": 0.3, "gradation": 1.5},
            "boundary.farfield": {"bc": "farfield"}}
    return Flow(f"diamond of 5 degrees, M 2, {alpha} degrees", case, 2, alpha, shapes.diamond(5), lift=number(lift), drag=number(drag),
                source="shocks and expansions")


def about_circle(mach):
    known = {"lift": "0", "drag": "0" if mach < 0.4 else "", "source": ALEMBERT if mach < 0.4 else "", "figure": "stagnation"}
    return Flow(f"circle, M {mach}", CIRCLE if mach < 1 else NEAR_CIRCLE, mach, 0, shapes.circle(), **known)


def stretched(ratio, mach, alpha, seed):
    known = {"lift": "0", "drag": "0", "source": ALEMBERT} if mach < 0.6 else {}
    return Flow(f"NACA 0012, stretched {ratio}, M {mach}, {alpha} degrees", AIRFOIL, mach, alpha, shapes.airfoil(0, 0, 0.12),
                shapes.stretched_mesh(160, 44, ratio, 30, seed), solver={"unsteady": "carry_on"}, **known)


def three_elements(mach, **more):
    root = Path(__file__).resolve().parents[2]
    case = {"spacing": {"min": 0.004, "max": 1.0, "gradation": 1.5, "curvature": 10.0},
            **{f"boundary.{part}": {"bc": "wall", "spacing": size} for part, size in (("slat", 0.006), ("main", 0.012), ("flap", 0.006))},
            "boundary.farfield": {"bc": "farfield"}}
    outline = (root / "cases/three_element/three_element.geom").read_text()
    return Flow(f"three elements, M {mach}", case, mach, 0, outline, drag="0", source=ALEMBERT, **more)


def all_flows():
    bump, step = shapes.bump(0.1), shapes.forward_step()
    return [
        about_airfoil(0.3, 0, lift="0", drag="0", source=ALEMBERT),
        about_airfoil(0.5, 0, lift="0", drag="0", source=ALEMBERT),
        about_airfoil(0.63, 2, drag="0", source=ALEMBERT),
        about_airfoil(0.8, 1.25),
        about_airfoil(0.85, 1),
        about_airfoil(0.95, 0, lift="0", source="symmetry"),
        about_airfoil(1.2, 0, lift="0", source="symmetry", figure="stagnation"),
        *(in_far_field(half_width, kind) for kind in ("uniform", "vortex") for half_width in (15.0, 50.0, 150.0)),
        *(about_circle(mach) for mach in (0.1, 0.38, 2, 3)),
        *(on_ramp(mach, 10) for mach in (2, 2.5, 3)),
        on_ramp(3, 15),
        about_diamond(0), about_diamond(3),
        Flow("bump of 10 %, M 0.5", BUMP, 0.5, 0, bump, drag="0", source=ALEMBERT),
        Flow("bump of 10 %, M 0.675", BUMP, 0.675, 0, bump),
        Flow("forward step, M 3", STEP, 3, 0, step, figure="stagnation", solver={"iterations": 1000, "unsteady": "carry_on"}),
        Flow("blunt body, M 3", BLUNT, 3, 0, shapes.blunt_body(), figure="stagnation"),
        three_elements(0.2, solver={"far_field": "vortex"}),
        Flow("NACA 2412, M 0.73, 1 degrees", AIRFOIL, 0.73, 1, shapes.airfoil(0.02, 0.4, 0.12)),
        Flow("NACA 0012 with layers, M 0.5", LAYERS, 0.5, 0, shapes.airfoil(0, 0, 0.12), lift="0", drag="0", source=ALEMBERT),
        Flow("NACA 0012 with layers, M 0.8, 1.25 degrees", LAYERS, 0.8, 1.25, shapes.airfoil(0, 0, 0.12)),
        *(stretched(ratio, mach, alpha, seed) for seed, (ratio, mach, alpha) in enumerate(((5, 0.5, 0), (20, 0.5, 0), (20, 0.8, 1.25)))),
    ]


def toml_value(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml_value(entry)}" for key, entry in value.items()) + " }"
    return f'"{value}"' if isinstance(value, str) else str(value)


def case_text(flow, outline):
    tables = {**flow.case, "solver": {"mach": float(flow.mach), "alpha": float(flow.alpha), **flow.solver}}
    tables["geometry"] = {**flow.case.get("geometry", {}), "file": outline.name}
    rows = []
    for name, keys in tables.items():
        rows += [f"[{name}]", *(f"{key} = {toml_value(value)}" for key, value in keys.items()), ""]
    return "\n".join(rows)


def run(words):
    """Processor seconds, standard output and error."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        return None, done.stdout + done.stderr
    return after.ru_utime - before.ru_utime, done.stdout + done.stderr


def prepared(program, flow, folder, settings):
    """The case file and the mesh to solve on."""
    case, mesh, outline = folder / "case.toml", folder / "flow.mesh", folder / "outline.geom"
    outline.write_text(flow.outline)
    case.write_text(case_text(flow, outline))
    if flow.mesh:
        mesh.write_text(flow.mesh)
        return case, mesh
    seconds, said = run([program, "-q", "mesh", case, "-o", mesh.with_suffix(""), "--set", 'output.formats=["mesh"]', *settings])
    if seconds is None:
        sys.exit(f"{flow.name}: {said}")
    return case, mesh


def solution(path):
    """The solver's constants (steps, time, Mach number, incidence, CL, CD, residual) and its rows."""
    text = path.read_text()
    constants = re.search(r"#Number of constants\n((?:\S+\n)+)", text)[1].split()
    _, values = text.split("#names:", 1)
    return [float(value) for value in constants[1:]], [list(map(float, row.split())) for row in values.splitlines()[1:] if row and row[0] != "#"]


def row_of(flow, path, seconds):
    """A row of the table, from the file of the solution."""
    constants, rows = solution(path)
    steps, residual = int(constants[0]), constants[6]
    found = f"{1.4 * max(row[3] for row in rows) / exact.stagnation(flow.mach):.4f}" if flow.figure else ""
    orders = -math.log10(max(residual, 1e-16))
    row = (f"| {flow.name} | {len(rows)} | {steps} | {seconds:.1f} | {orders:.1f} | {constants[4]:.4f} | {flow.lift} | "
           f"{constants[5]:.5f} | {flow.drag} | {flow.source} | {found} |")
    return row, residual


def solve(program, flow, settings):
    """A row of the table, what is told of a flow that was carried on in time, and whether it was solved or carried on."""
    with tempfile.TemporaryDirectory(prefix="quadloop_flows_") as name:
        folder = Path(name)
        case, mesh = prepared(program, flow, folder, settings)
        seconds, said = run([program, "solve", case, mesh, "-o", folder / "out.mesh", *settings])
        if seconds is None:
            return f"| {flow.name} | | | | | failed: {said.strip()[:80]} | | | | | |", "", False
        row, residual = row_of(flow, folder / "out.mesh", seconds)
    moving = told_of_time(said)
    if moving:
        row = row.replace(f"| {flow.name} |", f"| {flow.name} (means over time) |", 1)
    return row, f"{flow.name}: {moving}." if moving else "", bool(moving) or residual <= 1.0001e-8


def told_of_time(said):
    """What the program says of a flow that it carried on in time, or nothing."""
    line = re.search(r"the residual fell by .* continued in .*", said)
    return line[0].strip() if line else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--only", default="")
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--require", action="store_true")
    add_update(parser)
    args = parser.parse_args()
    settings = [word for text in args.set for word in ("--set", text)]
    rows, moving, met = [], [], True
    for flow in all_flows():
        if args.only not in flow.name:
            continue
        row, told, holds = solve(args.quadloop, flow, settings)
        rows.append(row)
        moving += [told] if told else []
        met = met and holds
        print(row, flush=True)
    head = ("processor seconds of one run each.\n\n"
            "| flow | nodes | steps | s | orders | CL | known | CD | known | by | largest pressure over exact |\n"
            "|" + "---|" * 11 + "\n")
    text = head + "\n".join(rows)
    if moving:
        text += "\n\nNot steady, and carried on in time:\n" + "\n".join(f"- {told}" for told in moving)
    tell(text, "flows.py", args.update)
    return 0 if met or not args.require else 1


if __name__ == "__main__":
    sys.exit(main())
