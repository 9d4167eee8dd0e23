#!/usr/bin/env python3
"""What the adaptive loop says where it cannot go on: exit status, message, and earlier cycles that stay as they are; the cause mended, it goes on to
the same end as a run without the fault.

    run_adapt_refusals.py --quadloop PROGRAM [--ranks 1]
"""
import argparse
import json
import tempfile
from pathlib import Path

from adapt_runs import TINY, adapt, attempt, expect_refusal, require, require_same_folders, states, tiny_case

# The file `fault` beside the solver says what it does wrong.
SOLVER = '''#!/usr/bin/env python3
import math, os, signal, sys, time
from pathlib import Path
mesh, solution = sys.argv[1:3]
fault = Path(__file__).with_name("fault")
fault = fault.read_text() if fault.exists() else ""
print("solving with the fault", fault or "none", flush=True)
if fault == "status":
    print("residual is rising, giving up", flush=True)
    sys.exit(7)
if fault == "signal":
    os.kill(os.getpid(), signal.SIGSEGV)
if fault == "timeout":
    time.sleep(600)
if fault == "nothing":
    sys.exit(0)
if fault == "rubbish":
    Path(solution).write_text("all is well\\n")
    sys.exit(0)
lines = Path(mesh).read_text().split("#Number of constants")[0].splitlines()
rows = [i for i, line in enumerate(lines) if not line.startswith("#")]
count = int(lines[rows[0]])
if fault == "moved":
    lines[rows[5]] = "0.001 " + lines[rows[5]].split()[1]
values = [math.tanh((math.hypot(*map(float, lines[i].split())) - 0.6) / 0.1) for i in rows[1:count + 1]]
if fault == "count":
    values.pop()
if fault == "nan":
    values[16] = math.nan
if fault == "cells":
    count -= 1
    lines = ["3", "0 0", "1 0", "0 1", "1", "1", "1 2 3", "0", "0"]
    values = [1, 2, 3]
name = "depth" if fault == "name" else "height"
lines += ["#Number of constants", "0", "#Number of variables", "1", "#names: " + name, *map(repr, values)]
Path(solution).write_text("\\n".join(lines) + "\\n")
'''

# fault: (exit status, what the message says)
FAULTS = {
    "status": (3, ["cycle 1", "exit status 7", "solver.log", "residual is rising, giving up"]),
    "signal": (3, ["cycle 1", "signal 11"]),
    "nothing": (3, ["cycle 1", "without leaving its solution", "solution.mesh"]),
    "rubbish": (3, ["cycle 1", "solution.mesh:1"]),
    "nan": (3, ["cycle 1", "solution.mesh:", "not finite", "height at node 17"]),
    "count": (3, ["cycle 1", "solution.mesh", "the file ends", "node 81"]),
    "cells": (3, ["cycle 1", "another mesh", "3 nodes"]),
    "moved": (3, ["cycle 1", "node 5 ", "another mesh"]),
}


def refused(program, case, made, fault, wanted, ranks, options=()):
    """The second cycle fails; the first stays, and nothing else bears the name of a cycle."""
    status, parts = wanted
    note = case.with_name("fault")
    adapt(program, case, made, ranks, [*options, "--cycles", "0"])
    before = states(made / "cycle_00")
    note.write_text(fault)
    expect_refusal(program, status, parts, "adapt", case, "-o", made, "--cycles", "1", "--resume", *options, ranks=ranks)
    note.unlink()
    require(states(made / "cycle_00") == before, f"{fault}: cycle_00 has been touched")
    require(not (made / "cycle_01").exists(), f"{fault}: a broken cycle passes for whole")


def check_faults(program, folder, ranks):
    case = tiny_case(folder / "case", SOLVER)
    unbroken = folder / "unbroken"
    adapt(program, case, unbroken, ranks, ["--cycles", "1"])
    for fault, wanted in FAULTS.items():
        made = folder / fault
        refused(program, case, made, fault, wanted, ranks)
        adapt(program, case, made, ranks, ["--cycles", "1", "--resume"])
        require_same_folders(unbroken, made, f"mended after {fault}")
    refused(program, case, folder / "late", "timeout", (3, ["cycle 1", "3 s", "timeout"]), ranks, ["--set", "solver.timeout=3"])
    case.with_name("fault").write_text("name")
    expect_refusal(program, 1, ["cycle_00.part/mesh.mesh: adapt.variable", "height", "depth"], "adapt", case, "-o", folder / "name", ranks=ranks)
    case.with_name("fault").unlink()
    expect_refusal(program, 1, ["cycle_00.part/mesh.mesh", "height", "node "], "adapt", case, "-o", folder / "negative", "--set",
                   'adapt.variable={ size = "height" }', ranks=ranks)


def check_folders(program, folder, ranks):
    case = tiny_case(folder / "folders")
    made = folder / "of_folders"
    adapt(program, case, made, ranks, ["--cycles", "1"])
    before = states(made)
    expect_refusal(program, 1, ["not empty", "resume the run in it"], "adapt", case, "-o", made, ranks=ranks)
    require(states(made) == before, "a refusal has touched the folder")
    a_file = folder / "a_file"
    a_file.write_text("")
    for options in ([], ["--resume"]):
        expect_refusal(program, 1, ["a_file", "is a file"], "adapt", case, "-o", a_file, *options, ranks=ranks)
    require(a_file.read_text() == "", "the file that was no folder has been touched")


def check_case_files(program, folder, ranks):
    case = tiny_case(folder / "cases")
    made = folder / "of_cases"

    def expect(parts, old, new):
        case.write_text(TINY.replace(old, new))
        expect_refusal(program, 1, parts, "adapt", case, "-o", made, ranks=ranks)
        require(not made.exists(), "a refused case has left a folder")

    expect(["[adapt]"], TINY[TINY.index("[adapt]"):TINY.index("[solver]")], "")
    expect(["case.toml:19", "machine"], "timeout = 100", "machine = 2.0")
    expect(["case.toml:", "command"], TINY[TINY.index("command ="):TINY.index("timeout")], "")
    expect(["case.toml:", "threshold", "max_nodes"], '"deviation"', '"nodes"')
    expect(["case.toml:", "min"], "min = 0.03", "min = 0")
    for line, parts in (('mesh = "mesh.xyz"', ["solver.mesh", ".su2"]), ('solution = "s.txt"', ["solver.solution", ".csv"]),
                        ('solution = "mesh.mesh"', ["solver.solution", "another name"]),
                        ('mesh = "a.mesh"\nsolution = "a.mesh"', ["solver.solution", "another name"])):
        expect(["case.toml:", *parts], "timeout = 100", line)


def check_programs(program, folder, ranks):
    """Solvers that cannot be started at all."""
    case = tiny_case(folder / "programs")
    script = case.with_name("no_script")
    script.write_text("nothing to run\n")
    script.chmod(0o755)
    for number, (name, status, parts) in enumerate([("no_such_solver", 1, ["no_such_solver", "PATH"]), ("{case}/gone", 1, ["gone"]),
                                                    ("{case}/square.geom", 1, ["may not be run", "chmod"]),
                                                    ("{case}/no_script", 3, ["cannot be started"]), ("{case", 1, ["{case"]),
                                                    ("python3 {case}/solver.py", 1, ["command is a list", '"python3", '])]):
        case.write_text(TINY.replace('"python3", ', f'"{name}", '))
        made = folder / f"program_{number}"
        expect_refusal(program, status, parts, "adapt", case, "-o", made, ranks=ranks)
        require(not (made / "cycle_00").exists(), "a cycle without a solution passes for whole")


def check_small_cap(program, folder, ranks):
    case = tiny_case(folder / "cap")
    status, message = attempt(program, "adapt", case, "-o", folder / "capped", "--cycles", "1", "--set", "adapt.max_nodes=20", ranks=ranks)
    require(status == 0, f"exit status {status} for a cap below the case's own nodes: {message}")
    log = (folder / "capped" / "cycle_00" / "log.txt").read_text()
    require("adapt.max_nodes" in log, f"the log does not warn that the cap is too small: {log}")
    require("adapt.max_nodes" in message, f"no warning on stderr that the cap is too small: {message}")


def check_standing(program, folder, ranks):
    """A cycle that changes nothing says why, once, and ends the run: its mesh is not solved on again, by --resume neither."""
    for name, words, parts in (("constant", ["adapt.variable=flat"], ["flat is constant"]), ("min", ["adapt.min=0.6"], ["adapt.min = 0.6", "edges up to 0.5; set a smaller adapt.min"]),
                               ("room", ["adapt.max_nodes=25"], ["adapt.max_nodes = 25 is reached"]),
                               ("threshold", ["adapt.refine=90", "adapt.coarsen=90"], ["above the threshold adapt.refine"])):
        solver = SOLVER.replace('"1", "#names: " + name, *map(repr, values)', '"2", "#names: height flat", *(f"{value!r} 1" for value in values)')
        case = tiny_case(folder / "standing" / name, solver)
        settings = [word for assignment in words for word in ("--set", assignment)]
        made = folder / "standing" / name / "made"
        status, message = attempt(program, "adapt", case, "-o", made, "--cycles", "2", *settings, ranks=ranks)
        require(status == 0, f"exit status {status}: {message}")
        for part in ("after cycle 0: no cell is refined or coarsened, because", *parts):
            require(message.count(part) == 1, f"the message does not say '{part}' once: {message}")
            require(part in (made / "cycle_00" / "log.txt").read_text(), f"the log does not say '{part}'")
        require([path.name for path in made.iterdir()] == ["cycle_00"], f"the same mesh is solved on again: {sorted(made.iterdir())}")
        record = json.loads((made / "cycle_00" / "record.json").read_text())
        require((record["refined"], record["coarsened"]) == (0, 0), f"the record says {record}")
        before = states(made)
        printed = adapt(program, case, made, ranks, ["--cycles", "3", "--resume", *settings])
        for part in ("after cycle 0 no cell is refined or coarsened", "all cycles exist already", "cycle_00 to cycle_00"):
            require(part in printed, f"--resume does not say '{part}': {printed}")
        require(states(made) == before, "--resume has touched a run that was at its end")
        status, message = attempt(program, "adapt", case, "-o", made.with_name("single"), "--cycles", "0", *settings, ranks=ranks)
        require(status == 0 and "no cell is" not in message, f"a run without adaptation warns about the adaptation: {message}")
    adapt(program, tiny_case(folder / "moving"), folder / "of_moving", ranks, ["--cycles", "0"])
    require("no cell is" not in (folder / "of_moving" / "cycle_00" / "log.txt").read_text(), "a cycle with marks is said to have none")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--ranks", type=int, default=1)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_refusals_") as name:
        for check in (check_faults, check_folders, check_case_files, check_programs, check_small_cap, check_standing):
            check(args.quadloop, Path(name), args.ranks)
    print("good")


if __name__ == "__main__":
    main()
