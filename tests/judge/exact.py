"""Signs of determinants over many points at once: by floating point where its error cannot reach the result, else in whole numbers."""
import numpy as np

UNIT = 2.0**-53
ORIENTATION_ERROR = (3 + 16 * UNIT) * UNIT  # of the products' sum, Shewchuk 1997
IN_CIRCLE_ERROR = (10 + 96 * UNIT) * UNIT


def whole(values):
    """The doubles, times one power of two that makes whole numbers of them."""
    ratios = [float(v).as_integer_ratio() for v in values]
    common = max(denominator for _, denominator in ratios)
    return [numerator * (common // denominator) for numerator, denominator in ratios]


def settle(determinant, bound, exactly):
    """The determinants' signs; `exactly(i)` is asked where the i-th lies within its bound."""
    signs = np.sign(determinant).astype(np.int64)
    for i in np.flatnonzero(np.abs(determinant) <= bound):
        value = exactly(i)
        signs[i] = (value > 0) - (value < 0)
    return signs


def orientations(a, b, c):
    """+1 where a, b, c turn left, -1 right, 0 where they lie on a line; arrays of points."""
    left = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1])
    right = (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])

    def exactly(i):
        ax, ay, bx, by, cx, cy = whole([*a[i], *b[i], *c[i]])
        return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    return settle(left - right, ORIENTATION_ERROR * (np.abs(left) + np.abs(right)), exactly)


def in_circles(a, b, c, d):
    """+1 where d lies inside the circle through a, b, c (counter-clockwise), 0 where on it."""
    (ax, ay), (bx, by), (cx, cy) = ((p - d).T for p in (a, b, c))
    terms = [(ax * ax + ay * ay, bx * cy, cx * by), (bx * bx + by * by, cx * ay, ax * cy), (cx * cx + cy * cy, ax * by, bx * ay)]
    value = sum(lift * (p - q) for lift, p, q in terms)
    size = sum(lift * (np.abs(p) + np.abs(q)) for lift, p, q in terms)

    def exactly(i):
        ux, uy, vx, vy, wx, wy, dx, dy = whole([*a[i], *b[i], *c[i], *d[i]])
        ux, uy, vx, vy, wx, wy = ux - dx, uy - dy, vx - dx, vy - dy, wx - dx, wy - dy
        return ((ux * ux + uy * uy) * (vx * wy - wx * vy) + (vx * vx + vy * vy) * (wx * uy - ux * wy) + (wx * wx + wy * wy) * (ux * vy - vx * uy))
    return settle(value, IN_CIRCLE_ERROR * size, exactly)
