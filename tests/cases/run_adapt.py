#!/usr/bin/env python3
"""The adaptive loop from end to end: the same folder on any number of ranks, and after being killed at any moment and resumed.

    run_adapt.py --quadloop PROGRAM ranks --case CASE.toml [--ranks 1 2 3 5] [--cycles N] [--set KEY=VALUE ...]
    run_adapt.py --quadloop PROGRAM tiny [--ranks 1 3]
    run_adapt.py --quadloop PROGRAM kill [--times 20] [--ranks 1]
"""
import argparse
import os
import random
import signal
import subprocess
import tempfile
import time
from pathlib import Path

from adapt_runs import RING, TINY, adapt, command_of, expect_refusal, files_in, require, require_same_folders, states, tiny_case
from quadloop_runs import run


def check_ranks(program, case, folder, ranks, options):
    """Every file of every cycle."""
    first = folder / f"on_{ranks[0]}"
    for count in ranks:
        made = folder / f"on_{count}"
        adapt(program, case, made, count, options)
        require_same_folders(first, made, f"{count} ranks against {ranks[0]}")
    print(f"{len(files_in(first))} files the same on", ", ".join(map(str, ranks)), "ranks")


def check_other_ranks_go_on(program, case, folder, ranks, cycles, options):
    """A run begun on one number of ranks and resumed on another ends as one that was not broken off."""
    made = folder / "changing"
    for cycle in range(cycles + 1):
        adapt(program, case, made, ranks[(cycle + 1) % len(ranks)], [*options, "--cycles", cycle, "--resume"])
    require_same_folders(folder / f"on_{ranks[0]}", made, "other ranks in each cycle")


# Reads .su2 and, from cycle 1 on, the state beside it; leaves SU2's four variables.
SU2_SOLVER = """import csv, math, sys
from pathlib import Path
mesh, state, solution, cycle = sys.argv[1:5]
lines = Path(mesh).read_text().splitlines()
first = next(i for i, line in enumerate(lines) if line.startswith("NPOIN="))
nodes = [tuple(map(float, line.split()[:2])) for line in lines[first + 1:first + 1 + int(lines[first].split("=")[1])]]
assert Path(state).exists() == (cycle != "0"), state
if cycle != "0":
    header, *rows = csv.reader(Path(state).open())
    assert header == ["PointID", "x", "y", "Density", "Momentum_x", "Momentum_y", "Energy"], header
    assert [(float(row[1]), float(row[2])) for row in rows] == nodes and [int(row[0]) for row in rows] == list(range(len(nodes)))
    assert all(1 <= float(row[3]) <= 2 and abs(float(row[6]) - 2.5) < 1e-12 for row in rows)
with open(solution, "w") as out:
    out.write('"PointID","x","y","Density","Momentum_x","Momentum_y","Energy"\\n')
    for i, (x, y) in enumerate(nodes):
        out.write(f"{i}, {x!r}, {y!r}, {1.5 + 0.5 * math.tanh((math.hypot(x, y) - 0.6) / 0.1)!r}, 0.1, 0, 2.5\\n")
"""


def check_state(program, folder, ranks):
    """A solver that reads .su2 is given the last flow as SU2's restart file, the same on any number of ranks."""
    text = TINY.replace('"{mesh}", "{solution}"]', '"{mesh}", "{state}", "{solution}", "{cycle}"]\nmesh = "flow.su2"\nsolution = "restart_flow.csv"')
    case = tiny_case(folder / "su2", SU2_SOLVER, text.replace('"height"', '"density"'))
    check_ranks(program, case, folder / "su2", ranks, ["--cycles", "2"])
    found = [(folder / "su2" / f"on_{ranks[0]}" / f"cycle_{cycle:02}" / "flow.csv").exists() for cycle in (0, 1, 2)]
    require(found == [False, True, True], f"the state is there in cycles {found}")
    expect_refusal(program, 1, ["solver.solution", "initial state", "flow.su2"], "adapt", case, "-o", folder / "su2" / "never", "--set",
                   "solver.solution=flow.csv")


def check_parts(program, folder, ranks):
    """Parts stand in the cycle's folder while its solver runs, with the starting state, and in the end with the solution: together they are the whole."""
    solver = (RING / "solver.py").read_text().replace("0.01", "0.1")
    solver += "\nfrom pathlib import Path\nPath('first.txt').write_text(Path('mesh.parts').read_text() + Path('mesh.part_0003.mesh').read_text())\n"
    options = ["--cycles", "1", "--set", "output.partitions=3", "--set", 'output.formats=["mesh","vtu"]']
    case = tiny_case(folder / "parts", solver)
    check_ranks(program, case, folder / "parts", ranks, options)
    for cycle in (0, 1):
        made = folder / "parts" / f"on_{ranks[0]}" / f"cycle_{cycle:02}"
        run(command_of(program, 1, "convert", made / "mesh.parts", folder / "back.mesh"))
        require((folder / "back.mesh").read_text() == (made / "mesh.mesh").read_text(), f"the parts of cycle {cycle} are not its mesh")
        require("height" in (made / "mesh.part_0003.mesh").read_text(), "a part has no solution")
        require(("height" in (made / "first.txt").read_text()) == (cycle > 0), f"the state that the solver of cycle {cycle} finds in its part")
        require((made / "mesh.pvtu").exists(), "no list of the pieces")


def kill_session(leader):
    """All at one blow, as when a machine goes down: mpirun gives each rank a process group of its own, but all stay in its session."""
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:
            continue  # ended meanwhile
        if int(fields[3]) == leader:
            try:
                os.kill(int(stat.parent.name), signal.SIGKILL)
            except ProcessLookupError:
                continue


def killed_after(command, seconds):
    """Starts the command and kills it with all that it started after so long; whether it had ended before."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        process.wait(timeout=seconds)
        return True
    except subprocess.TimeoutExpired:
        kill_session(process.pid)
        process.wait()
        return False


def whole_cycles(folder):
    return sorted(path for path in folder.glob("cycle_*") if not path.name.endswith(".part"))


def check_whole(folder, wanted):
    """Cycles that bear their final name are whole and are those of the unbroken run."""
    for cycle in whole_cycles(folder):
        require_same_folders(wanted / cycle.name, cycle, f"{cycle.name} after a kill")


def check_kill(program, case, folder, ranks, times, seed):
    """`times` kills, each at a random moment of what is left of the run; a new run begins where one came to its end. On a machine whose speed varies all
    may come too early: then more follow."""
    wanted, chance = folder / "unbroken", random.Random(seed)
    begin = time.monotonic()
    adapt(program, case, wanted, ranks)
    whole_time = time.monotonic() - begin
    kills = run = 0
    moments = []

    def is_enough():
        return kills >= times and (max(moments) > 0 or kills >= 8 * times)

    while not is_enough():
        run += 1
        made = folder / f"broken_{run}"
        while True:
            kept = {cycle: states(cycle) for cycle in whole_cycles(made)} if made.exists() else {}
            # Early more often than late, so that a run is killed several times before it ends.
            moment = whole_time * (0.1 + 0.9 * chance.random() ** 1.5)
            ended = killed_after(command_of(program, ranks, "adapt", case, "-o", made, "--resume"), moment)
            for cycle, before in kept.items():
                require(states(cycle) == before, f"{cycle} was whole and has been touched")
            if ended:
                break
            kills += 1
            moments.append(len(whole_cycles(made)) if made.exists() else -1)
            if made.exists():
                check_whole(made, wanted)
            if is_enough():
                adapt(program, case, made, ranks, ["--resume"])
                break
        require_same_folders(wanted, made, f"resumed after kills on {ranks} ranks")
    print(f"{kills} kills in {run} runs on {ranks} ranks, after so many whole cycles each:", *moments)
    require(max(moments) > 0, "no kill came after the first cycle: the moments are badly chosen")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("what", choices=("ranks", "tiny", "kill"))
    parser.add_argument("--case", type=Path)
    parser.add_argument("--ranks", type=int, nargs="+", default=[1])
    parser.add_argument("--cycles", type=int, default=2)
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--times", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_adapt_") as name:
        folder = Path(name)
        settings = [word for assignment in args.set for word in ("--set", assignment)]
        if args.what == "ranks":
            check_ranks(args.quadloop, args.case, folder, args.ranks, [*settings, "--cycles", args.cycles])
        elif args.what == "tiny":
            case = tiny_case(folder / "case")
            check_ranks(args.quadloop, case, folder, args.ranks, [*settings, "--cycles", args.cycles])
            check_state(args.quadloop, folder, args.ranks)
            check_parts(args.quadloop, folder, args.ranks)
            check_other_ranks_go_on(args.quadloop, case, folder, args.ranks, args.cycles, settings)
        else:
            check_kill(args.quadloop, tiny_case(folder / "case"), folder, args.ranks[0], args.times, args.seed)
    print("good")


if __name__ == "__main__":
    main()
