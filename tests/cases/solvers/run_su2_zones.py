#!/usr/bin/env python3
"""SU2 as a reader of zones and periodic pairs: it conducts heat through concentric cylinders, a zone each, and the temperature is near the exact one, from one
file and from one file per zone alike; and it finds the partner of each node of a pair.

    run_su2_zones.py --quadloop PROGRAM

Status 77 where SU2_CFD is not in PATH.
"""
import argparse
import csv
import math
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from quadloop_runs import ROOT, fail, run, skip  # noqa: E402

LAYERS = "{first=0.04,growth=1.1,count=5}"
RADII, CONDUCTIVITIES = (1.0, 2.0, 3.0), (1.0, 5.0)
PERIODIC = """SOLVER= INC_EULER
INC_VELOCITY_INIT= ( 1, 0, 0 )
CONV_NUM_METHOD_FLOW= FDS
TIME_DISCRE_FLOW= EULER_EXPLICIT
CFL_NUMBER= 1
MARKER_SYM= ( hill, top, tubes )
{pairs}
MESH_FILENAME= {mesh}
ITER= 1
"""


def su2(config, folder):
    done = subprocess.run(["SU2_CFD", config], cwd=folder, capture_output=True, text=True, check=False)
    if "Exit Success" not in done.stdout:
        fail(f"SU2_CFD {config}: {done.stdout[-2000:]}{done.stderr[-500:]}")
    return done.stdout


def exact(radius, zone):
    """Linear in the logarithm of the radius; the heat through both rings is the same."""
    resistances = [math.log(RADII[i + 1] / RADII[i]) / CONDUCTIVITIES[i] for i in range(2)]
    heat = 100 / sum(resistances)
    return 400 - heat * (sum(resistances[:zone]) + math.log(radius / RADII[zone]) / CONDUCTIVITIES[zone])


def largest_error(folder):
    errors = []
    for zone in range(2):
        rows = list(csv.reader((folder / f"restart_{zone}.csv").open()))
        column = [name.strip('" ') for name in rows[0]].index("Temperature")
        errors += [abs(float(row[column]) - exact(math.hypot(float(row[1]), float(row[2])), zone)) for row in rows[1:]]
    return max(errors)


def check_zones(quadloop, folder):
    case = ROOT / "cases" / "concentric_cylinders"
    settings = [word for name in ("hot", "between", "cold") for word in ("--set", f"boundary.{name}.layers={LAYERS}")]
    run([quadloop, "mesh", case / "case.toml", "-o", folder / "concentric_cylinders", "--set", 'output.formats=["mesh","su2"]', *settings])
    for config in (case / "su2").glob("*.cfg"):
        shutil.copy(config, folder)
    su2("cht.cfg", folder)
    error = largest_error(folder)
    if error > 0.2:
        fail(f"the temperature is wrong by {error} of 100")
    print(f"temperature: wrong by at most {error:.3f} of 100")
    values = [(folder / f"restart_{zone}.csv").read_text() for zone in range(2)]
    main = (folder / "cht.cfg").read_text()
    (folder / "cht.cfg").write_text(re.sub("MESH_FILENAME=.*", "", main.replace("MULTIZONE_MESH= YES", "MULTIZONE_MESH= NO")))
    for zone in ("inner", "outer"):
        run([quadloop, "convert", folder / "concentric_cylinders.mesh", folder / f"{zone}.su2", "--block", zone])
        with (folder / f"{zone}.cfg").open("a") as file:
            file.write(f"MESH_FILENAME= {zone}.su2\n")
    su2("cht.cfg", folder)
    if values != [(folder / f"restart_{zone}.csv").read_text() for zone in range(2)]:
        fail("one file per zone gives other temperatures")


def check_pairs(quadloop, folder, name):
    run([quadloop, "mesh", ROOT / "cases" / name / "case.toml", "-o", folder / name, "--set", 'output.formats=["su2"]'])
    mesh = f"{name}.su2"
    text = (folder / mesh).read_text()
    pairs = text.split("% ")[-1]
    markers = re.findall("MARKER_TAG= (.*)", text)
    config = PERIODIC.format(pairs=pairs, mesh=mesh)
    walls = [marker for marker in ("hill", "top", "tubes") if marker in markers and marker not in pairs.replace(",", "").split()]
    config = config.replace("hill, top, tubes", ", ".join(walls))
    (folder / "pairs.cfg").write_text(config)
    said = su2("pairs.cfg", folder)
    distances = re.findall("Matched ([0-9]+) points with a max distance of: (.*)[.]", said)
    if len(distances) != len(pairs.split(",")) // 11 or any(float(distance) > 1e-12 for _, distance in distances):
        fail(f"{name}: SU2 found {distances} for {pairs}")
    print(name, distances)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True, type=Path)
    quadloop = parser.parse_args().quadloop.resolve()
    if shutil.which("SU2_CFD") is None:
        skip("SU2 is not installed")
    with tempfile.TemporaryDirectory(prefix="quadloop_su2_") as folder:
        check_zones(quadloop, Path(folder))
        for name in ("periodic_hill", "tube_bank"):
            check_pairs(quadloop, Path(folder), name)


if __name__ == "__main__":
    main()
