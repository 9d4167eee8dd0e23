"""The L1 error of the density on a mesh of the wedge case against the exact oblique shock."""
import math
import sys

import numpy as np

from front_error import l1_error

MACH, GAMMA, SHOCK_DEGREES = 2.0, 1.4, 39.313931846481904
NORMAL = (MACH * math.sin(math.radians(SHOCK_DEGREES))) ** 2
DENSITY_BEHIND = (GAMMA + 1) * NORMAL / ((GAMMA - 1) * NORMAL + 2)
PRESSURE_RATIO = 1 + 2 * GAMMA / (GAMMA + 1) * (NORMAL - 1)


def exact_density(x, y):
    """1 before the shock, which begins at the origin, and DENSITY_BEHIND after it."""
    return np.where(y < x * math.tan(math.radians(SHOCK_DEGREES)), DENSITY_BEHIND, 1.0)


def density_error(path):
    """Number of nodes, and the integral of |density - exact|."""
    return l1_error(path, "density", exact_density, splits=4)


def slope(sizes, errors):
    """Of log error over log size, by least squares."""
    return float(np.polyfit(np.log(sizes), np.log(errors), 1)[0])


if __name__ == "__main__":
    for name in sys.argv[1:]:
        print(name, *density_error(name))
