#!/usr/bin/env python3
"""Stands in for SU2_CFD where that is not installed: reads configuration, mesh and restart file as SU2 does, refuses what SU2 refuses, and leaves a restart file
and a history of SU2's layout (CSU2BinaryFileWriter, CCSVFileWriter). Its flow is the exact one behind an oblique shock. Standard library only.

    su2_stand_in.py CONFIGURATION
"""
import math
import struct
import sys

GAMMA, SHOCK = 1.4, math.radians(39.313932)
BEFORE, BEHIND = (1.0, 2.0, 0.0, 1 / 1.4), (1.458435, 1.640526 * math.cos(math.radians(10)), 1.640526 * math.sin(math.radians(10)), 1.706579 / 1.4)
MAGIC, NAME = 535532, 33


def refuse(message):
    """As CBaseMPIWrapper::Error, and what a launcher adds."""
    print(f'\n\nError in "void CStandIn::Run()": \n{"-" * 73}\n{message}\n{"-" * 30} Error Exit {"-" * 31}\n\nMPI_ABORT was invoked on rank 0', flush=True)
    sys.exit(1)


def configuration(path):
    keys = {}
    for line in open(path):
        line = line.split("%")[0].strip()
        if line:
            key, value = (word.strip() for word in line.split("=", 1))
            if key in keys:
                refuse(f"{key}: option appears twice")
            keys[key] = value
    return keys


def words(value):
    return value.replace("(", " ").replace(")", " ").replace(",", " ").split()


def mesh(path):
    """Nodes and names of markers."""
    lines = iter(open(path).read().splitlines())
    points, markers = [], []
    for line in lines:
        key, _, value = line.partition("=")
        if key == "NPOIN":
            points = [tuple(map(float, next(lines).split()[:2])) for _ in range(int(value))]
        elif key == "MARKER_TAG":
            markers.append(value.strip())
    return points, markers


def state(keys, points):
    """The names behind the coordinates in the restart file that it starts from, whose nodes must be the mesh's."""
    name = keys["SOLUTION_FILENAME"]
    if keys["READ_BINARY_RESTART"] == "YES":
        data = open(name, "rb").read()
        magic, columns, rows, _, _ = struct.unpack_from("5i", data)
        if magic != MAGIC:
            refuse(f"{name} is not a binary SU2 restart file")
        names = [data[20 + NAME * k:20 + NAME * (k + 1)].split(b"\0")[0].decode() for k in range(columns)]
        values = list(struct.iter_unpack(f"{columns}d", data[20 + NAME * columns:]))
    else:
        lines = open(name).read().splitlines()
        names = [word.strip('" ') for word in lines[0].split(",")][1:]
        values = [tuple(map(float, line.split(",")))[1:] for line in lines[1:]]
        rows = len(values)
    if rows != len(points) or names[:2] != ["x", "y"] or any(row[:2] != p for row, p in zip(values, points)):
        refuse(f"{name} is of another mesh")
    if names[2:6] != ["Density", "Momentum_x", "Momentum_y", "Energy"]:
        refuse(f"{name} begins with {names[2:6]}")
    if any(row[2] <= 0 for row in values):
        refuse(f"{name} has a density that is not positive")
    return names[2:]


def conserved(x, y):
    density, u, v, pressure = BEHIND if y < x * math.tan(SHOCK) and x > 0 else BEFORE
    return density, density * u, density * v, pressure / (GAMMA - 1) + 0.5 * density * (u * u + v * v)


def main(path):
    keys = configuration(path)
    if float(keys.get("CFL_NUMBER", "1.25")) > float(keys.get("STABLE_CFL", "inf")):
        refuse("SU2 has diverged (Residual > 10^20 detected).")
    points, markers = mesh(keys["MESH_FILENAME"])
    named = [word for key, value in keys.items() if key.startswith("MARKER_") and key not in ("MARKER_MONITORING", "MARKER_PLOTTING") for word in words(value)]
    for marker in markers:
        if marker not in named:
            refuse(f"marker {marker} of the mesh has no condition")
    turbulent = keys["SOLVER"] == "RANS"
    names = ["Density", "Momentum_x", "Momentum_y", "Energy"] + (["Nu_Tilde"] if turbulent else [])
    started = "nothing"
    if keys["RESTART_SOL"] == "YES":
        found = state(keys, points)
        if found[:len(names)] != names:
            refuse(f"the restart file has {found}, where {names} are wanted")
        started = " ".join(found)
    rows = [(*p, *conserved(*p), *((3e-5,) if turbulent else ())) for p in points]
    name = keys["RESTART_FILENAME"].rsplit(".", 1)[0]
    if keys["READ_BINARY_RESTART"] == "YES":
        with open(name + ".dat", "wb") as file:
            file.write(struct.pack("5i", MAGIC, len(names) + 2, len(points), 0, 0))
            for variable in ["x", "y", *names]:
                file.write(variable.encode().ljust(NAME, b"\0"))
            for row in rows:
                file.write(struct.pack(f"{len(row)}d", *row))
    else:
        with open(name + ".csv", "w") as file:
            print(*(f'"{variable}"' for variable in ["PointID", "x", "y", *names]), sep=",", file=file)
            for number, row in enumerate(rows):
                print(number, *(f"{value:.15e}" for value in row), sep=", ", file=file)
    with open(keys["CONV_FILENAME"] + ".csv", "w") as file:
        print('"Inner_Iter",     "rms[Rho]"     ,       "CD"       ,       "CL"       ', file=file)
        change = float(keys.get("RESIDUAL_CHANGE", "-1"))
        for step in range(4):
            print(f"{step}, {-2.0 + change * step}, {0.02 + 0.1 ** step}, {0.3 + 0.1 ** step}", sep=",", file=file)
    print(f"started from {started}")
    if "CONV_RESIDUAL_MINVAL" in keys:
        converged = -2 + 3 * change <= float(keys["CONV_RESIDUAL_MINVAL"])
        print("All convergence criteria satisfied." if converged else f"\nMaximum number of iterations reached (ITER = {keys['ITER']}) before convergence.")


main(sys.argv[1])
