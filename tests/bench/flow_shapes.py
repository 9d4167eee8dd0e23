"""Outlines and meshes of the table of flows. Standard library only."""
import math
import random


def geometry(*boundaries):
    """A .geom text of (name, points, is_open)."""
    rows = [str(len(boundaries))]
    for name, points, is_open in boundaries:
        rows += [name + " open" * is_open, str(len(points)), *(f"{x!r} {y!r}" for x, y in points)]
    return "\n".join(rows) + "\n"


def circle():
    """Of diameter 1, alone: the case adds a far field."""
    return geometry(("circle", [(0.5 * math.cos(a), -0.5 * math.sin(a)) for a in (2 * math.pi * k / 720 for k in range(720))], False))


def diamond(half_angle):
    y = 0.5 * math.tan(math.radians(half_angle))
    return geometry(("airfoil", [(0.0, 0.0), (0.5, y), (1.0, 0.0), (0.5, -y)], False))


def naca4(camber, place, thickness, points=160):
    """Four digits with a closed trailing edge: camber, its place and thickness in chords."""
    def half(x):
        return 5 * thickness * (0.2969 * math.sqrt(x) - 0.1260 * x - 0.3516 * x ** 2 + 0.2843 * x ** 3 - 0.1036 * x ** 4)

    def middle(x):
        if camber == 0:
            return 0.0
        return camber * ((2 * place * x - x * x) / place ** 2 if x < place else (1 - 2 * place + 2 * place * x - x * x) / (1 - place) ** 2)

    stations = [0.5 * (1 - math.cos(math.pi * k / points)) for k in range(points + 1)]
    upper = [(x, middle(x) + half(x)) for x in reversed(stations[1:])]
    upper[0] = (1.0, 0.0)
    lower = [(x, middle(x) - half(x)) for x in stations[:-1]]
    return upper + lower


def airfoil(*digits):
    return geometry(("airfoil", naca4(*digits), False))


def ramp(degrees):
    """A floor half a length before a ramp, 1 long."""
    y = math.tan(math.radians(degrees))
    return geometry(("inlet", [(-0.5, 1.2), (-0.5, 0.0)], True), ("floor", [(-0.5, 0.0), (0.0, 0.0)], True),
                    ("ramp", [(0.0, 0.0), (1.0, y)], True), ("outlet", [(1.0, y), (1.0, 1.2)], True),
                    ("top", [(1.0, 1.2), (-0.5, 1.2)], True))


def bump(height):
    """A channel of 3 x 1 with a circular arc on its floor, 1 long (Ni 1982)."""
    radius = (0.25 + height ** 2) / (2 * height)
    half = math.asin(0.5 / radius)
    arc = [(radius * math.sin(a), radius * (math.cos(a) - 1) + height) for a in (half * (2 * k / 80 - 1) for k in range(81))]
    arc[0], arc[-1] = (-0.5, 0.0), (0.5, 0.0)
    return geometry(("inlet", [(-1.5, 1.0), (-1.5, 0.0)], True), ("floor", [(-1.5, 0.0), (-0.5, 0.0)], True), ("bump", arc, True),
                    ("behind", [(0.5, 0.0), (1.5, 0.0)], True), ("outlet", [(1.5, 0.0), (1.5, 1.0)], True),
                    ("top", [(1.5, 1.0), (-1.5, 1.0)], True))


def forward_step():
    """A tunnel of 3 x 1 with a step of 0.2 at 0.6 (Woodward and Colella 1984)."""
    return geometry(("inlet", [(0.0, 1.0), (0.0, 0.0)], True), ("wall", [(0.0, 0.0), (0.6, 0.0), (0.6, 0.2), (3.0, 0.2)], True),
                    ("outlet", [(3.0, 0.2), (3.0, 1.0)], True), ("top", [(3.0, 1.0), (0.0, 1.0)], True))


def blunt_body():
    """The front of a circle of radius 1, upper half, with the stream along its axis: all that leaves is faster than sound."""
    body = [(-math.cos(a), math.sin(a)) for a in (0.5 * math.pi * k / 180 for k in range(181))]
    body[-1] = (0.0, 1.0)
    return geometry(("body", body, True), ("outlet", [(0.0, 1.0), (0.0, 4.0)], True), ("inlet", [(0.0, 4.0), (-2.5, 4.0), (-2.5, 0.0)], True),
                    ("axis", [(-2.5, 0.0), (-1.0, 0.0)], True))


def stretched_mesh(around, outwards, ratio, far, seed):
    """A .mesh text of triangles about the NACA 0012, `ratio` times as long along the wall as across it there, out to a circle; diagonals
    and places are a little irregular by the seed."""
    chance = random.Random(seed)
    wall = naca4(0, 0, 0.12, around // 2)
    growth = far_growth(outwards, 2.0 / around / ratio, far)
    rows = []
    for j in range(outwards + 1):
        share = (growth ** j - 1) / (growth ** outwards - 1)
        row = []
        for k, (x, y) in enumerate(wall):
            angle = 2 * math.pi * k / len(wall)
            moved = share * (1 + (0.15 * (growth - 1) * chance.uniform(-1, 1) if 0 < j < outwards else 0))
            row.append((x + moved * (0.5 + far * math.cos(angle) - x), y + moved * (far * math.sin(angle) - y)))
        rows.append(row)
    return mesh_text(rows, chance)


def far_growth(count, first, far):
    """So that so many layers reach from the first height to the far field."""
    low, high = 1.0001, 3.0
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if first * (middle ** count - 1) / (middle - 1) < far else (low, middle)
    return low


def mesh_text(rows, chance):
    n = len(rows[0])
    triangles = []
    for j in range(len(rows) - 1):
        for k in range(n):
            a, b, c, d = j * n + k, j * n + (k + 1) % n, (j + 1) * n + (k + 1) % n, (j + 1) * n + k
            triangles += [(a, d, c), (a, c, b)] if chance.random() < 0.5 else [(a, d, b), (d, c, b)]
    points = [point for row in rows for point in row]
    last = (len(rows) - 1) * n
    edges = {"airfoil": [((k + 1) % n, k) for k in range(n)], "farfield": [(last + k, last + (k + 1) % n) for k in range(n)]}
    text = ["#Number of grid points", str(len(points)), *(f"{x!r} {y!r}" for x, y in points), "#Number of blocks", "1",
            "#Number of triangular elements", str(len(triangles)), *rows_of(triangles, points), "#Number of quadrilateral elements", "0",
            "#Number of boundaries", "2"]
    for number, (name, pairs) in enumerate(edges.items(), 1):
        text += [f"#Number of edges for boundary {number} ({name})", str(n), *(f"{a + 1} {b + 1}" for a, b in pairs)]
    return "\n".join(text) + "\n"


def rows_of(triangles, points):
    for a, b, c in triangles:
        (ax, ay), (bx, by), (cx, cy) = points[a], points[b], points[c]
        if (bx - ax) * (cy - ay) - (cx - ax) * (by - ay) <= 0:
            raise SystemExit("a stretched mesh has a triangle that is turned round")
        yield f"{a + 1} {b + 1} {c + 1}"
