#!/usr/bin/env python3
"""Files that come out: all of a run or none, whatever else happens: other runs, full disks, signals. And what is no file that could go in.

    files_test.py QUADLOOP MPIRUN FAILING_DISK
"""
import fcntl
import os
import resource
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

from program import MPIRUN, QUADLOOP, ProgramTest

DISK = str(Path(sys.argv[3]).resolve())
SQUARE = "1\nbox\n4\n0 0\n4 0\n4 4\n0 4\n"
CASE = """[geometry]
file = "box.geom"
[spacing]
min = 0.25
max = 0.5
[smooth]
sweeps = 0
[output]
formats = ["mesh", "qmesh", "cgns", "vtu", "vtkhdf", "su2", "msh"]
[boundary.box]
bc = "farfield"
[solver]
mach = 0.3
iterations = 2
initial = "vortex"
[adapt]
cycles = 1
"""
SUFFIXES = [".mesh", ".qmesh", ".cgns", ".vtu", ".vtkhdf", ".su2", ".msh", ".tree.h5"]
NO_SPACE = "cannot be written: No space left on device; free some space or name an output elsewhere"
LONG = "x" * 250
SECONDS = 60


def disk(call, full=0, delay=0):
    """The environment of a disk that fails or is slow; see failing_disk.cpp."""
    return dict(os.environ, LD_PRELOAD=DISK, QUADLOOP_DISK_CALL=call, QUADLOOP_DISK_FULL=str(full), QUADLOOP_DISK_DELAY=str(delay),
                ASAN_OPTIONS=os.environ.get("ASAN_OPTIONS", "") + ":verify_asan_link_order=0")


class FilesTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("box.geom", SQUARE)
        self.write("case.toml", CASE)
        self.out = self.folder / "out"
        self.out.mkdir()

    def start(self, *arguments, ranks=1, environment=None):
        launcher = [MPIRUN, "-n", str(ranks)] if ranks > 1 else []
        return subprocess.Popen([*launcher, QUADLOOP, *arguments], cwd=self.folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                text=True)

    def ended(self, process):
        try:
            _, said = process.communicate(timeout=SECONDS)
        finally:
            process.kill()
        return process.returncode, said

    def mesh(self, *more, **how):
        return self.start("mesh", "case.toml", "-o", "out/a", "--quiet", *more, **how)

    def names(self):
        return sorted(os.listdir(self.out))

    def bytes_of_set(self, prefix):
        return [Path(f"{prefix}{suffix}").read_bytes() for suffix in SUFFIXES]

    def expect_refusal(self, result, status, *pieces):
        code, said = result
        ours = [line for line in said.splitlines() if line.startswith("quadloop: error")]
        self.assertEqual((code, len(ours)), (status, 1), said)
        for piece in pieces:
            self.assertIn(piece, ours[0])


class Together(FilesTest):
    """Runs at the same time, with the same names."""

    SPACINGS = ["spacing.max=0.5", "spacing.max=0.25"]

    def one_wins(self, runs):
        wanted = []
        for number, spacing in enumerate(self.SPACINGS):
            self.done("mesh", "case.toml", "-o", f"alone{number}", "--set", spacing)
            wanted.append(self.bytes_of_set(self.folder / f"alone{number}"))
        self.assertNotEqual(*wanted)
        for run in runs:
            self.assertEqual(self.ended(run), (0, ""))
        self.assertIn(self.bytes_of_set(self.out / "a"), wanted)
        self.assertEqual(self.names(), sorted("a" + suffix for suffix in SUFFIXES))

    def test_while_they_are_written(self):
        for _ in range(3):
            self.one_wins([self.mesh("--set", spacing, environment=disk("write", delay=1)) for spacing in self.SPACINGS])

    def test_while_they_are_renamed(self):
        """The first is slow from its first name on, and must not be overtaken."""
        for ranks in (1, 3):
            first = self.mesh("--set", self.SPACINGS[0], ranks=ranks, environment=disk("rename", delay=800))
            limit = time.monotonic() + SECONDS
            while "a.mesh" not in self.names() and time.monotonic() < limit:
                time.sleep(0.01)
            self.one_wins([first, self.mesh("--set", self.SPACINGS[1], ranks=ranks)])
            for name in self.names():
                (self.out / name).unlink()


class FullDisk(FilesTest):
    """A disk that is full from some call on: exit status 4, one line, nothing left behind; in the end it is large enough."""

    def check(self, call, step, *arguments, ranks=1):
        full, tries = 1, 0
        while True:
            code, said = self.ended(self.start(*arguments, ranks=ranks, environment=disk(call, full)))
            if code == 0:
                break
            self.expect_refusal((code, said), 4, NO_SPACE)
            self.assertEqual(self.names(), [], f"{call} {full}")
            tries += 1
            full = max(full + 1, int(full * step))
        self.assertGreater(tries, 2)

    def test_writing(self):
        self.check("write", 1.2, "mesh", "case.toml", "-o", "out/a")

    def test_closing(self):
        self.check("close", 1.3, "mesh", "case.toml", "-o", "out/a")

    def test_bringing_to_disk(self):
        self.check("fsync", 1, "mesh", "case.toml", "-o", "out/a")

    def test_renaming(self):
        self.check("rename", 1, "mesh", "case.toml", "-o", "out/a")

    def test_on_three_ranks(self):
        self.check("write", 3, "mesh", "case.toml", "-o", "out/a", ranks=3)

    def test_other_commands(self):
        self.done("mesh", "case.toml", "-o", "a")
        for arguments in (["smooth", "a.mesh", "-o", "out/b.cgns"], ["plot", "a.mesh", "-o", "out/b.png"],
                          ["solve", "case.toml", "a.mesh", "-o", "out/b.cgns"], ["mesh", "case.toml", "-o", "a", "--geometry-out", "out/a.geom"]):
            for call in ("write", "close"):
                with self.subTest(arguments=arguments, call=call):
                    self.expect_refusal(self.ended(self.start(*arguments, environment=disk(call, 1))), 4, "cannot be written: No space left")
                    self.assertEqual(self.names(), [])

    def test_adapt(self):
        """What was done stays in the folder of the cycle, for the eye; a later run goes on."""
        run = ["adapt", "case.toml", "-o", "out/loop", "--resume"]
        for call, full in (("write", 3), ("write", 40), ("write", 70), ("close", 4), ("fsync", 2), ("fsync", 15), ("rename", 1), ("rename", 9)):
            with self.subTest(call=call, full=full):
                code, said = self.ended(self.start(*run, environment=disk(call, full)))
                self.assertEqual(code, 4, said)
                self.assertIn("No space left", [line for line in said.splitlines() if "error" in line][0])
                self.assertEqual([path for path in self.out.rglob(".quadloop*")], [])
        self.done(*run)
        self.assertEqual(sorted(os.listdir(self.out / "loop")), ["cycle_00", "cycle_01"])


class Signals(FilesTest):
    """A run that is ended from outside takes its temporaries along."""

    def is_staged(self):
        return any(name.startswith(".quadloop-") for name in self.names())

    def is_locked(self):
        """Files get their names."""
        folder = os.open(self.out, os.O_RDONLY)
        try:
            fcntl.flock(folder, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return False
        except BlockingIOError:
            return True
        finally:
            os.close(folder)

    def under_way(self, call="write", delay=100, **how):
        run = self.mesh(environment=disk(call, delay=delay), **how)
        limit = time.monotonic() + SECONDS
        while not (self.is_locked() if call == "rename" else self.is_staged()):
            self.assertLess(time.monotonic(), limit)
            self.assertIsNone(run.poll(), "it ended before it was killed")
            time.sleep(0.005)
        return run

    def test_nothing_is_left(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1, signal.SIGABRT):
            with self.subTest(signal=number):
                run = self.under_way()
                run.send_signal(number)
                self.assertEqual(self.ended(run)[0], -number)
                self.assertEqual(self.names(), [])

    def test_limit_of_file_size(self):
        """The signal becomes an error of the write. The limit comes when MPI has made its own files."""
        run = self.under_way()
        resource.prlimit(run.pid, resource.RLIMIT_FSIZE, (500, 500))
        self.expect_refusal(self.ended(run), 4, "cannot be written: File too large", "ulimit -f")
        self.assertEqual(self.names(), [])

    def test_three_ranks(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(signal=number):
                run = self.under_way(ranks=3)
                time.sleep(0.5)  # until mpirun has taken note of its ranks
                run.send_signal(number)
                self.assertNotEqual(self.ended(run)[0], 0)
                limit = time.monotonic() + 10  # mpirun may be gone before its ranks
                while self.names() and time.monotonic() < limit:
                    time.sleep(0.05)
                if self.names():  # seldom: mpirun has killed its ranks before they could act; then the next run cleans up
                    self.done("mesh", "case.toml", "-o", "out/next", "--quiet")
                self.assertEqual([name for name in self.names() if name.startswith(".quadloop")], [])
                for path in self.out.iterdir():
                    path.unlink()

    def test_while_files_get_their_names(self):
        """The set is finished first."""
        run = self.under_way(call="rename")
        run.send_signal(signal.SIGTERM)
        self.assertEqual(self.ended(run)[0], -signal.SIGTERM)
        self.assertEqual(self.names(), sorted("a" + suffix for suffix in SUFFIXES))

    def test_parts_and_the_whole_get_their_names_together(self):
        """Whichever rank is ended, and when, while files come to the disk and get their names: all files of all ranks are those of one run. On one
        rank the last call is reached; elsewhere a rank is ended in each part of the work."""
        def files():
            return {path.name: path.read_bytes() for path in self.out.iterdir() if not path.name.startswith(".quadloop")}

        def parts(spacing, **how):
            return self.mesh("--set", "output.partitions=4", "--set", f"spacing.max={spacing}", "--set", 'output.formats=["mesh"]', **how)

        def kept(ranks, rank, call, number, sets):
            code, _ = self.ended(parts(0.25, ranks=ranks, environment=dict(disk(call), QUADLOOP_DISK_SIGNAL=str(number), QUADLOOP_DISK_RANK=str(rank))))
            self.assertIn(files(), sets, f"ranks {ranks}, rank {rank}: before {call} {number}")
            self.assertEqual(self.ended(parts(0.5)), (0, ""))
            return code == 0

        sets = []
        for spacing in (0.25, 0.5):
            self.assertEqual(self.ended(parts(spacing)), (0, ""))
            sets.append(files())
        for call in ("fsync", "rename"):
            number = 1
            while not kept(1, 0, call, number, sets):
                number += 1
            self.assertGreater(number, 8)
            for rank in range(3):
                for number in (1, 3):
                    kept(3, rank, call, number, sets)

    def test_killed_runs_are_cleaned_up_after(self):
        for call in ("write", "rename"):
            run = self.under_way(call=call)
            run.kill()
            self.ended(run)
            self.assertTrue(self.is_staged())
            self.assertFalse(self.is_locked())
        self.assertEqual(self.ended(self.mesh()), (0, ""))
        self.assertEqual(self.names(), sorted("a" + suffix for suffix in SUFFIXES))

    def test_a_living_run_is_left_alone(self):
        run = self.under_way(delay=30)
        self.assertEqual(self.ended(self.mesh("--set", "spacing.max=0.25")), (0, ""))
        self.assertEqual(self.ended(run), (0, ""))
        self.done("mesh", "case.toml", "-o", "alone")
        self.assertEqual(self.bytes_of_set(self.out / "a"), self.bytes_of_set(self.folder / "alone"))


class Places(FilesTest):
    """What may stand where a file is to go, and how it may be called."""

    def test_links_are_followed(self):
        target = self.folder / "elsewhere"
        target.mkdir()
        (target / "there.mesh").write_text("old")
        (self.out / "a.mesh").symlink_to("../elsewhere/there.mesh")
        (self.out / "a.vtu").symlink_to(target / "not yet.vtu")
        self.assertEqual(self.ended(self.mesh()), (0, ""))
        self.assertTrue((self.out / "a.mesh").is_symlink() and (self.out / "a.vtu").is_symlink())
        self.done("mesh", "case.toml", "-o", "alone")
        self.assertEqual(self.bytes_of_set(self.out / "a"), self.bytes_of_set(self.folder / "alone"))
        self.assertEqual(sorted(os.listdir(target)), ["not yet.vtu", "there.mesh"])

    def test_what_is_no_file_is_refused(self):
        for make, says in ((lambda path: os.mkfifo(path), "is a pipe"), (lambda path: path.symlink_to("/dev/null"), "is a device"),
                           (lambda path: path.symlink_to("a.mesh"), "Too many levels"), (lambda path: path.mkdir(), "is a folder")):
            for ranks in (1, 3) if says == "is a pipe" else (1,):
                make(self.out / "a.mesh")
                self.expect_refusal(self.ended(self.mesh(ranks=ranks)), 4, "out/a.mesh", says)
                self.assertEqual(self.names(), ["a.mesh"])
                os.rmdir(self.out / "a.mesh") if says == "is a folder" else os.unlink(self.out / "a.mesh")

    def test_a_folder_of_files_is_replaced_too(self):
        formats = ("--set", 'output.formats=["mesh", "polyMesh"]')
        self.done("mesh", "case.toml", "-o", "fine", "--set", "spacing.max=0.25", *formats[1:])
        for spacing in (0.5, 0.25):
            self.done("mesh", "case.toml", "-o", "a", "--set", f"spacing.max={spacing}", *formats[1:])
        self.done("smooth", "a.mesh", "-o", "smooth.polyMesh")
        self.done("smooth", "a.mesh", "-o", "smooth.polyMesh")
        for name in os.listdir(self.folder / "fine.polyMesh"):
            self.assertEqual((self.folder / "a.polyMesh" / name).read_bytes(), (self.folder / "fine.polyMesh" / name).read_bytes())
        (self.out / "a.polyMesh").write_text("precious")
        self.expect_refusal(self.ended(self.mesh(*formats)), 4, "out/a.polyMesh", "is no folder")
        self.assertEqual(self.names(), ["a.polyMesh"])

    def test_a_stream_of_the_process_is_no_output(self):
        self.done("mesh", "case.toml", "-o", "a", "--quiet")
        with open(self.folder / "redirected", "w") as out:  # a file that a rename would replace
            refused = self.run_program("convert", "a.mesh", "/dev/stdout", "--format", "vtu", stdout=out)
        self.assertEqual(refused.returncode, 4)
        self.assertIn("/dev/stdout: is a stream of the process", refused.stderr)

    def test_old_temporaries_are_no_trap(self):
        (self.folder / "victim").write_text("precious")
        (self.out / "a.mesh.part").symlink_to("../victim")
        os.mkfifo(self.out / "a.cgns.part")
        (self.out / "a.tree.h5.part").mkdir()
        self.assertEqual(self.ended(self.mesh()), (0, ""))
        self.assertEqual((self.folder / "victim").read_text(), "precious")

    def test_one_file_for_two_outputs(self):
        self.expect_refusal(self.ended(self.mesh("--geometry-out", "out/a.mesh")), 4, "out/a.mesh", "two outputs")

    def test_names_that_are_too_long(self):
        self.done("mesh", "case.toml", "-o", "a")
        cure = "File name too long; give a shorter name"
        for arguments in (["mesh", "case.toml", "-o", LONG], ["smooth", "a.mesh", "-o", LONG + ".mesh.mesh"], ["plot", "a.mesh", "-o", LONG + "xx.png"],
                          ["adapt", "case.toml", "-o", LONG * 2], ["solve", "case.toml", "a.mesh", "-o", LONG + ".x.mesh"],
                          ["remesh", "case.toml", "--tree", "a.tree.h5", "--solution", "a.mesh", "-o", LONG]):
            self.expect_refusal(self.ended(self.start(*arguments)), 4, LONG, cure)
        self.done("mesh", "case.toml", "-o", "out/" + "x" * 240)

    def test_inputs_with_names_that_are_too_long(self):
        self.done("mesh", "case.toml", "-o", "a")
        for arguments in (["mesh", LONG + ".x.toml", "-o", "a"], ["mesh", "case.toml", "--set", f'geometry.file="{LONG}.x.geom"'],
                          ["mesh", "case.toml", "--set", f'geometry.file="{LONG}.x.dxf"'], ["check", LONG * 2], ["check", LONG + ".x.mesh"],
                          ["check", LONG + ".x.cgns"], ["mesh", "case.toml", "--tree", LONG + ".x.tree.h5"],
                          ["remesh", "case.toml", "--tree", LONG + ".tree.h5", "--solution", "a.csv"]):
            with self.subTest(arguments=arguments):
                self.expect_refusal(self.ended(self.start(*arguments)), 1, LONG)


class Inputs(FilesTest):
    """Devices without an end, and pipes that nobody writes to."""

    USES = (("zero.toml", ["mesh", "zero.toml"]), ("zero.geom", ["mesh", "case.toml", "--set", 'geometry.file="zero.geom"']),
            ("zero.dxf", ["mesh", "case.toml", "--set", 'geometry.file="zero.dxf"']), ("zero.mesh", ["check", "zero.mesh"]),
            ("zero.cgns", ["check", "zero.cgns"]), ("zero.vtu", ["check", "zero.vtu"]),
            ("zero.tree.h5", ["mesh", "case.toml", "--tree", "zero.tree.h5"]))

    def test_no_files(self):
        for name, arguments in self.USES:
            with self.subTest(name=name):
                (self.folder / name).symlink_to("/dev/zero")
                self.expect_refusal(self.ended(self.start(*arguments)), 1, name, "is a device")
                (self.folder / name).unlink()

    def test_pipes(self):
        for name, arguments in self.USES:
            with self.subTest(name=name):
                os.mkfifo(self.folder / name)
                ranks = 3 if name in ("zero.toml", "zero.geom", "zero.dxf", "zero.mesh", "zero.vtu") else 1  # one rank alone waits for a writer
                self.expect_refusal(self.ended(self.start(*arguments, ranks=ranks)), 1, name, "is a pipe")

    def test_a_pipe_that_ends(self):
        os.mkfifo(self.folder / "pipe.toml")
        run = self.start("mesh", "pipe.toml", "-o", "out/a", "--quiet")
        (self.folder / "pipe.toml").write_text(CASE)
        self.assertEqual(self.ended(run), (0, ""))

    def test_a_pipe_without_an_end(self):
        run = subprocess.run(["bash", "-c", f"'{QUADLOOP}' mesh <(yes) -o out/a"], cwd=self.folder, capture_output=True, text=True, timeout=SECONDS)
        self.expect_refusal((run.returncode, run.stderr), 1, "more than 256 MB")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
