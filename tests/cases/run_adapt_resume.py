#!/usr/bin/env python3
"""What --resume allows and refuses: changed settings, damaged folders, a folder that another run works in. A refusal names the key or the file, comes
before any work and leaves all as it was.

    run_adapt_resume.py --quadloop PROGRAM [--ranks 1]
"""
import argparse
import json
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

from adapt_runs import TINY, adapt, attempt, command_of, expect_refusal, require, require_same_folders, states, tiny_case

SLOW = '''#!/usr/bin/env python3
import time
time.sleep(600)
'''


def check_changed_settings(program, folder, ranks):
    case = tiny_case(folder / "settings")
    made = folder / "of_settings"
    adapt(program, case, made, ranks, ["--cycles", "0"])
    before = states(made)
    for assignment, says in (("adapt.refine=0.6", ["adapt.refine was 0.5, is now 0.6"]), ("spacing.min=0.2", ["spacing.min was 0.25, is now 0.2"]),
                             ("spacing.curvature=9", ["spacing.curvature was not set, is now 9"]),
                             ("solver.cfl=3", ["solver.cfl was not set, is now 3"])):
        expect_refusal(program, 1, ["cycle_00/record.json", *says], "adapt", case, "-o", made, "--resume", "--set", assignment, ranks=ranks)
    outline = case.with_name("square.geom")
    kept = outline.read_text()
    outline.write_text(kept.replace("1 1", "1 1.125"))
    expect_refusal(program, 1, ["cycle_00/record.json", "geometry"], "adapt", case, "-o", made, "--resume", ranks=ranks)
    outline.write_text(kept)
    require(states(made) == before, "a refusal has touched the folder")
    # What says how long, where or how often, and another way to write the same number.
    same = ["solver.timeout=99", "solver.ranks=3", "title=other", "adapt.refine=0.50", "spacing.gradation=1.50"]
    for words in zip(["--set"] * len(same), same):
        status, message = attempt(program, "adapt", case, "-o", made, "--cycles", "0", "--resume", *words, ranks=ranks)
        require(status == 0 and not message, f"{words}: exit status {status}: {message}")
    require(states(made) == before, "a run that was whole has been touched")


def check_mended_command(program, folder, ranks):
    """The solver's arguments may be mended; one line says that the cycles before stay."""
    case = tiny_case(folder / "command")
    made, wanted = folder / "of_command", folder / "of_command_unbroken"
    adapt(program, case, wanted, ranks, ["--cycles", "1"])
    adapt(program, case, made, ranks, ["--cycles", "0"])
    case.write_text(TINY.replace('"python3",', '"python3", "-B",').replace("timeout", "iterations = 7\ntimeout"))
    status, message = attempt(program, "adapt", case, "-o", made, "--cycles", "1", "--resume", ranks=ranks)
    require(status == 0, f"exit status {status}: {message}")
    for part in ("solver.command was [", "solver.iterations was not set, is now 7", "cycle_00 remain"):
        require(part in message, f"no word of '{part}': {message}")
    settings = [json.loads((made / cycle / "record.json").read_text())["case"] for cycle in ("cycle_00", "cycle_01")]
    require(["-B" in of_cycle["solver.command"] for of_cycle in settings] == [False, True], f"records say {settings}")
    require(settings[1]["solver.iterations"] == 7 and settings[1]["adapt.refine"] == 0.5, f"the record says {settings[1]}")
    for name in ("mesh.mesh", "mesh.tree.h5"):
        require((made / "cycle_01" / name).read_bytes() == (wanted / "cycle_01" / name).read_bytes(), f"{name} differs")
    status, message = attempt(program, "adapt", case, "-o", made, "--cycles", "1", "--resume", ranks=ranks)
    require(status == 0 and " was " not in message, f"told again: exit status {status}: {message}")


def check_formats(program, folder, ranks):
    """Each cycle has the formats of [output] too; they may change on the way."""
    case = tiny_case(folder / "formats")
    made = folder / "of_formats"
    adapt(program, case, made, ranks, ["--cycles", "0", "--set", 'output.formats=["vtu", "su2", "csv"]'])
    status, message = attempt(program, "adapt", case, "-o", made, "--cycles", "1", "--resume", ranks=ranks)
    require(status == 0 and 'output.formats was ["vtu", "su2", "csv"], is now not set' in message, f"exit status {status}: {message}")
    found = [sorted(path.suffix for path in (made / cycle).glob("mesh.*")) for cycle in ("cycle_00", "cycle_01")]
    require(found == [[".cgns", ".csv", ".h5", ".mesh", ".su2", ".vtu"], [".cgns", ".h5", ".mesh"]], f"cycles hold {found}")
    require(b'Name="height"' in (made / "cycle_00" / "mesh.vtu").read_bytes(), "the .vtu has no solution")
    require((made / "cycle_00" / "mesh.csv").read_text().startswith('"PointID","x","y","height"\n0,'), "the .csv has no solution")


def check_damage(program, folder, ranks):
    case = tiny_case(folder / "damage")
    whole = folder / "whole"
    adapt(program, case, whole, ranks, ["--cycles", "2"])

    def cut(path):
        data = path.read_bytes()
        path.write_bytes(data[:len(data) // 2])

    def empty(path):
        path.write_bytes(b"")

    for name in ("mesh.mesh", "mesh.tree.h5", "mesh.cgns", "record.json"):
        for harm in (Path.unlink, cut, empty):
            for cycles in ("2", "3"):
                made = folder / "damaged"
                shutil.copytree(whole, made)
                harm(made / "cycle_02" / name)
                before = states(made)
                expect_refusal(program, 1, [f"cycle_02/{name}", f"remove the folder {made}/cycle_02"], "adapt", case, "-o", made, "--resume",
                               "--cycles", cycles, ranks=ranks)
                require(states(made) == before, f"{name}: a refusal has touched the folder")
                shutil.rmtree(made)
    made = folder / "moved"
    shutil.copytree(whole, made)
    lines = (made / "cycle_02" / "mesh.mesh").read_text().splitlines()
    lines[42] = " ".join(repr(float(number) + 1e-9) for number in lines[42].split())
    (made / "cycle_02" / "mesh.mesh").write_text("\n".join(lines) + "\n")
    expect_refusal(program, 1, ["cycle_02/mesh.mesh: its nodes differ in position", "remove the folder"], "adapt", case, "-o", made, "--resume",
                   "--cycles", "3", ranks=ranks)
    made = folder / "gap"
    shutil.copytree(whole, made)
    shutil.rmtree(made / "cycle_01")
    before = states(made)
    expect_refusal(program, 1, ["gap/cycle_01: is missing", "cycle_02"], "adapt", case, "-o", made, "--resume", "--cycles", "2", ranks=ranks)
    require(states(made) == before, "a refusal has touched the folder with a gap")
    shutil.rmtree(made / "cycle_02")  # the cure
    adapt(program, case, made, ranks, ["--resume", "--cycles", "2"])
    require_same_folders(whole, made, "after the cure")


def check_begin_and_end(program, folder, ranks):
    """A resumed run that begins afresh, or has nothing to do, says so; a first cycle that failed is no obstacle."""
    case = tiny_case(folder / "begin")
    made = folder / "of_begin"
    status, message = attempt(program, "adapt", case, "-o", made, "--resume", "--cycles", "1", ranks=ranks)
    require(status == 0 and "contains no complete cycle" in message, f"exit status {status}: {message}")
    printed = adapt(program, case, made, ranks, ["--resume", "--cycles", "1"])
    require("all cycles exist already" in printed and "wrote" not in printed, printed)
    printed = adapt(program, case, made, ranks, ["--resume", "--cycles", "2"])
    require("wrote" in printed and "cycle_02" in printed and "cycle_00" not in printed, printed)
    made = folder / "failed"
    expect_refusal(program, 3, ["exit status 1"], "adapt", case, "-o", made, "--cycles", "0", "--set", 'solver.command=["false"]', ranks=ranks)
    require([path.name for path in made.iterdir()] == ["cycle_00.part"], "the failed cycle is not there to be looked at")
    adapt(program, case, made, ranks, ["--cycles", "0"])
    require([path.name for path in made.iterdir()] == ["cycle_00"], "files are left beside the cycle")


def check_lock(program, folder, ranks):
    """Two runs never work in one folder; the lock is gone with its run."""
    case = tiny_case(folder / "lock", SLOW)
    made = folder / "of_lock"
    first = subprocess.Popen(command_of(program, ranks, "adapt", case, "-o", made, "--cycles", "0"), stdout=subprocess.DEVNULL,
                             stderr=subprocess.DEVNULL)
    try:
        limit = time.monotonic() + 60
        while not (made / "cycle_00.part" / "solver.log").exists() and time.monotonic() < limit:
            time.sleep(0.05)
        before = states(made)
        for options in ([], ["--resume"]):
            expect_refusal(program, 1, ["another run is using", str(made)], "adapt", case, "-o", made, "--cycles", "0", *options, ranks=ranks)
        require(states(made) == before, "a refusal has touched the folder of a live run")
    finally:
        first.terminate()
        first.wait()
    tiny_case(folder / "lock")
    adapt(program, case, made, ranks, ["--cycles", "0"])
    require([path.name for path in made.iterdir()] == ["cycle_00"], "the lock has left a file")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--ranks", type=int, default=1)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_resume_") as name:
        for check in (check_changed_settings, check_mended_command, check_formats, check_damage, check_begin_and_end, check_lock):
            check(args.quadloop, Path(name), args.ranks)
    print("good")


if __name__ == "__main__":
    main()
