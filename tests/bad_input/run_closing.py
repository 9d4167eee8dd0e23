"""An error on any set of ranks ends all of them, with its status and one line on stderr.

    python3 run_closing.py PROBE MPIRUN
"""

import subprocess
import sys

RUNS = [  # others, ranks that fail
    ("go-on", []),
    ("go-on", [0, 1, 2]),
    ("go-on", [1]),
    ("go-on", [1, 2]),
    ("wait", [0]),
    ("wait", [1]),
    ("wait", [1, 2]),
]


def main():
    probe, mpirun = sys.argv[1:3]
    failed = 0
    for others, ranks in RUNS:
        command = [mpirun, "-n", "3", probe, others] + [str(rank) for rank in ranks]
        result = subprocess.run(command, capture_output=True, text=True, timeout=60)
        lines = [line for line in result.stderr.splitlines() if line.startswith("quadloop: error:")]
        expected = [f"quadloop: error: rank {ranks[0]} failed"] if ranks else []
        if result.returncode != (4 if ranks else 0) or lines != expected:
            print(f"{others} {ranks}: exit status {result.returncode}, {lines}")
            failed += 1
    print(f"{len(RUNS)} runs, {failed} faults")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
