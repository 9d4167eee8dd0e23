"""The README's example is what cases/my_airfoil ships, and it meshes, also with the README's tables for adaptation.

    python3 readme_example.py SOURCE_DIR QUADLOOP
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path


def main():
    source, program = Path(sys.argv[1]), sys.argv[2]
    blocks = re.findall(r"^```toml\n(.*?)^```", (source / "README.md").read_text(), re.M | re.S)
    case, adaptation = (next(block for block in blocks if block.startswith(table)) for table in ("[geometry]", "[adapt]"))
    shipped = source / "cases/my_airfoil"
    if (shipped / "my_airfoil.toml").read_text() != case:
        return "README.md and cases/my_airfoil/my_airfoil.toml differ"
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("as_shipped", case), ("adaptive", case + adaptation)):
            file = Path(folder) / f"{name}.toml"
            file.write_text(text.replace("my_airfoil.dat", str(shipped / "my_airfoil.dat")))
            result = subprocess.run([program, "mesh", file, "-o", name, "--quiet"], cwd=folder, capture_output=True, text=True)
            if result.returncode != 0 or result.stderr:
                return f"{name}: exit status {result.returncode}: {result.stderr}"
    return 0


if __name__ == "__main__":
    sys.exit(main())
