"""What the case tests share: running the program, reading native meshes, failing and skipping. Standard library only."""
import hashlib
import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MPIRUN = ROOT / "scripts" / "mpirun"
JUDGE = ROOT / "tests" / "judge" / "judge.py"
SKIPPED = 77


def fail(message):
    print(f"FAILED: {message}")
    sys.exit(1)


def skip(message):
    print(f"SKIPPED: {message}")
    sys.exit(SKIPPED)


def run(command, accept=(0,)):
    """Runs a command to its end and returns what it printed on stdout; any exit status but those accepted fails the test."""
    command = [str(word) for word in command]
    print("+", " ".join(command), flush=True)
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode not in accept:
        print(done.stdout, done.stderr, sep="\n")
        fail(f"exit status {done.returncode}: {' '.join(command)}")
    return done.stdout


def mesh_case(quadloop, case, prefix, ranks=1, options=()):
    """Meshes a case into PREFIX.*; more than one rank runs under mpirun."""
    launcher = [MPIRUN, "-n", str(ranks)] if ranks > 1 else []
    run([*launcher, quadloop, "mesh", case, "-o", prefix, *options])


def judge_mesh(prefix, geometry=None, corners=False, delaunay=False):
    """The tests' own judge looks at PREFIX.mesh, and that PREFIX.cgns holds the same; with an outline, that the boundaries are its."""
    options = ["--geometry", geometry] * (geometry is not None) + ["--corners"] * corners + ["--delaunay"] * delaunay
    run([sys.executable, "-B", JUDGE, f"{prefix}.mesh", "--same", f"{prefix}.cgns", *options])


def beside_the_checkout(variable, relative):
    """A file outside the project that a test can use: named by an environment variable, or in the folder `shared` beside the
    checkout. None where it is absent."""
    path = Path(os.environ[variable]) if variable in os.environ else ROOT.parent / "shared" / relative
    return path if path.exists() else None


def digest(path):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


class NativeMesh:
    """Rows of a .mesh file as written by the program: nodes (x, y), cells (0-based), boundaries {name: [(a, b)]}."""

    def __init__(self, path):
        self.lines_ = Path(path).read_text().splitlines()
        self.at_ = 0
        self.nodes = [tuple(map(float, row)) for row in self.section()]
        self.cells = []
        blocks = int(self.next_row()[0])
        for _ in range(blocks):
            for _kind in ("triangles", "quads"):
                self.cells += [tuple(int(n) - 1 for n in row) for row in self.section()]
        self.boundaries = {}
        for _ in range(int(self.next_row()[0])):
            rows = self.section()
            self.boundaries.setdefault(self.name_, []).extend(tuple(int(n) - 1 for n in row) for row in rows)

    def next_row(self):
        while self.lines_[self.at_].startswith("#"):
            named = re.search(r"\((.*)\)\s*$", self.lines_[self.at_])
            self.name_ = named[1] if named else ""
            self.at_ += 1
        self.at_ += 1
        return self.lines_[self.at_ - 1].split()

    def section(self):
        count = int(self.next_row()[0])
        rows = [line.split() for line in self.lines_[self.at_:self.at_ + count]]
        if len(rows) != count:
            fail("the mesh file ends early")
        self.at_ += count
        return rows

    def triangles(self):
        return sum(1 for cell in self.cells if len(cell) == 3)

    def quads(self):
        return sum(1 for cell in self.cells if len(cell) == 4)

    def area(self):
        def twice(cell):
            points = [self.nodes[n] for n in cell]
            return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(points, points[1:] + points[:1]))
        return sum(map(twice, self.cells)) / 2

    def extent(self):
        xs, ys = zip(*self.nodes)
        return max(max(xs) - min(xs), max(ys) - min(ys))

    def canonical(self):
        """The mesh as sorted coordinates, free of every number: equal for equal meshes, however they are numbered."""
        def cell_of(cell):
            first = min(range(len(cell)), key=lambda i: self.nodes[cell[i]])
            return tuple(self.nodes[n] for n in cell[first:] + cell[:first])
        return (sorted(self.nodes), sorted(map(cell_of, self.cells)),
                {name: sorted((self.nodes[a], self.nodes[b]) for a, b in edges) for name, edges in self.boundaries.items()})

    def mapped(self, point_map, mirrored):
        """A copy under a map of the plane; a mirror turns every cell and edge round."""
        copy = NativeMesh.__new__(NativeMesh)
        copy.nodes = [point_map(*p) for p in self.nodes]
        turn = (lambda ids: ids[::-1]) if mirrored else (lambda ids: ids)
        copy.cells = [turn(cell) for cell in self.cells]
        copy.boundaries = {name: [turn(edge) for edge in edges] for name, edges in self.boundaries.items()}
        return copy
