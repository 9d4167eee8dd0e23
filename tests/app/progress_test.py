"""The line of progress: on a terminal alone, within its width, and gone when the run ends.

    python3 progress_test.py QUADLOOP MPIRUN
"""
import fcntl
import os
import pty
import re
import struct
import subprocess
import sys
import termios
import unittest

from program import QUADLOOP, ProgramTest

COLUMNS = 50
ERASE = "\r\x1b[K"
BOX = "1\nbox\n4\n0 0\n1 0\n1 1\n0 1\n"
CASE = """[geometry]
file = "box.geom"
[spacing]
min = 0.0002
max = 0.0008
[boundary.box]
spacing = 0.0002
[[source]]
line = [0.1, 0.13, 0.9, 0.71]
spacing = 0.0002
[output]
formats = ["mesh"]
"""


class Progress(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("box.geom", BOX)
        self.write("case.toml", CASE)

    def on_terminal(self, *arguments):
        """Exit status and what a terminal of COLUMNS columns gets from stderr."""
        ours, its = pty.openpty()
        fcntl.ioctl(its, termios.TIOCSWINSZ, struct.pack("HHHH", 24, COLUMNS, 0, 0))
        process = subprocess.Popen([QUADLOOP, *arguments], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=its)
        os.close(its)
        text = b""
        while True:
            try:
                piece = os.read(ours, 4096)
            except OSError:  # the other end is closed
                break
            if not piece:
                break
            text += piece
        os.close(ours)
        return process.wait(), text.decode().replace("\r\n", "\n")

    def lines_of(self, text):
        return [line for line in re.split(r"\r|\x1b\[K|\n", text) if line and not line.startswith("quadloop: ")]

    def test_a_long_run_shows_its_stages_and_leaves_nothing(self):
        status, text = self.on_terminal("mesh", "case.toml", "-o", "out")
        self.assertEqual(status, 0, text)
        lines = self.lines_of(text)
        self.assertTrue(lines, "no line of progress")
        self.assertTrue(any(re.match(r"(refinement|cutting|cells|smoothing|writing)  +\d+ %", line) for line in lines), lines)
        for line in lines:
            self.assertLess(len(line), COLUMNS)
        self.assertTrue(text.endswith(ERASE), repr(text[-80:]))

    def test_an_error_stands_on_a_line_of_its_own(self):
        status, text = self.on_terminal("mesh", "case.toml", "-o", "out", "--max-cells", "100")
        self.assertEqual(status, 1)
        self.assertIn("--max-cells allows 100", text)
        before = text[: text.index("quadloop: error")]
        self.assertTrue(before == "" or before.endswith((ERASE, "\n")), repr(before))

    def test_a_solver_shows_steps_residual_and_cycle(self):
        self.write("flow.toml", '[geometry]\nfile = "box.geom"\n[spacing]\nmin = 0.0025\nmax = 0.005\n[boundary.box]\nspacing = 0.005\nbc = "farfield"\n'
                   '[solver]\nmach = 0.5\ninitial = "vortex"\niterations = 30\ntolerance = 1e-14\n[adapt]\nvariable = "density"\ncycles = 0\n')
        status, text = self.on_terminal("adapt", "flow.toml", "-o", "run")
        self.assertEqual(status, 0, text)
        self.assertRegex(text, r"cycle 0 of 0: solving +\d+ %  step \d+  residual")

    def test_nothing_in_a_pipe_nor_for_short_and_quiet_runs(self):
        self.assertNotIn("\x1b", self.done("mesh", "case.toml", "-o", "out")[1])
        self.assertEqual(self.on_terminal("mesh", "case.toml", "-o", "out", "--quiet"), (0, ""))
        self.write("short.toml", '[geometry]\nfile = "box.geom"\n[spacing]\nmin = 0.1\nmax = 0.2\n')
        self.assertEqual(self.on_terminal("mesh", "short.toml", "-o", "out"), (0, ""))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
