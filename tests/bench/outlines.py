#!/usr/bin/env python3
"""What a large outline costs each rank: memory and CPU time of `quadloop mesh` for a wavy circle in few cells. Standard library only.

    outlines.py --quadloop PROGRAM [--ranks N ...] [--segments N N] [--update docs/performance.md]

One run each, of two outlines; what grows with the segments follows from their difference. Memory is the largest at any moment, looked at every 20 ms:
RSS counts a shared page in each rank, PSS divides it by the number of ranks that share it.
"""
import argparse
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from figures import add_update, tell
from growth import OUTLINE_CASE, write_outline

ROOT = Path(__file__).resolve().parents[2]


def memory_of(process):
    """(RSS, PSS) in bytes; zeros where the process has ended."""
    try:
        rows = dict(line.split(":") for line in Path(f"/proc/{process}/smaps_rollup").read_text().splitlines()[1:])
        return tuple(1024 * int(rows[name].split()[0]) for name in ("Rss", "Pss"))
    except OSError:
        return 0, 0


def as_rank(folder, *command):
    """One rank: runs the program; notes its CPU time and its largest memory in the folder."""
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    largest = (0, 0)
    while True:
        largest = tuple(map(max, largest, memory_of(child.pid)))
        ended, status, usage = os.wait4(child.pid, os.WNOHANG)
        if ended:
            break
        time.sleep(0.02)
    child.returncode = os.waitstatus_to_exitcode(status)
    note = Path(folder) / f"{int(os.environ.get('OMPI_COMM_WORLD_RANK', '0')):06}.txt"
    note.write_text(f"{usage.ru_utime + usage.ru_stime} {largest[0]} {largest[1]}")
    return child.returncode


def run(quadloop, ranks, folder):
    """Wall seconds, and (CPU seconds, RSS, PSS) of each rank."""
    with tempfile.TemporaryDirectory() as notes:
        program = [ROOT / "scripts" / "mpirun", "-n", ranks, sys.executable, "-B", __file__, "--as-rank", notes, quadloop,
                   "mesh", folder / "case.toml", "-o", folder / "out", "-q"]
        begin = time.monotonic()
        done = subprocess.run([str(word) for word in program], capture_output=True, text=True)
        seconds = time.monotonic() - begin
        if done.returncode != 0:
            sys.exit(done.stderr)
        return seconds, [tuple(map(float, note.read_text().split())) for note in sorted(Path(notes).glob("*.txt"))]


def first_and_others(values, scale, form):
    first, *others = [value * scale for value in values]
    return f"{first:{form}}" + (f", {sum(others) / len(others):{form}}" if others else "")


def main():
    if sys.argv[1:2] == ["--as-rank"]:
        return as_rank(*sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True, type=lambda text: Path(text).resolve())
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2, 8])
    parser.add_argument("--segments", type=int, nargs=2, default=[250_000, 2_000_000])
    add_update(parser)
    args = parser.parse_args()
    measured = {}
    with tempfile.TemporaryDirectory(prefix="quadloop_bench_outlines_") as name:
        folder = Path(name)
        (folder / "case.toml").write_text(OUTLINE_CASE)
        for segments in args.segments:
            write_outline(folder / "outline.geom", segments)
            for ranks in args.ranks:
                measured[segments, ranks] = run(args.quadloop, ranks, folder)
    few, many = args.segments
    rows = []
    for ranks in args.ranks:
        for segments in args.segments:
            seconds, of_ranks = measured[segments, ranks]
            cpu, rss, pss = zip(*of_ranks)
            rows.append(f"| {segments} | {ranks} | {seconds:.1f} | {first_and_others(cpu, 1, '.2f')} | {first_and_others(rss, 2**-20, '.0f')} | "
                        f"{first_and_others(pss, 2**-20, '.0f')} | {sum(pss) / 2**20:.0f} |")
        more = [[b - a for a, b in zip(*columns)] for columns in zip(zip(*measured[few, ranks][1]), zip(*measured[many, ranks][1]))]
        a_segment = 1 / (many - few)
        rows.append(f"| each | {ranks} | | {first_and_others(more[0], 1e6 * a_segment, '.2f')} us | {first_and_others(more[1], a_segment, '.0f')} bytes | "
                    f"{first_and_others(more[2], a_segment, '.0f')} bytes | {sum(more[2]) * a_segment:.0f} bytes |")
    head = ["one run each. Of the first rank, then the mean of the others; the rows \"each\" are the growth for one segment.", "",
            "| segments | ranks | wall s | CPU s | RSS, MiB | PSS, MiB | PSS of all ranks, MiB |", "|---" * 7 + "|"]
    tell("\n".join(head + rows), "outlines.py", args.update)
    return 0


if __name__ == "__main__":
    sys.exit(main())
