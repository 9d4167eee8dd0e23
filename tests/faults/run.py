#!/usr/bin/env python3
"""Runs commands under faults: a disk that is full, a folder that may not be written to, signals and kills at random moments, solvers that fail, and
two runs at once. The tables say what a run does then, and which files it may leave. After each fault the same command must succeed, with the files
of a run without one.

    python3 run.py QUADLOOP MPIRUN FAILING_DISK [SEEDS]

SEEDS: how many random moments for each command and signal; 1.
"""
import contextlib
import filecmp
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field, replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cases"))
from adapt_runs import RING, TINY, files_in, same_file  # noqa: E402
from run_adapt_refusals import SOLVER  # noqa: E402

QUADLOOP, MPIRUN, DISK = (str(Path(program).resolve()) for program in sys.argv[1:4])
SEEDS = int(sys.argv[4]) if len(sys.argv) > 4 else 1
TRIES = 4  # to send a signal before the end of a run
SECONDS = 120  # until a run counts as one that hangs
LOOK_EVERY = 30  # seconds between two looks at whether its ranks live

INPUTS = {
    "box.geom": "2\nbox\n4\n0 0\n4 0\n4 4\n0 4\nhole\n4\n1.5 1.5\n1.5 2.5\n2.5 2.5\n2.5 1.5\n",
    "new.geom": "2\nbox\n4\n0 0\n4 0\n4 4\n0 4\nhole\n4\n1.6 1.5\n1.5 2.5\n2.5 2.5\n2.5 1.5\n",
    "case.toml": """[geometry]
file = "box.geom"
[spacing]
min = 0.125
max = 0.25
[output]
formats = ["mesh", "qmesh", "cgns", "vtu", "pvtu", "vtkhdf", "su2", "msh", "polyMesh"]
[boundary.box]
bc = "farfield"
[boundary.hole]
bc = "wall"
[solver]
mach = 0.3
iterations = 3
[adapt]
cycles = 1
variable = "density"
""",
    "loop.toml": TINY.replace("cycles = 4", "cycles = 1"),
    "square.geom": (RING / "square.geom").read_text(),
    "solver.py": SOLVER,
}


@dataclass
class Command:
    """`arguments` write to the folder `out`; `replaces`: whether they may find older files there."""
    arguments: list
    replaces: bool = True
    ranks: bool = False  # whether it is killed on three ranks too


COMMANDS = {
    "mesh": Command(["mesh", "case.toml", "-o", "out/a", "--geometry-out", "out/a.geom"], ranks=True),
    "parts": Command(["mesh", "case.toml", "-o", "out/a", "--set", "output.partitions=3", 'output.formats=["mesh","pvtu"]'], ranks=True),
    "smooth": Command(["smooth", "m.mesh", "-o", "out/a.vtu"], ranks=True),
    "adapt": Command(["adapt", "loop.toml", "-o", "out/loop", "--resume"], replaces=False, ranks=True),
    "solve": Command(["solve", "case.toml", "m.mesh", "-o", "out/a.vtu"], ranks=True),
    "remesh": Command(["remesh", "case.toml", "--tree", "m.tree.h5", "--solution", "s.mesh", "-o", "out/a"], ranks=True),
    "check": Command(["check", "m.mesh", "--geometry", "box.geom"], replaces=False),
    "plot": Command(["plot", "m.mesh", "-o", "out/a.png"]),
    "convert": Command(["convert", "m.mesh", "out/a.polyMesh"]),
    "extrude": Command(["extrude", "m.mesh", "-o", "out/a.su2", "--layers", "2", "--thickness", "1"]),
    "morph": Command(["morph", "m.mesh", "--geometry", "new.geom", "--from", "box.geom", "-o", "out/a.mesh"]),
}
WRITING = [name for name in COMMANDS if name != "check"]
WRITING_MORE = [name for name in WRITING if name != "plot"]  # it writes a picture in one call


@dataclass
class Fault:
    """What is done to a run, and what it must say: its exit status (None: any but 0 and 70, for runs that are killed), and what its only line of
    error has in it (none: no such line)."""
    name: str
    commands: list
    status: int | None
    says: tuple = ()
    environment: dict = field(default_factory=dict)
    launcher: tuple = ()
    options: tuple = ()
    solver: str = ""  # of SOLVER, what it does wrong
    number: signal.Signals | None = None  # sent at a random moment
    ranks: int = 1


NO_FAULT = Fault("none", [], 0)


def disk(call, first):
    return {"LD_PRELOAD": DISK, "QUADLOOP_DISK_CALL": call, "QUADLOOP_DISK_FULL": str(first)}


def slow_disk(call):
    return {"LD_PRELOAD": DISK, "QUADLOOP_DISK_CALL": call, "QUADLOOP_DISK_DELAY": "20"}


READ_ONLY = ("unshare", "-m", "sh", "-c", 'mount --bind out out && mount -o remount,ro,bind out && exec "$@"', "sh")
FULL = "No space left on device"

FAULTS = [
    *(Fault(f"disk full at {call} {first}", WRITING_MORE if first > 1 else WRITING, 4, ("cannot be written: " + FULL,), disk(call, first))
      for call, first in (("write", 1), ("write", 2), ("close", 1), ("fsync", 1), ("rename", 1))),
    Fault("disk full on 3 ranks", ["mesh", "adapt"], 4, (FULL,), disk("write", 1), ranks=3),
    Fault("read-only folder", WRITING, 4, ("out",), launcher=READ_ONLY),
    *(Fault(f"solver: {fault}", ["adapt"], 3, ("cycle 0", *says), solver=fault)
      for fault, says in (("status", ("exit status 7",)), ("signal", ("signal 11",)), ("nothing", ("without leaving its solution",)),
                          ("rubbish", ("solution.mesh:1",)), ("count", ("the file ends",)), ("nan", ("not finite",)))),
    Fault("solver hangs", ["adapt"], 3, ("cycle 0", "timeout"), solver="timeout", options=("--set", "solver.timeout=2")),
    *(Fault(f"{number.name} at a random moment", list(COMMANDS), -number, number=number) for number in (signal.SIGTERM, signal.SIGINT, signal.SIGKILL)),
    *(Fault(f"{number.name} while the disk is slow to {call}", WRITING, -number, (), slow_disk(call), number=number)
      for number, call in ((signal.SIGTERM, "write"), (signal.SIGINT, "rename"))),
    *(Fault(f"{number.name} to a rank of 3", [name for name in COMMANDS if COMMANDS[name].ranks], None, number=number, ranks=3)
      for number in (signal.SIGKILL, signal.SIGTERM)),
]
UNKNOWN = "unknown"  # the exit status of a run whose launcher hangs
# No line of an error that is not our own.
FOREIGN = re.compile(r"Traceback|terminate called|[Aa]ssert|what\(\)|Segmentation fault \(|internal error|AddressSanitizer|runtime error")
CRASH = re.compile(r"^(\[[^\]\n]*:\d+\]) \*\*\* Process received signal \*\*\*\n(?:\1 .*\n)*?\1 \*\*\* End of error message \*\*\*\n?", re.M)
LAUNCHER_FRAME = re.compile(r"\] (?:\S*/)?(?:mpirun|orterun)\(")


def without_crash_of_launcher(said):
    """`said` without the report of mpirun's own crash: Open MPI 4.1 with PMIx 4.2 may fail in PMIx_server_finalize after a rank was killed.
    A crash of a rank stays: no frame of its report names mpirun."""
    return CRASH.sub(lambda report: "" if LAUNCHER_FRAME.search(report[0]) else report[0], said)


class Trial:
    """A command in a folder of its own, under one fault."""

    def __init__(self, name, fault, inputs, folder, draw):
        self.command, self.fault, self.folder, self.draw = COMMANDS[name], fault, folder, draw
        shutil.copytree(inputs, folder)
        self.out = folder / "out"
        self.out.mkdir()
        (folder / "tmp").mkdir()
        if fault.solver:
            (folder / "fault").write_text(fault.solver)
        self.inputs = set(files_in(folder))

    def start(self, fault):
        mpirun = [MPIRUN, "-n", str(fault.ranks)] if fault.ranks > 1 else []
        environment = dict(os.environ, **fault.environment, TMPDIR=str(self.folder / "tmp"), OMPI_MCA_odls_base_sigkill_timeout="0")
        return subprocess.Popen([*fault.launcher, *mpirun, QUADLOOP, *self.command.arguments, *fault.options, "--quiet"], cwd=self.folder, env=environment,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)

    def ended(self, process):
        """(exit status, stderr)."""
        for _ in range(SECONDS // LOOK_EVERY):
            try:
                said = process.communicate(timeout=LOOK_EVERY)[1]
                return process.returncode, said
            except subprocess.TimeoutExpired:
                if self.fault.ranks > 1 and not ranks_of(process.pid):
                    return self.without_launcher(process)
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return None, "it hangs"

    def without_launcher(self, process):
        """All ranks have ended, but mpirun has not: Open MPI 4.1.4 with PMIx 4.2.2 can wait for a lock of its own in PMIx_server_finalize(). The
        exit status of the ranks is then unknown, and only what they said and left is judged."""
        os.killpg(process.pid, signal.SIGKILL)
        return UNKNOWN, process.communicate()[1]

    def run_under_fault(self, seconds):
        """`seconds`: how long a run without a signal takes."""
        process = self.start(self.fault)
        if self.fault.number is not None:
            time.sleep(self.moment(seconds))
            for victim in self.victims(process):
                with contextlib.suppress(ProcessLookupError):
                    os.kill(victim, self.fault.number)
        return self.ended(process)

    def moment(self, seconds):
        """Late more often than early, when files are written."""
        return seconds * (1 - self.draw.random() ** 2)

    def victims(self, process):
        if self.fault.ranks == 1:
            return [process.pid]
        ranks = ranks_of(process.pid)
        return [self.draw.choice(ranks)] if ranks else []

    def left(self):
        """{name: path} of what stands in the folder of outputs."""
        return files_in(self.out)


def ranks_of(launcher):
    """The living processes of the program in the session of a launcher."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):
            name, _, fields = stat.read_text().partition("(")[2].rpartition(")")
            state, _, _, session = fields.split()[:4]
            if name == "quadloop" and state != "Z" and int(session) == launcher:
                found.append(int(stat.parent.name))
    return sorted(found)


def differences(wanted, found):
    """Of two folders' files: the names that one lacks, or whose contents differ."""
    return [name for name in sorted(wanted.keys() | found.keys())
            if name not in wanted or name not in found or not is_same(name, wanted[name], found[name])]


def is_same(name, one, other):
    if filecmp.cmp(one, other, shallow=False):
        return True
    with contextlib.suppress(OSError, ValueError):  # no HDF5 file, no record
        return same_file(name, one, other)
    return False


def is_temporary(name):
    return ".quadloop" in name or name.endswith(".part")


class Judge:
    """What a trial has left, against the files of a run without a fault."""

    def __init__(self, trial, wanted, older):
        self.trial, self.wanted, self.older = trial, wanted, older

    def faults_of_run(self, status, said):
        fault = self.trial.fault
        ended_before = fault.number is not None and status == 0
        if status is None or status == 70 or (not ended_before and status != UNKNOWN and not self.is_expected(status)):
            yield f"exit status {status}, not {fault.status}: {said!r}"
        errors = [line for line in said.splitlines() if line.startswith("quadloop: error: ")]
        if len(errors) != (1 if fault.says else 0) and fault.ranks == 1:
            yield f"{len(errors)} lines of errors: {said!r}"
        for piece in fault.says:
            if piece not in "".join(errors):
                yield f"'{piece}' is not said: {said!r}"
        if FOREIGN.search(without_crash_of_launcher(said)):
            yield f"foreign words: {said!r}"

    def is_expected(self, status):
        wanted = self.trial.fault.status
        return status != 0 if wanted is None else status == wanted

    def faults_of_files(self, killed):
        """`killed`: SIGKILL may have ended the run at any moment, also between two renames."""
        left = self.trial.left()
        temporaries = [name for name in left if is_temporary(name)]
        if temporaries and not killed:
            yield f"temporaries are left: {temporaries}"
        whole = {name: path for name, path in left.items() if not is_temporary(name)}
        if self.trial.command.arguments[0] == "adapt":
            yield from self.faults_of_cycles(whole)
        elif killed:
            yield from (f"{name} is not whole" for name, path in whole.items() if not self.is_whole(name, path))
        elif whole and not self.is_set(whole):
            yield f"half a set is left: {sorted(whole)}"
        beside = sorted(name for name in files_in(self.trial.folder).keys() - self.trial.inputs if not name.startswith(("out/", "tmp/ompi")))
        if beside:
            yield f"files are left elsewhere: {beside}"

    def is_whole(self, name, path):
        return any(name in files and is_same(name, files[name], path) for files in (self.wanted, self.older))

    def is_set(self, files):
        return not differences(self.wanted, files) or not differences(self.older, files)

    def faults_of_cycles(self, files):
        """Cycles under their own names are whole."""
        names = {name.split("/")[1] for name in files if name.startswith("loop/cycle_") and ".part/" not in name}
        for cycle in names:
            wanted, found = ({name: path for name, path in all_of.items() if name.startswith(f"loop/{cycle}/")} for all_of in (self.wanted, files))
            if differences(wanted, found):
                yield f"{cycle} is not whole: {differences(wanted, found)}"

    def faults_of_repeat(self, status, said):
        if status != 0 or "error" in said:
            yield f"without the fault: exit status {status}: {said!r}"
        if differences(self.wanted, self.trial.left()):
            yield f"without the fault other files: {differences(self.wanted, self.trial.left())}"


class Runs:
    def __init__(self, folder):
        self.folder, self.trials = folder, 0
        self.signals, self.interrupted = 0, 0
        self.inputs, self.draw = folder / "inputs", random.Random(1)
        self.inputs.mkdir()
        for name, text in INPUTS.items():
            (self.inputs / name).write_text(text)
        for arguments in (["mesh", "case.toml", "-o", "m"], ["solve", "case.toml", "m.mesh", "-o", "s.mesh"]):
            subprocess.run([QUADLOOP, *arguments, "--quiet"], cwd=self.inputs, check=True, capture_output=True)
        self.wanted = {}
        for name in COMMANDS:
            trial = self.trial(name, NO_FAULT)
            status, said = trial.ended(trial.start(trial.fault))
            if status != 0:
                sys.exit(f"{name} fails without a fault: {said}")
            self.wanted[name] = trial.left()
        self.seconds = {}

    def trial(self, name, fault):
        self.trials += 1
        return Trial(name, fault, self.inputs, self.folder / f"trial_{self.trials}", self.draw)

    def seconds_of(self, name, fault):
        """How long the command takes on as many ranks and with a disk as slow as under the fault, without its signal."""
        if fault.number is None:
            return None
        key = name, fault.ranks, *fault.environment.items()
        if key not in self.seconds:
            trial = self.trial(name, replace(fault, number=None))
            begin = time.monotonic()
            trial.ended(trial.start(trial.fault))
            self.seconds[key] = time.monotonic() - begin
            shutil.rmtree(trial.folder)
        return self.seconds[key]

    def older_files(self, name, trial):
        """Files of an earlier run, where the command replaces them: other ones of the same names."""
        if not COMMANDS[name].replaces or self.draw.random() < 0.5:
            return {}
        for file in self.wanted[name]:
            path = trial.out / file
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text("of an earlier run")
        older = self.folder / f"older_{self.trials}"
        shutil.copytree(trial.out, older)
        return files_in(older)

    def faults(self, name, fault):
        """What is wrong with one command under one fault. A signal that came after the end of the run is sent again, after half of the time."""
        seconds = self.seconds_of(name, fault)
        self.signals += fault.number is not None
        for _ in range(TRIES):
            status = yield from self.faults_of_trial(name, fault, seconds)
            if fault.number is None:
                return
            if status != 0:
                self.interrupted += 1
                return
            seconds /= 2

    def faults_of_trial(self, name, fault, seconds):
        """What is wrong with one run; returns its exit status."""
        trial = self.trial(name, fault)
        judge = Judge(trial, self.wanted[name], self.older_files(name, trial))
        status, said = trial.run_under_fault(seconds)
        yield from judge.faults_of_run(status, said)
        yield from judge.faults_of_files(killed=fault.number == signal.SIGKILL or fault.ranks > 1)
        (trial.folder / "fault").unlink(missing_ok=True)
        yield from judge.faults_of_repeat(*trial.ended(trial.start(NO_FAULT)))
        shutil.rmtree(trial.folder)
        return status

    def faults_of_two(self, name):
        """Two runs of a command at once: one succeeds, and its files stand; the other one does too, or says why not."""
        trial = self.trial(name, NO_FAULT)
        judge = Judge(trial, self.wanted[name], {})
        ends = [trial.ended(process) for process in [trial.start(trial.fault) for _ in range(2)]]
        if sorted(status for status, _ in ends) not in ([0, 0], [0, 1]) or any(status and "another run is using" not in said for status, said in ends):
            yield f"they end with {ends}"
        yield from judge.faults_of_repeat(0, "")
        yield from judge.faults_of_files(killed=False)


def main():
    failed = 0
    with tempfile.TemporaryDirectory(prefix="quadloop_faults_") as folder:
        runs = Runs(Path(folder))
        rows = [(fault.name, name, lambda fault=fault, name=name: runs.faults(name, fault))
                for fault in FAULTS for name in fault.commands for _ in range(SEEDS if fault.number else 1)]
        rows += [("two runs at once", name, lambda name=name: runs.faults_of_two(name)) for name in WRITING]
        for fault, name, judged in rows:
            begin = time.monotonic()
            found = list(judged())
            for what in found:
                print(f"{name}, {fault}: {what}", flush=True)
            failed += len(found) > 0
            if "-v" in sys.argv:
                print(f"{time.monotonic() - begin:.2f} s  {name}, {fault}", flush=True)
    print(f"{len(rows)} trials, {failed} of them with faults; {runs.interrupted} of {runs.signals} signals came before the end of the run")
    return 1 if failed or 2 * runs.interrupted < runs.signals else 0


if __name__ == "__main__":
    sys.exit(main())
