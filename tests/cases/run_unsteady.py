#!/usr/bin/env python3
"""Flows that are not steady. A table of figures with their bounds; status 1 where one fails.

    run_unsteady.py --quadloop PROGRAM cylinder|loop

cylinder  laminar flow behind a circular cylinder at Reynolds number 100: Strouhal number and mean drag, as measured and computed by many
loop      `adapt` of a flow that is carried on in time: the same folder on any number of ranks, and after being killed and resumed; the second
          cycle goes on in time at once; `solve` with and without `unsteady`
"""
import argparse
import json
import math
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from adapt_runs import adapt, command_of, require, require_same_folders
from quadloop_runs import run
from run_adapt import killed_after
from run_forces import Figures

CYLINDER = """[geometry]
file = "circle.geom"
far_field = 25.0
[spacing]
min = 0.02
max = 3.0
gradation = 1.5
[boundary.circle]
bc = "wall"
spacing = 0.04
[boundary.farfield]
bc = "farfield"
[[source]]
box = [-1.0, 6.0, -1.2, 1.2]
spacing = 0.12
[mesh]
root = [-25.0, -25.0, 50.0, 1, 1]
[solver]
mach = 0.2
reynolds = 100
time = "accurate"
end_time = 560
average_from = 400
time_step = 0.4
iterations = 10000
"""

LOOP = """[geometry]
file = "circle.geom"
far_field = 4.0
[spacing]
min = 0.1
max = 1.0
gradation = 1.5
[boundary.circle]
bc = "wall"
spacing = 0.2
[boundary.farfield]
bc = "farfield"
[adapt]
cycles = 1
variable = "density"
max_nodes = 4000
[solver]
mach = 0.3
reynolds = 100
iterations = 10
unsteady = "carry_on"
flow_throughs = 2
time_step = 0.4
"""


def write_case(folder, text):
    points = [(0.5 * math.cos(2 * math.pi * k / 240), -0.5 * math.sin(2 * math.pi * k / 240)) for k in range(240)]
    (folder / "circle.geom").write_text("1\ncircle\n240\n" + "".join(f"{x!r} {y!r}\n" for x, y in points))
    case = folder / "case.toml"
    case.write_text(text)
    return case


def told(quadloop, *words):
    done = subprocess.run([str(word) for word in (quadloop, "-q", *words, "--json")], check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(done.stdout)


def mesh_of(quadloop, case):
    run([quadloop, "-q", "mesh", case, "-o", case.with_name("body"), "--set", 'output.formats=["mesh"]'])
    return case.with_name("body.mesh")


def cylinder(quadloop, folder, figures):
    case = write_case(folder, CYLINDER)
    flow = told(quadloop, "solve", case, mesh_of(quadloop, case), "-o", folder / "flow.mesh")["unsteady"]
    figures.add("Strouhal number, measured 0.164 to 0.167", flow["strouhal"], 0.157, 0.17)
    figures.add("mean CD, computed by others 1.32 to 1.37", flow["cd"]["mean"], 1.3, 1.4)
    figures.add("largest CL, computed by others 0.32 to 0.34", flow["cl"]["largest"], 0.27, 0.35)
    figures.add("smallest CL", flow["cl"]["smallest"], -0.35, -0.27)
    figures.add("steps not solved", flow["unsolved"], 0, 0)


def check_solve(quadloop, folder, case, figures):
    """Asked or not asked to carry on."""
    mesh = mesh_of(quadloop, case)
    carried = told(quadloop, "solve", case, mesh, "-o", folder / "carried.mesh")
    stopped = told(quadloop, "solve", case, mesh, "-o", folder / "stopped.mesh", "--set", 'solver={ mach = 0.3, reynolds = 100, iterations = 10 }')
    require("unsteady" not in stopped and stopped["steps"] == 10 and not stopped["converged"], f"stopped: {stopped}")
    require(carried["converged"] and carried["unsteady"]["steady_steps"] == 10, f"carried on: {carried}")
    require(not any("tolerance" in text for text in carried["warnings"]), f"warned: {carried['warnings']}")
    figures.add("solve: time reached, 2 diameters over the speed", carried["time"], 6.666, 6.667)
    figures.add("solve: its mean CL", carried["unsteady"]["cl"]["mean"], carried["cl"], carried["cl"])
    times = [row.split(",")[4] for row in (folder / "carried.history.csv").read_text().splitlines()[1:]]
    figures.add("solve: rows of the history in time", sum(float(text) > 0 for text in times), 17, 17)
    again = told(quadloop, "solve", case, folder / "carried.mesh", "-o", folder / "again.mesh")
    figures.add("solve: steps as a steady flow of one that goes on", again["unsteady"]["steady_steps"], 0, 0)


def loop(quadloop, folder, figures):
    case = write_case(folder, LOOP)
    begin = time.monotonic()
    adapt(quadloop, case, folder / "on_1")
    seconds = time.monotonic() - begin
    for ranks in (2, 3, 5):
        adapt(quadloop, case, folder / f"on_{ranks}", ranks)
        require_same_folders(folder / "on_1", folder / f"on_{ranks}", f"{ranks} ranks")
    made = folder / "killed"
    ended = killed_after(command_of(quadloop, 1, "adapt", case, "-o", made), 0.4 * seconds)
    adapt(quadloop, case, made, options=["--resume"])
    require_same_folders(folder / "on_1", made, "killed and resumed")
    print("killed in the middle" if not ended else "ended before it was killed")
    records = [json.loads((cycle / "record.json").read_text()) for cycle in sorted((folder / "on_1").glob("cycle_*"))]
    require(len(records) == 2, f"{len(records)} cycles")
    for cycle, record in enumerate(records):
        flow = record["unsteady"]
        figures.add(f"cycle {cycle}: steps as a steady flow", flow["steady_steps"], 10 * (cycle == 0), 10 * (cycle == 0))
        figures.add(f"cycle {cycle}: steps in time", flow["steps"], 17, 17)
        figures.add(f"cycle {cycle}: CD", record["cd"], flow["cd"]["smallest"], flow["cd"]["largest"])
    check_solve(quadloop, folder, case, figures)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("what", choices=("cylinder", "loop"))
    args = parser.parse_args()
    figures = Figures()
    with tempfile.TemporaryDirectory(prefix="quadloop_unsteady_") as name:
        {"cylinder": cylinder, "loop": loop}[args.what](args.quadloop, Path(name), figures)
    return 1 if figures.missed else 0


if __name__ == "__main__":
    sys.exit(main())
