#!/usr/bin/env python3
"""SIGUSR1: `quadloop adapt` finishes the cycle under way and ends, with a status of its own; --resume then comes to the files of an unbroken run. The
signal goes to the only process, to mpirun, which passes it on, or to any one rank.

    run_adapt_signal.py --quadloop PROGRAM [--ranks 1]
"""
import argparse
import json
import os
import signal
import subprocess
import tempfile
import time
from pathlib import Path

from adapt_runs import RING, adapt, attempt, command_of, require, require_same_folders, tiny_case

STOPPED = 75
# In cycle 1 it says that it is there, and waits until the signal has been sent.
WAITING = """
import pathlib, time
here = pathlib.Path(".").resolve()
if here.name.startswith("cycle_01"):
    (here.parents[1] / "solving").touch()
    while not (here.parents[1] / "sent").exists():
        time.sleep(0.01)
"""


def ranks_below(parent):
    """The processes `quadloop` that mpirun has started, in the order of their ranks."""
    found = {}
    for status in Path("/proc").glob("[0-9]*/environ"):
        try:
            variables = dict(entry.split("=", 1) for entry in status.read_text(errors="replace").split("\0") if "=" in entry)
            name = (status.parent / "comm").read_text().strip()
        except OSError:
            continue  # another user's, or ended meanwhile
        if variables.get("QUADLOOP_TEST_RUN") == parent and "OMPI_COMM_WORLD_RANK" in variables and name == "quadloop":
            found[int(variables["OMPI_COMM_WORLD_RANK"])] = int(status.parent.name)
    return [found[rank] for rank in sorted(found)]


def stopped_run(program, case, made, ranks, to_rank=None, number=signal.SIGUSR1):
    """Sends the signal while cycle 1 is solved: (exit status, stdout, stderr)."""
    for name in ("solving", "sent"):
        (made.parent / name).unlink(missing_ok=True)
    command = command_of(program, ranks, "adapt", case, "-o", made, "--json")
    print("+", " ".join(command), f"  # SIGUSR1 to {'the process' if to_rank is None else f'rank {to_rank}'}", flush=True)
    variables = dict(os.environ, QUADLOOP_TEST_RUN=f"{os.getpid()} {made.name}")
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=variables) as run:
        while not (made.parent / "solving").exists() and run.poll() is None:
            time.sleep(0.01)
        targets = [run.pid] if to_rank is None else [ranks_below(variables["QUADLOOP_TEST_RUN"])[to_rank]]
        for target in targets:
            os.kill(target, number)
        time.sleep(0.5)  # for mpirun to pass it on
        (made.parent / "sent").touch()
        out, said = run.communicate(timeout=100)
    return run.returncode, out, said


def check_stop(program, case, wanted, made, ranks, to_rank):
    status, out, said = stopped_run(program, case, made, ranks, to_rank)
    require(status == STOPPED, f"exit status {status}: {said}")
    lines = [line for line in said.splitlines() if line.startswith("quadloop: stopped: ")]
    require(len(lines) == 1 and "ended after cycle_01 by SIGUSR1; continue with --resume" in lines[0], f"said: {said}")
    require("quadloop: error" not in said, f"said: {said}")
    record = json.loads(out)
    require(record["status"] == STOPPED and record["stopped"] is True and len(record["cycles"]) == 2, f"the record: {out}")
    require(sorted(path.name for path in made.iterdir()) == ["cycle_00", "cycle_01"], f"left: {sorted(made.iterdir())}")
    adapt(program, case, made, ranks, ["--resume"])
    require_same_folders(wanted, made, f"resumed after a signal, {ranks} ranks")


def check_last_cycle(program, case, wanted, folder, ranks):
    """Where no cycle is left, the run has come to its end in any case."""
    made = folder / "last"
    status, out, said = stopped_run(program, case.with_name("one.toml"), made, ranks)
    require(status == 0 and json.loads(out)["stopped"] is False, f"exit status {status}: {said}")
    require(sorted(path.name for path in made.iterdir()) == ["cycle_00", "cycle_01"], "not all cycles are there")
    status, said = attempt(program, "adapt", case, "-o", made, "--resume", ranks=ranks)
    require(status == 0, f"exit status {status}: {said}")
    require_same_folders(wanted, made, "resumed after the last cycle")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--ranks", type=int, default=1)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        case = tiny_case(folder / "case", (RING / "solver.py").read_text().replace("0.01", "0.1") + WAITING)
        text = case.read_text()
        case.write_text(text.replace("cycles = 4", "cycles = 2"))
        case.with_name("one.toml").write_text(text.replace("cycles = 4", "cycles = 1"))
        (folder / "sent").touch()
        adapt(args.quadloop, case, folder / "unbroken", 1)
        targets = [None] if args.ranks == 1 else [None, 0, args.ranks - 1]
        for number, to_rank in enumerate(targets):
            check_stop(args.quadloop, case, folder / "unbroken", folder / f"stopped_{number}", args.ranks, to_rank)
        check_last_cycle(args.quadloop, case, folder / "unbroken", folder, args.ranks)
    print("ok")


if __name__ == "__main__":
    main()
