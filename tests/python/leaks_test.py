"""No memory is lost with each mesh, morph, adaptation, file or error: LeakSanitizer finds as much after a hundred of each as after one.

MPI and Python themselves lose some kilobytes at their start, the same in both runs.
"""
import os
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = """
import sys
import numpy as np
import quadloop as ql

angle = np.linspace(0, 2 * np.pi, 12, endpoint=False)
oval = np.column_stack([np.cos(angle), 0.5 * np.sin(angle)])
square = ql.Case(outlines={"edge": [[0, 0], [1, 0], [1, 1], [0, 1]]}, spacing={"max": 0.5, "min": 0.1},
                 adapt={"cycles": 1, "variable": "u", "norm": 2, "max_nodes": 200})
for k in range(int(sys.argv[1])):
    case = ql.Case(outlines={"body": oval}, geometry={"far_field": 4.0}, spacing={"max": 1.0},
                   boundary={"body": {"spacing": 0.5, "bc": "wall", "layers": {"first": 0.05, "growth": 1.3, "count": 2}}})
    mesh = ql.mesh(case)
    mesh.points.sum(), mesh.edges["body"].sum(), mesh.check(), mesh.quality, mesh.layers, mesh.png(size=100)
    mesh.write("body.su2")
    ql.read("body.su2")
    morphed = ql.Run(case).morph({"body": 1.01 * oval})
    morphed.pull_back(morphed.push_forward({"body": oval}))
    for cycle in ql.adapt(square, lambda mesh, start: {"u": np.tanh(20 * mesh.points[:mesh.owned, 0])}):
        pass
    try:
        ql.mesh(ql.Case(outlines={"bow": [[0, 0], [1, 1], [1, 0], [0, 1]]}, spacing={"max": 0.5}))
        raise SystemExit("an outline that crosses itself was meshed")
    except ql.InputError:
        pass
"""


def lost_bytes(meshes):
    compiler, = sys.argv[1:2]
    library = subprocess.run([compiler, "-print-file-name=liblsan.so"], capture_output=True, text=True, check=True).stdout.strip()
    environment = {**os.environ, "LD_PRELOAD": library, "LSAN_OPTIONS": "exitcode=0", "PYTHONMALLOC": "malloc", "PYTHONDONTWRITEBYTECODE": "1"}
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run([sys.executable, "-W", "ignore", "-c", PROGRAM, str(meshes)], env=environment, cwd=folder, capture_output=True,
                             text=True)
    if "LeakSanitizer has encountered a fatal error" in run.stderr:
        raise unittest.SkipTest("this system does not let LeakSanitizer stop the threads of a process")
    if run.returncode != 0:
        raise AssertionError(run.stderr)
    found = re.search(r"SUMMARY: LeakSanitizer: (\d+) byte", run.stderr)
    return int(found.group(1)) if found else 0


class Leaks(unittest.TestCase):
    def test_a_hundred_meshes_lose_no_more_than_one(self):
        self.assertLess(lost_bytes(101) - lost_bytes(1), 100, "bytes lost in a hundred rounds: less than one in each")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
