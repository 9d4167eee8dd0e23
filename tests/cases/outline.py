"""Geometries as plain values for the metamorphic tests: read, written, mapped. Standard library only."""
import math
from dataclasses import dataclass, replace
from pathlib import Path


@dataclass(frozen=True)
class Entry:
    """A loop, or an open chain, of a .geom file; the domain lies to the left."""
    name: str
    is_open: bool
    points: tuple


def read_outline(path):
    rows = [line.split() for line in Path(path).read_text().splitlines() if line.strip() and not line.startswith("#")]
    entries, at = [], 1
    for _ in range(int(rows[0][0])):
        count = int(rows[at + 1][0])
        points = tuple((float(x), float(y)) for x, y in rows[at + 2:at + 2 + count])
        entries.append(Entry(rows[at][0], len(rows[at]) > 1, points))
        at += 2 + count
    return entries


def write_outline(path, entries):
    lines = [str(len(entries))]
    for entry in entries:
        lines += [entry.name + (" open" if entry.is_open else ""), str(len(entry.points))]
        lines += [f"{x!r} {y!r}" for x, y in entry.points]
    Path(path).write_text("\n".join(lines) + "\n")


def map_outline(entries, point_map, mirrored=False):
    """A mirror image is walked the other way round, so that the domain stays to the left."""
    def mapped(entry):
        points = tuple(point_map(*p) for p in entry.points)
        return replace(entry, points=points[::-1] if mirrored else points)
    return [mapped(entry) for entry in entries]


def split_at_midpoints(entries):
    def split(entry):
        ends = entry.points[1:] if entry.is_open else entry.points[1:] + entry.points[:1]
        pairs = [(a, ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)) for a, b in zip(entry.points, ends)]
        points = tuple(p for pair in pairs for p in pair)
        return replace(entry, points=points + entry.points[-1:] if entry.is_open else points)
    return [split(entry) for entry in entries]


def square(name, x0, y0, edge):
    return Entry(name, False, ((x0, y0), (x0 + edge, y0), (x0 + edge, y0 + edge), (x0, y0 + edge)))


def koch(name, centre, radius, depth):
    """The snowflake, walked clockwise: a hole in the domain."""
    points = [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in (math.pi / 2, -math.pi / 6, -5 * math.pi / 6)]
    for _ in range(depth):
        finer = []
        for (ax, ay), (bx, by) in zip(points, points[1:] + points[:1]):
            dx, dy = (bx - ax) / 3, (by - ay) / 3
            tip = (ax + 1.5 * dx - math.sqrt(3) / 2 * dy, ay + 1.5 * dy + math.sqrt(3) / 2 * dx)
            finer += [(ax, ay), (ax + dx, ay + dy), tip, (ax + 2 * dx, ay + 2 * dy)]
        points = finer
    return Entry(name, False, tuple(points))
