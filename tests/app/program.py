"""A folder of its own for each test, and the program run in it: the launcher and the program are the command line's arguments."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

QUADLOOP, MPIRUN = (str(Path(program).resolve()) for program in sys.argv[1:3])


class ProgramTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def run_program(self, *arguments, ranks=1, stdout=subprocess.PIPE):
        launcher = [MPIRUN, "-n", str(ranks)] if ranks > 1 else []
        return subprocess.run([*launcher, QUADLOOP, *arguments], cwd=self.folder, stdout=stdout, stderr=subprocess.PIPE, text=True)

    def done(self, *arguments, ranks=1):
        """What the program says on stdout and on stderr where it ends well."""
        result = self.run_program(*arguments, ranks=ranks)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout, result.stderr

    def refused(self, status, pieces, *arguments):
        result = self.run_program(*arguments)
        self.assertEqual(result.returncode, status, result.stderr)
        lines = result.stderr.splitlines()  # warnings may come before the error
        self.assertEqual([line.startswith("quadloop: error: ") for line in lines], [False] * (len(lines) - 1) + [True], result.stderr)
        for piece in pieces:
            self.assertIn(piece, result.stderr)
