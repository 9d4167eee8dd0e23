"""NACA four-digit airfoils with a sharp trailing edge, as .geom files. Standard library only."""
import math

POINTS = 128  # segments on either side


def half_thickness(x, thickness):
    """Of the four-digit formula, its x^4 coefficient changed from 0.1015 to 0.1036: both sides meet at x = 1."""
    return 5 * thickness * (0.2969 * math.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)


def camber_line(x, camber, place):
    """Height and slope of the mean line whose largest height `camber` stands at `place`."""
    reach = place if x < place else 1 - place
    height = camber / reach**2 * ((1 - 2 * place if x >= place else 0) + 2 * place * x - x**2)
    return height, 2 * camber / reach**2 * (place - x)


def airfoil(camber, thickness, place=0.4):
    """Points (x, y) in chords, from behind the trailing edge along the lower side to the nose and back along the upper one: the flow lies to the left."""
    def side(i, sign):
        x = 0.5 * (1 - math.cos(math.pi * i / POINTS))
        height, slope = camber_line(x, camber, place)
        length, offset = math.hypot(1, slope), half_thickness(x, thickness)
        return x - sign * offset * slope / length, height + sign * offset / length
    nose = (0.0, 0.0)
    lower = [side(i, -1) for i in range(POINTS - 1, 0, -1)]
    upper = [side(i, 1) for i in range(1, POINTS)]
    return [(1.0, 0.0), *lower, nose, *upper]


def walk(count):
    """(camber, thickness) of each shape: camber grows from 0 to 2 % of the chord, thickness falls from 12 to 10 %."""
    steps = max(count - 1, 1)
    return [(0.02 * k / steps, 0.12 - 0.02 * k / steps) for k in range(count)]


def write_geometry(path, points):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"1\nairfoil\n{len(points)}\n")
        file.writelines(f"{x!r} {y!r}\n" for x, y in points)
