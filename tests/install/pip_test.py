"""pip installs the Python package from a build folder; it works without PYTHONPATH, and reads CGNS with the program beside the module."""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

PROGRAM = """
import quadloop as ql
assert ql.__file__.startswith(r"FOLDER"), ql.__file__
mesh = ql.mesh(ql.Case(outlines={"edge": [[0, 0], [1, 0], [1, 1]]}, spacing={"max": 0.25}))
mesh.write("triangle.cgns")
again = ql.read("triangle.cgns")[0]
assert again.nodes == mesh.nodes > 10
"""


def main(build):
    with tempfile.TemporaryDirectory() as name:
        work = Path(name)
        source, target = work / "source", work / "target"
        source.mkdir()
        for file in ("pyproject.toml", "setup.py", "README.md", "CMakeLists.txt"):
            shutil.copy(ROOT / file, source)
        shutil.copytree(ROOT / "python", source / "python")
        subprocess.run([sys.executable, "-m", "pip", "install", "--no-build-isolation", "--no-deps", "--no-index", "--quiet", "--disable-pip-version-check", "--root-user-action=ignore",
                        "--target", target, source], env={**os.environ, "QUADLOOP_BUILD": build}, check=True)
        here = {key: value for key, value in os.environ.items() if key != "QUADLOOP_READER"}
        subprocess.run([sys.executable, "-c", PROGRAM.replace("FOLDER", str(target))], env={**here, "PYTHONPATH": str(target)}, cwd=work, check=True)
        assert (target / "quadloop" / "quadloop-reader").exists()
        installed, = target.glob("quadloop-*.dist-info")
        stated, = (line.split()[1] for line in (installed / "METADATA").read_text().splitlines() if line.startswith("Version:"))
        assert f"project(quadloop VERSION {stated} " in (ROOT / "CMakeLists.txt").read_text()


main(sys.argv[1])
