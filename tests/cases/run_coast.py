#!/usr/bin/env python3
"""Layers along a coast: a valid mesh of the same bytes on any number of ranks, every coast covered by all its layers, and a report that names each with the
place where they are thinnest.

    run_coast.py --quadloop PROGRAM --case FILE [--type delaunay] [--ranks N ...] [--set KEY=VALUE ...]
"""
import argparse
import fnmatch
import json
import sys
import tempfile
import tomllib
from pathlib import Path

from quadloop_runs import ROOT, fail, judge_mesh, mesh_case, run

sys.path.insert(0, str(ROOT / "tests" / "judge"))
from layers import find_layers  # noqa: E402
from mesh_files import read_mesh  # noqa: E402


def patterns_of(case):
    """The boundaries that ask for layers, and how many."""
    tables = tomllib.loads(Path(case).read_text())["boundary"]
    return {pattern: table["layers"]["count"] for pattern, table in tables.items() if "layers" in table}


def require_report(report, coasts, patterns):
    rows = {row["boundary"]: row for row in report["layers"]}
    if set(rows) != coasts:
        fail(f"the report has no layers of {sorted(coasts - set(rows))}")
    for name, row in rows.items():
        count = next(count for pattern, count in patterns.items() if fnmatch.fnmatch(name, pattern))
        if row["count"] != count:
            fail(f"{name}: {row['count']} layers, not {count}")
        if not 0 < row["thickness_share_least"] <= 1 or len(row["least_at"]) != 2:
            fail(f"{name}: the report does not tell where its layers are thinnest")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True)
    parser.add_argument("--type", choices=("hybrid", "delaunay"), default="hybrid")
    parser.add_argument("--ranks", type=int, nargs="*", default=[3])
    parser.add_argument("--set", nargs="*", default=[])
    args = parser.parse_args()
    patterns = patterns_of(args.case)
    with tempfile.TemporaryDirectory(prefix="quadloop_coast_") as folder:
        prefix = Path(folder) / "coast"
        options = ["--type", args.type, *(word for setting in args.set for word in ("--set", setting))]
        report = json.loads(run([args.quadloop, "mesh", args.case, "-o", prefix, "--json", "--geometry-out", f"{prefix}.geom", *options]))
        judge_mesh(prefix)
        run([args.quadloop, "check", f"{prefix}.mesh", "--geometry", f"{prefix}.geom"])
        mesh = read_mesh(f"{prefix}.mesh")
        coasts = {name for name in mesh.boundaries if any(fnmatch.fnmatch(name, pattern) for pattern in patterns)}
        require_report(report, coasts, patterns)
        for count in set(patterns.values()):
            names = tuple(name for name in coasts if any(c == count and fnmatch.fnmatch(name, p) for p, c in patterns.items()))
            layers = find_layers(mesh, names, count)
            if layers.incomplete:
                fail(f"{layers.incomplete} edges of the coasts without all {count} layers")
        for ranks in args.ranks:
            again = Path(folder) / f"on_{ranks}"
            mesh_case(args.quadloop, args.case, again, ranks, options)
            for suffix in ("mesh", "tree.h5"):
                if Path(f"{again}.{suffix}").read_bytes() != Path(f"{prefix}.{suffix}").read_bytes():
                    fail(f"on {ranks} ranks: another .{suffix}")
    print("good")


if __name__ == "__main__":
    main()
