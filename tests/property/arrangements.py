"""Random arrangements of outlines, curves, shapes, blocks, inner lines, baffles, layers and periodic pairs, as texts of files. Seeded."""
import math
import random


class Arrangement:
    """The files of one case: {name: text}; what the judges need to know of it."""

    def __init__(self, seed):
        self.chance = random.Random(seed)
        self.type = self.chance.choice(("hybrid", "delaunay"))
        self.files, self.rows, self.tables = {}, [], {}
        self.layers = self.has_lines = self.has_blocks = False
        self.geometry = {}
        self.one_count = None  # boundaries that meet need the same
        scene = self.chance.choice((self.blocks, self.islands, self.periodic, self.curved))
        self.scene = scene.__name__
        scene()
        self.sizes()
        self.files["case.toml"] = self.case_text()

    # Numbers ---------------------------------------------------------------------------------------------------------

    def number(self, low, high):
        """Often on a lattice, so that things touch, coincide and meet grid lines."""
        x = self.chance.uniform(low, high)
        return round(8 * x) / 8 if self.chance.random() < 0.4 else round(x, self.chance.choice((2, 6)))

    def maybe(self, share):
        return self.chance.random() < share

    def star(self, x, y, radius):
        corners = self.chance.randrange(3, 9)
        return [[x + self.chance.uniform(0.35, 1) * radius * math.cos(2 * math.pi * (k + 0.6 * self.chance.random()) / corners),
                 y + self.chance.uniform(0.35, 1) * radius * math.sin(2 * math.pi * (k + 0.6 * self.chance.random()) / corners)]
                for k in range(corners)]

    # Tables ----------------------------------------------------------------------------------------------------------

    def table(self, head, **keys):
        self.rows += ["", f"[[{head}]]", *(f"{key} = {toml(value)}" for key, value in keys.items())]

    def boundary(self, name, **keys):
        self.tables.setdefault(name, {}).update(keys)

    def shape(self, name, x, y, radius, kinds=("circle", "rectangle", "polygon", "naca")):
        kind = self.chance.choice(kinds)
        if kind == "circle":
            self.table("shape", name=name, kind=kind, centre=[x, y], radius=max(radius, 0.05))
        elif kind == "rectangle":
            wide, high = radius * self.chance.uniform(0.4, 1), radius * self.chance.uniform(0.4, 1)
            self.table("shape", name=name, kind=kind, box=[x - wide, x + wide, y - high, y + high],
                       **({"rotate": self.chance.choice((30, 45, -12.5)), "rotate_about": [x, y]} if self.maybe(0.3) else {}))
        elif kind == "polygon":
            self.table("shape", name=name, kind=kind, points=self.star(x, y, radius))
        else:
            flap = {"flap": self.chance.choice((5, 20, -15))} if self.maybe(0.3) else {}
            self.table("shape", name=name, kind=kind, code=self.chance.choice(("0012", "2412", "23012", "0012-64")), sharp=self.maybe(0.5),
                       scale=2 * radius, translate=[x - radius, y], rotate=self.chance.choice((0, -8, 33)), rotate_about=[0, 0], **flap)

    def layers_on(self, name, **more):
        self.layers = True
        if self.one_count is None or self.maybe(0.03):
            self.one_count = self.chance.choice(({"count": 3}, {"count": 8}, {"thickness": 0.06}))
        size = self.one_count
        layers = {"first": self.chance.choice((0.001, 0.004, 0.01)), "growth": self.chance.choice((1.2, 1.4)), **size}
        self.boundary(name, bc="wall", layers=layers, spacing=self.chance.choice((0.03, 0.05, 0.1)), **more)

    def inner_lines(self, low, high, most=3):
        for k in range(self.chance.randrange(1, most + 1)):
            self.has_lines = True
            path = [[self.number(low[0], high[0]), self.number(low[1], high[1])] for _ in range(self.chance.randrange(2, 5))]
            if len(path) > 3 and self.maybe(0.4):
                path.append(path[0])
            baffle = self.maybe(0.3)
            self.table("line", name=f"line{k}", path=path, **({"kind": "baffle"} if baffle else {}))
            if self.maybe(0.4):
                self.boundary(f"line{k}", spacing=self.chance.choice((0.02, 0.05, 0.1)), **({"bc": "wall"} if baffle else {}))

    # Scenes ----------------------------------------------------------------------------------------------------------

    def blocks(self):
        """A rectangle, disc or polygon with shapes that are nested in it, touch, cross, or have common edges; lines over all."""
        self.has_blocks = True
        self.shape("outer", 0, 0, 1, ("circle", "rectangle", "rectangle", "polygon"))
        names = [f"part{k}" for k in range(self.chance.randrange(1, 5))]
        for name in names:
            if self.maybe(0.4):  # edges in common
                x, y = self.chance.choice((-0.5, -0.25, 0, 0.25)), self.chance.choice((-0.5, 0, 0.25))
                self.table("shape", name=name, kind="rectangle", box=[x, x + self.chance.choice((0.25, 0.5)), y, y + 0.25])
            else:
                self.shape(name, self.number(-0.6, 0.6), self.number(-0.6, 0.6), self.chance.uniform(0.1, 0.5))
        self.table("block", name="rest", loop="outer", **({"spacing": 0.2} if self.maybe(0.3) else {}))
        for name in names:
            if self.maybe(0.8):
                self.table("block", name=f"block_{name}", loop=name, **({"spacing": 0.05} if self.maybe(0.3) else {}))
        if self.maybe(0.2):
            self.table("block", name="there", inside=[self.number(-0.4, 0.4), self.number(-0.4, 0.4)])
        for name in names + ["outer"]:
            if self.maybe(0.25):
                self.layers_on(name, **({"layers_in": "rest"} if self.maybe(0.5) else {}))
        if self.maybe(0.4):
            self.inner_lines((-1, -1), (1, 1))

    def islands(self):
        """Bodies in a far field of any form or in a box, some merged; lines and baffles beside and through them."""
        far = self.chance.choice(("square", "rectangle", "c", "circle", "box"))
        if far == "box":
            self.table("shape", name="box", kind="rectangle", box=[-3, 3, -2, 2])
        else:
            self.geometry["far_field"] = {"shape": far, "radius": self.chance.choice((2, 3.7)), **({"spacing": 0.3} if self.maybe(0.5) else {})}
        bodies = self.chance.randrange(1, 4)
        union = self.maybe(0.5)
        apart = 0.6 if union else 1.2
        for k in range(bodies):
            self.shape(f"body{k}", apart * (k - bodies / 2 + 0.5), self.number(-0.3, 0.3), self.chance.uniform(0.2, 0.5))
            if self.maybe(0.5):
                self.layers_on(f"body{k}")
        if union:
            self.geometry["overlap"] = "union"
        elif self.maybe(0.8):
            self.inner_lines((-1.6, -1.2), (1.6, 1.2))

    def wavy(self, ends, waves, height, count):
        """Points of a line between two points that bends to both sides."""
        (x0, y0), (x1, y1) = ends
        nx, ny = y0 - y1, x1 - x0
        return [(x0 + t * (x1 - x0) + height * math.sin(waves * math.pi * t) * nx, y0 + t * (y1 - y0) + height * math.sin(waves * math.pi * t) * ny)
                for t in (k / count for k in range(count + 1))]

    def periodic(self):
        """A passage or a sector with a body, whose sides are pairs; its walls may have layers, which end on the pair."""
        height, waves, count = self.chance.choice((0, 0.05, 0.15)), self.chance.choice((1, 2)), self.chance.choice((1, 6, 20))
        if self.maybe(0.6):
            pitch, length = self.chance.choice((0.7, 1, 1.25)), self.chance.choice((1.5, 2, 2.137))
            low = self.wavy(((0, 0), (length, self.chance.choice((0, 0.3)))), waves, height, count)
            high = [(x, y + pitch) for x, y in low]
            pair = {"translation": [0.0, pitch]}
            ends = [("outlet", [low[-1], high[-1]]), ("inlet", [high[0], low[0]])]
            body = (length / 2, low[count // 2][1] + pitch / 2 if count > 1 else (low[0][1] + low[1][1] + pitch) / 2, pitch / 5)
        else:
            degrees = self.chance.choice((30, 60, 90))
            turn = math.radians(degrees)
            low = self.wavy(((0.5, 0), (1.5, 0)), waves, height, count)
            high = [(x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)) for x, y in low]
            pair = {"rotation": degrees}
            arc = lambda r, a, b: [(r * math.cos(a + (b - a) * k / 12), r * math.sin(a + (b - a) * k / 12)) for k in range(13)]
            outer, inner = arc(1.5, 0, turn), arc(0.5, turn, 0)
            outer[0], outer[-1], inner[0], inner[-1] = low[-1], high[-1], high[0], low[0]
            ends = [("outlet", outer), ("inlet", inner)]
            body = (math.cos(turn / 2), math.sin(turn / 2), 0.15)
        chains = [("low open", low), ("high open", high[::-1]), *((f"{name} open", points) for name, points in ends)]
        self.files["passage.geom"] = geom(chains)
        self.geometry["file"] = "passage.geom"
        if self.maybe(0.6):
            self.geometry["spline"] = True
        self.table("pair", **{"from": "low", "to": "high"}, **pair)
        if self.maybe(0.7):
            self.shape("body", *body)
            if self.maybe(0.6):
                self.layers_on("body")
        for name in ("inlet", "outlet"):
            if self.maybe(0.3):
                self.layers_on(name)

    def curved(self):
        """A plate with an outline of lines, arcs and Bezier curves in open chains, a hole that is a spline, and layers on some chains, which end
        on the others."""
        corners = [(0.0, 0.0), (2.0, self.number(-0.3, 0.3)), (2.0 + self.number(-0.3, 0.3), 1.5), (self.number(-0.3, 0.3), 1.5)]
        names = ["south", "east", "north", "west"]
        rows = []
        for name, a, b in zip(names, corners, corners[1:] + corners[:1]):
            rows += [f"{name} open", "2", bezier(self.chance, a, b), f"{b[0]!r} {b[1]!r}"]
        chains = 4
        if self.maybe(0.6):
            hole = self.star(1, 0.75, 0.3)
            rows += ["hole", str(len(hole)), *(bezier(self.chance, a, b, 0.2) for a, b in zip(hole, hole[1:] + hole[:1]))]
            chains += 1
            names.append("hole")
        self.files["plate.geom"] = f"{chains}\n" + "\n".join(rows) + "\n"
        self.geometry["file"] = "plate.geom"
        for name in names:
            if self.maybe(0.35):
                self.layers_on(name)
        if self.maybe(0.3):
            self.inner_lines((0.2, 0.3), (1.8, 1.2), most=2)

    def sizes(self):
        self.spacing = {"max": self.chance.choice((0.1, 0.15, 0.25))}
        if self.maybe(0.5):
            self.spacing["min"] = self.chance.choice((0.004, 0.01, 0.03))
        if self.maybe(0.4):
            self.spacing["curvature"] = self.chance.choice((8, 15))
        if self.maybe(0.15):
            self.spacing["gap"] = self.chance.choice((2, 3))
        self.mesh = {"type": self.type}
        if self.maybe(0.2):
            self.mesh["quads"] = "parallel"
        if self.maybe(0.2):
            self.mesh["snap"] = self.chance.choice((0, 0.001, 0.3, 0.49))
        if self.maybe(0.2):
            self.table("source", disc=[self.number(-1, 1), self.number(-1, 1), 0.2], spacing=0.04)

    def case_text(self):
        text = "\n".join(self.rows) + "\n"
        tables = {"geometry": self.geometry, "spacing": self.spacing, "mesh": self.mesh, "output": {"formats": ["mesh"]},
                  "smooth": {"sweeps": self.chance.choice((0, 4, 20))}, **{f'boundary."{name}"': keys for name, keys in self.tables.items()}}
        for name, keys in tables.items():
            text += f"\n[{name}]\n" + "".join(f"{key} = {toml(value)}\n" for key, value in keys.items())
        return text


def toml(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return repr(value)


def geom(chains):
    return f"{len(chains)}\n" + "".join(f"{name}\n{len(points)}\n" + "".join(f"{x!r} {y!r}\n" for x, y in points) for name, points in chains)


def bezier(chance, a, b, bend=0.35):
    """The row of a point: a straight line, an arc of a circle or a cubic curve to the next one."""
    x, y = b[0] - a[0], b[1] - a[1]
    row = f"{a[0]!r} {a[1]!r}"
    kind = chance.choice(("line", "arc", "cubic", "cubic"))
    if kind == "line":
        return row
    off = chance.uniform(-bend, bend)
    if kind == "arc":  # whose control polygon turns by 2 atan(2 off)
        middle = (a[0] + x / 2 - off * y, a[1] + y / 2 + off * x)
        return f"{row} curve {middle[0]!r} {middle[1]!r} weights 1 {1 / math.sqrt(1 + 4 * off * off)!r} 1"
    other = chance.uniform(-bend, bend)
    control = [(a[0] + t * x - o * y, a[1] + t * y + o * x) for t, o in ((1 / 3, off), (2 / 3, other))]
    return f"{row} curve " + " ".join(f"{c!r}" for point in control for c in point)
