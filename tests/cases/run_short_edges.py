#!/usr/bin/env python3
"""Airfoils whose outlines have edges much shorter than the cells: no corner of a cell is small.

    run_short_edges.py --quadloop PROGRAM [--count N] [--report]

The outlines have what collections of airfoils have: blunt bases of 1e-5 to 1e-2 chords in one segment or three, doubled points, tiny segments at
the nose, tiny spikes, cusps. spacing.min is 1e-5 to 1e-3, so that some bases are resolved and the others merged. Fails where a cell's
corner is below 20 degrees; --report prints the counts of meshes with one below 1, 5 and 20 degrees and does not fail.
"""
import argparse
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

LIMITS = (1, 5, 20)
CASE = """[geometry]
file = "airfoil.dat"
far_field = 5
[spacing]
min = {min:.6g}
max = 1
curvature = 10
[boundary.airfoil]
spacing = {spacing}
bc = "wall"
"""


def outline(number):
    """Points from the trailing edge over the upper side, nose and lower side; chord 1."""
    rng = random.Random(number)
    panels, thickness = rng.choice([20, 40, 80]), rng.uniform(0.04, 0.2)
    base = rng.choice([0, 10 ** rng.uniform(-5, -2)])
    cusp = number % 5 == 4

    def half(x):
        y = 5 * thickness * (0.2969 * math.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
        return y * ((1 - x * x) if cusp else 1) + 0.5 * base * x

    def camber(x):
        return 0.02 * math.sin(math.pi * x)

    xs = [0.5 * (1 - math.cos(math.pi * i / panels)) for i in range(panels + 1)]
    points = [(x, camber(x) + half(x)) for x in reversed(xs)] + [(x, camber(x) - half(x)) for x in xs[1:]]
    if base == 0:
        points[0] = points[-1] = (1, 0)
    elif number % 3 == 0:
        points += [(1 + 0.05 * base, 0.5 * base * (2 * i / 3 - 1)) for i in (1, 2)]
    if number % 4 == 1:
        at = rng.randrange(2, len(points) - 2)
        points.insert(at, points[at])
    if number % 4 == 2:
        nose, step = panels, 10 ** rng.uniform(-6, -4)
        x, y = points[nose]
        points.insert(nose + 1, (x + 0.1 * step, y - step))
    if number % 4 == 3:
        at, width = panels // 2, 10 ** rng.uniform(-6, -4)
        x, y = points[at]
        points[at + 1:at + 1] = [(x - 0.5 * width, y + width), (x - width, y)]
    return points, {"min": 10 ** rng.uniform(-5, -3), "spacing": rng.choice([0.005, 0.01, 0.02])}


def smallest_angle(program, folder, number, mesh_type):
    points, sizes = outline(number)
    (folder / "airfoil.dat").write_text("airfoil\n" + "".join(f"{x:.9f} {y:.9f}\n" for x, y in points))
    (folder / "case.toml").write_text(CASE.format(**sizes))
    done = subprocess.run([program, "mesh", folder / "case.toml", "--type", mesh_type, "-o", folder / "a", "--json"],
                          capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"outline {number}: {done.stderr}")
    return found(json.loads(done.stdout), "min_angle")


def found(record, key):
    if not isinstance(record, dict):
        return None
    if key in record:
        return record[key]
    return next((value for part in record.values() if (value := found(part, key)) is not None), None)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--count", type=int, default=12)
    parser.add_argument("--report", action="store_true")
    options = parser.parse_args()
    small = []
    counts = dict.fromkeys(LIMITS, 0)
    with tempfile.TemporaryDirectory() as name:
        for number in range(options.count):
            for mesh_type in ("hybrid", "delaunay"):
                angle = smallest_angle(options.quadloop, pathlib.Path(name), number, mesh_type)
                for limit in LIMITS:
                    counts[limit] += angle < limit
                if angle < LIMITS[-1]:
                    small.append(f"outline {number}, {mesh_type}: {angle:.2f} degrees")
    print(f"{2 * options.count} meshes; with a corner below 1, 5, 20 degrees: {list(counts.values())}")
    if small and not options.report:
        sys.exit("\n".join(small))


if __name__ == "__main__":
    main()
