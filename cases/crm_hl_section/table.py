#!/usr/bin/env python3
"""Prints a table of the cycles of a run: nodes, iterations, residual, lift, drag, its parts and pitching moment, with the differences from the converged values.

    table.py RUN

RUN is the folder of `quadloop adapt`. The converged values are those of NASA's Turbulence Modeling Resource (case 2DMEA, SA-neg): CL 3.8030, CD 0.06053.
"""
import json
import sys
from pathlib import Path

LIFT, DRAG = 3.8030, 0.06053


def last_row(history):
    rows = [[word.strip(' "') for word in line.split(",")] for line in history.read_text().splitlines()]
    return dict(zip(rows[0], rows[-1])), len(rows) - 1


def main():
    print("| cycle | nodes | iterations | residual | CL | CD | CD pressure | CD friction | CM | CL - 3.8030 | CD - 0.06053 |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for cycle in sorted(Path(sys.argv[1]).glob("cycle_[0-9]*")):
        record = json.loads((cycle / "record.json").read_text())
        end, iterations = last_row(cycle / "history.csv")
        lift, drag = record["cl"], record["cd"]
        friction = sum(forces["cd_friction"] for forces in record["forces"].values())
        print(f"| {record['cycle']} | {record['nodes']} | {iterations} | 10^{record['log_residual']:.1f} | {lift:.4f} | {drag:.5f} | {drag - friction:.5f} "
              f"| {friction:.5f} | {float(end['CMz']):.4f} | {100 * (lift / LIFT - 1):+.2f} % | {100 * (drag / DRAG - 1):+.1f} % |")


main()
