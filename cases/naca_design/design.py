#!/usr/bin/env python3
# %% Least wave drag of an airfoil at constant lift: SLSQP with adjoint gradients. Needs python3-scipy and python3-matplotlib.
import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import minimize

import quadloop as ql

# %% The first shape is NACA 0012 with a sharp trailing edge.
x = 0.5 * (1 - np.cos(np.linspace(0, np.pi, 129)))
half = 0.6 * (0.2969 * np.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
naca0012 = np.vstack([np.column_stack([x, half])[::-1], np.column_stack([x, -half])[1:-1]])

# %% Ten bumps of Hicks and Henne (J. Aircraft 15, 1978) change it: five on each side, outwards, in hundredths of a chord.
x, y = naca0012.T
bumps = np.sin(np.pi * x[:, None] ** (np.log(0.5) / np.log(np.arange(1, 6) / 6))) ** 3 / 100
up = np.hstack([bumps * (y > 0)[:, None], -bumps * (y < 0)[:, None]])  # how far each bump moves each point
area_by_y = 0.5 * (np.roll(x, 1) - np.roll(x, -1))  # the area of the airfoil is area_by_y @ y


def outline(heights):
    return np.column_stack([x, y + up @ heights])


# %% The mesh of the first shape is adapted to its flow. It follows the other shapes.
case = ql.Case(
    outlines={"airfoil": naca0012},
    geometry={"far_field": 20.0},
    spacing={"min": 0.005, "max": 3.0, "gradation": 1.5, "curvature": 10.0},
    boundary={"airfoil": {"spacing": 0.02, "bc": "wall"}, "farfield": {"bc": "farfield"}},
    adapt={"cycles": 2, "variable": "density", "indicator": "difference", "threshold": "deviation", "max_nodes": 6000, "min": 0.005},
    solver={"kind": "euler", "mach": 0.75, "alpha": 2.0, "iterations": 1000, "tolerance": 1e-8},
)
run = ql.Run(case, adapted=True)
history = []


def flow(values):
    """The flow with bumps of these heights at this angle of attack, and the derivatives of lift and drag by these values."""
    if not history or (values != history[-1][0]).any():
        found = run.evaluate({"airfoil": outline(values[:-1])}, gradient=["lift", "drag"], min_quality=0.3, alpha=values[-1])
        slopes = {goal: np.append(up.T @ found.gradients[goal]["airfoil"][:, 1], found.by_alpha[goal]) for goal in found.gradients}
        history.append((values.copy(), found, slopes))
        print(f"{len(history):3}  cd {found.cd:.6f}  cl {found.cl:.5f}  alpha {values[-1]:.3f}" + (", on a new mesh" if found.remeshed else ""))
    return history[-1][1:]


# %% SLSQP minimises the drag at the lift of the first shape. The area must not become smaller.
values = np.append(np.zeros(10), 2.0)
first = flow(values)[0]
constraints = [
    {"type": "eq", "fun": lambda v: flow(v)[0].cl / first.cl - 1, "jac": lambda v: flow(v)[1]["lift"] / first.cl},
    {"type": "ineq", "fun": lambda v: area_by_y @ up @ v[:-1] / (area_by_y @ y), "jac": lambda v: np.append(area_by_y @ up, 0) / (area_by_y @ y)},
]
mesh = None
while run.mesh is not mesh:  # after a remesh SLSQP starts again, since values on two meshes differ by the discretisation error
    mesh = run.mesh
    values = minimize(lambda v: flow(v)[0].cd / first.cd, values, jac=lambda v: flow(v)[1]["drag"] / first.cd, method="SLSQP",
                      bounds=[(-2, 2)] * 10 + [(-2, 6)], constraints=constraints, options={"maxiter": 12, "ftol": 1e-4}).x
best = flow(values)[0]

# %% Both shapes, and the pressure on them
figure, (pressure, shape) = plt.subplots(2, 1, figsize=(6.5, 5.5), sharex=True, height_ratios=(2, 1), layout="constrained")
for name, found, mark in (("first", first, "C0."), ("best", best, "C1.")):
    wall = np.unique(found.mesh.edges["airfoil"])
    coefficient = (found.flow.solution["pressure"][wall] - 1 / 1.4) / (0.5 * 0.75**2)
    pressure.plot(found.mesh.points[wall, 0], coefficient, mark, markersize=2, label=f"{name}: CD {found.cd:.5f}, CL {found.cl:.4f}")
    shape.plot(*np.vstack([found.outlines["airfoil"], found.outlines["airfoil"][:1]]).T, mark[:2], linewidth=1)
pressure.invert_yaxis()
pressure.set(ylabel="pressure coefficient")
pressure.legend()
shape.set_aspect("equal", adjustable="datalim")
shape.set(xlabel="x, chords")
figure.savefig("shapes.png", dpi=110)

# %% Drag and lift over the flows
figure, (drag, lift) = plt.subplots(2, 1, figsize=(6.5, 4.5), sharex=True, height_ratios=(2, 1), layout="constrained")
drag.semilogy([found.cd for _, found, _ in history], ".-")
drag.set(ylabel="CD")
lift.plot([found.cl / first.cl - 1 for _, found, _ in history], ".-")
lift.set(ylabel="change of CL", xlabel="flows")
figure.savefig("history.png", dpi=110)
