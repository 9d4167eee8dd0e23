#!/usr/bin/env python3
"""Judges a mesh by the rules that every mesh obeys; independent of the program: its own readers (mesh_files.py), its own predicates (exact.py).

    judge.py MESH [--delaunay] [--geometry OUTLINE.geom [--corners]] [--area A] [--same OTHER] [--json]

Native and CGNS. Exit status 0: no rule is broken; 1: some are, listed; 2: not readable.

--delaunay  triangles alone, every edge inside locally Delaunay       --geometry  the names are the outline's, their nodes lie on it
--corners   each sharp corner of the outline is a node                --same      OTHER holds the same nodes, cells and boundaries, number for number
"""
import argparse
import json
import sys
from dataclasses import dataclass

import numpy as np

import exact
import outline
import overlap
from mesh_files import Unreadable, read_geometry, read_mesh

MOST_NAMED = 5  # faults of a rule that are named one by one
AREA_TOLERANCE = 1e-12


@dataclass
class Fault:
    rule: str
    what: str


def named(rule, whats):
    """A fault for each, the first few of them."""
    whats = list(whats)
    rest = [Fault(rule, f"and {len(whats) - MOST_NAMED} more")] if len(whats) > MOST_NAMED else []
    return [Fault(rule, what) for what in whats[:MOST_NAMED]] + rest


def at(mesh, node):
    return f"node {node + 1} ({mesh.points[node][0]!r}, {mesh.points[node][1]!r})"


def by_rule(pairs):
    """The same for (rule, what) of several rules."""
    rules = {}
    for rule, what in pairs:
        rules.setdefault(rule, []).append(what)
    return [fault for rule, whats in rules.items() for fault in named(rule, whats)]


def check_nodes(mesh):
    bad = np.flatnonzero(~np.isfinite(mesh.points).all(axis=1))
    if len(bad):
        return named("finite coordinates", (f"node {n + 1}" for n in bad))
    order = np.lexsort(mesh.points.T)
    twins = order[1:][(mesh.points[order[1:]] == mesh.points[order[:-1]]).all(axis=1)]
    faults = named("no two nodes at one place", (at(mesh, n) for n in twins))
    used = np.zeros(len(mesh.points), dtype=bool)
    for cells in mesh.kinds():
        used[cells] = True
    return faults + named("every node is a cell's", (at(mesh, n) for n in np.flatnonzero(~used)))


def check_cells(mesh):
    faults = [] if any(map(len, mesh.kinds())) else [Fault("a mesh has cells", "there are none")]
    for cells in mesh.kinds():
        ordered = np.sort(cells, axis=1)
        repeated = np.flatnonzero((ordered[:, 1:] == ordered[:, :-1]).any(axis=1))
        faults += named("a cell's nodes differ", (f"cell {tuple(cells[i] + 1)}" for i in repeated))
        sets, counts = np.unique(ordered, axis=0, return_counts=True)
        faults += named("no cell twice", (f"cell of nodes {tuple(s + 1)}" for s in sets[counts > 1]))
    return faults


def check_orientation(mesh):
    """Every corner turns left, exactly and in the doubles of any reader: triangles have positive areas, quads are strictly convex besides."""
    faults = []
    for cells in mesh.kinds():
        flat = np.zeros(len(cells), dtype=bool)
        width = cells.shape[1]
        for k in range(width):
            a, b, c = (mesh.points[cells[:, (k + i) % width]] for i in (-1, 0, 1))
            u, v = b - a, c - b
            flat |= (exact.orientations(a, b, c) <= 0) | (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0] <= 0)
        faults += named("cells run counter-clockwise and are convex", (f"cell {tuple(cells[i] + 1)}" for i in np.flatnonzero(flat)))
    return faults


class Edges:
    """The cells' edges in the sense of the cells, and the boundaries', each as one number from * N + to."""

    def __init__(self, mesh):
        self.n = len(mesh.points)
        pairs = [np.column_stack([c[:, k], c[:, (k + 1) % c.shape[1]]]) for c in mesh.kinds() for k in range(c.shape[1])]
        self.cells, first, self.uses = np.unique(self.number(np.concatenate(pairs)), return_index=True, return_counts=True)
        triangles = len(mesh.triangles)
        blocks = [mesh.block_of()[:triangles]] * 3 + [mesh.block_of()[triangles:]] * 4
        self.blocks = np.concatenate(blocks)[first]
        self.boundary = self.number(np.concatenate([np.empty((0, 2), dtype=np.int64), *mesh.boundaries.values()]))

    def number(self, pairs):
        return pairs[:, 0] * self.n + pairs[:, 1]

    def turned(self, numbers):
        return numbers % self.n * self.n + numbers // self.n

    def blocks_beside(self, numbers):
        """The blocks of the cells left and right of edges; -1: no cell."""
        def left_of(wanted):
            at = np.minimum(np.searchsorted(self.cells, wanted), len(self.cells) - 1)
            return np.where(self.cells[at] == wanted, self.blocks[at], -1)
        return left_of(numbers), left_of(self.turned(numbers))

    def text(self, number):
        return f"edge {number // self.n + 1} {number % self.n + 1}"


def outer_edges(mesh):
    """The boundary edges that bound one cell."""
    edges = Edges(mesh)
    outer = edges.boundary[edges.blocks_beside(edges.boundary)[1] < 0]
    return np.column_stack([outer // edges.n, outer % edges.n])


def hanging_nodes(mesh, edges, numbers):
    """The nodes that lie inside the edges."""
    for number in numbers[:1000]:
        a, b = mesh.points[number // edges.n], mesh.points[number % edges.n]
        near = np.flatnonzero(((mesh.points >= np.minimum(a, b)) & (mesh.points <= np.maximum(a, b))).all(axis=1))
        near = near[(near != number // edges.n) & (near != number % edges.n)]
        same = np.ones((len(near), 1))
        for node in near[exact.orientations(same * a, same * b, mesh.points[near]) == 0]:
            yield f"{at(mesh, node)} lies on {edges.text(number)}"


def check_edges(mesh):
    """Every edge is that of two cells, which run along it in opposite senses, or of one cell and, in the cell's sense, of one boundary; that
    of cells of two blocks is also a boundary's, once, in the sense of the first block's cell."""
    edges = Edges(mesh)
    text = edges.text
    faults = named("two cells lie on two sides of an edge", map(text, edges.cells[edges.uses > 1]))
    paired = np.isin(edges.turned(edges.cells), edges.cells)
    open_edges = edges.cells[~paired & ~np.isin(edges.cells, edges.boundary)]
    wrong_way = np.isin(edges.turned(open_edges), edges.boundary)
    faults += named("boundaries have the domain to their left", map(text, edges.turned(open_edges[wrong_way])))
    faults += named("an edge of one cell is a boundary's", map(text, open_edges[~wrong_way]))
    faults += named("no hanging nodes", hanging_nodes(mesh, edges, open_edges[~wrong_way]))
    numbers, counts = np.unique(edges.boundary, return_counts=True)
    faults += named("no boundary edge twice", map(text, numbers[counts > 1]))
    forward, backward = np.isin(numbers, edges.cells), np.isin(edges.turned(numbers), edges.cells)
    faults += named("boundary edges are edges of cells", map(text, numbers[~forward & ~backward]))
    left, right = edges.blocks_beside(numbers)
    faults += named("boundary edges bound one cell", map(text, numbers[forward & backward & (left == right)]))
    faults += named("the first of two blocks is left of its edge", map(text, numbers[forward & backward & (left > right)]))
    left, right = edges.blocks_beside(edges.cells)
    unnamed = edges.cells[(right >= 0) & (left < right) & ~np.isin(edges.cells, edges.boundary)]
    return faults + named("an edge between two blocks is a boundary's", map(text, unnamed))


def check_loops(mesh):
    """As many boundary edges, of those that bound one cell, come to a node as leave it: they make up closed loops."""
    balance = np.zeros(len(mesh.points), dtype=np.int64)
    outer = outer_edges(mesh)
    np.add.at(balance, outer[:, 0], 1)
    np.add.at(balance, outer[:, 1], -1)
    faults = [Fault("boundaries have edges", f"'{name}' has none") for name, boundary in mesh.boundaries.items() if len(boundary) == 0]
    return faults + named("boundaries are closed loops", (at(mesh, n) for n in np.flatnonzero(balance)))


def check_delaunay(mesh):
    if len(mesh.quads):
        return [Fault("triangles alone", f"{len(mesh.quads)} quads")]
    n, t = len(mesh.points), mesh.triangles
    numbers = np.concatenate([t[:, k] * n + t[:, (k + 1) % 3] for k in range(3)])
    opposite = np.concatenate([t[:, (k + 2) % 3] for k in range(3)])
    order = np.argsort(numbers)
    turned = numbers % n * n + numbers // n
    partner = np.minimum(np.searchsorted(numbers[order], turned), len(numbers) - 1)
    inner = (numbers[order[partner]] == turned) & (numbers < turned)
    named_edges = Edges(mesh).boundary  # those between two blocks stay as they are
    inner &= ~np.isin(numbers, named_edges) & ~np.isin(turned, named_edges)
    p = mesh.points
    a, b, c, d = p[numbers[inner] // n], p[numbers[inner] % n], p[opposite[inner]], p[opposite[order[partner[inner]]]]
    return named("edges are locally Delaunay", (f"edge {e // n + 1} {e % n + 1}" for e in numbers[inner][exact.in_circles(a, b, c, d) > 0]))


def check_overlap(mesh):
    return by_rule(overlap.check(mesh, outer_edges(mesh)))


def areas_of(mesh):
    """The area of each cell, triangles first."""
    areas = []
    for cells in mesh.kinds():
        x, y = mesh.points[cells, 0], mesh.points[cells, 1]
        x, y = x - x[:, :1], y - y[:, :1]
        areas.append((x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum(axis=1) / 2)
    return np.concatenate(areas)


def area_of(mesh):
    return float(areas_of(mesh).sum())


def areas_of_blocks(mesh):
    """{name: area}"""
    areas = areas_of(mesh)
    return {name: float(areas[mesh.block_of() == block].sum()) for block, name in enumerate(mesh.blocks)}


def check_blocks(mesh, geometry):
    edges = Edges(mesh)
    return by_rule(outline.check_blocks(mesh, geometry, areas_of_blocks(mesh), lambda pairs: edges.blocks_beside(edges.number(pairs))))


def check_area(mesh, expected):
    found = area_of(mesh)
    return [] if abs(found - expected) <= AREA_TOLERANCE * abs(expected) else [Fault("area", f"{found!r}, not {expected!r}")]


def judge(mesh, delaunay=False, geometry=None, corners=False, area=None):
    """All faults; the later rules are looked at only where the earlier ones, on which they stand, are kept."""
    for rules in ((check_nodes,), (check_cells, check_orientation, check_edges, check_loops), (check_overlap,)):
        faults = [fault for rule in rules for fault in rule(mesh)]
        if faults:
            return faults
    faults = check_delaunay(mesh) if delaunay else []
    if area is not None:
        faults += check_area(mesh, area)
    if geometry is not None:
        faults += by_rule(outline.check(mesh, geometry, corners))
        if len(mesh.blocks) > 1 and not faults:
            faults += check_blocks(mesh, geometry)
    return faults


def differences(mesh, other):
    """What differs between two files of one mesh, number for number."""
    parts = {"nodes": (mesh.points, other.points), "triangles": (mesh.triangles, other.triangles), "quads": (mesh.quads, other.quads),
             "blocks": (np.array(mesh.blocks), np.array(other.blocks)), "blocks of cells": (mesh.block_of(), other.block_of())}
    for name in sorted({*mesh.boundaries, *other.boundaries}):
        parts[f"boundary '{name}'"] = (mesh.boundaries.get(name), other.boundaries.get(name))
    return [Fault("same mesh", what) for what, (a, b) in parts.items() if a is None or b is None or not np.array_equal(a, b)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh")
    parser.add_argument("--delaunay", action="store_true")
    parser.add_argument("--geometry")
    parser.add_argument("--corners", action="store_true")
    parser.add_argument("--area", type=float)
    parser.add_argument("--same")
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    try:
        mesh = read_mesh(args.mesh)
        geometry = read_geometry(args.geometry) if args.geometry else None
        faults = judge(mesh, args.delaunay, geometry, args.corners, args.area)
        if args.same:
            faults += differences(mesh, read_mesh(args.same))
    except Unreadable as unreadable:
        print(f"judge: {unreadable}", file=sys.stderr)
        return 2
    said = {"valid": not faults, "nodes": len(mesh.points), "triangles": len(mesh.triangles), "quads": len(mesh.quads), "area": area_of(mesh),
            "blocks": areas_of_blocks(mesh), "boundaries": len(mesh.boundaries), "faults": [[f.rule, f.what] for f in faults]}
    print(json.dumps(said) if args.json else "\n".join(f"{key}: {value}" for key, value in said.items()))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
