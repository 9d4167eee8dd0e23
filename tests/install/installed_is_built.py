"""installed_is_built.py BUILD_FOLDER: the target `installed`, which scripts/quickstart builds, has every file that `cmake --install` copies from the
build folder."""
import re
import subprocess
import sys
from pathlib import Path

build = Path(sys.argv[1]).absolute()
copied = set()
for script in build.rglob("cmake_install.cmake"):
    copied.update(re.findall(rf'"{re.escape(str(build))}/(\S+?(?:\.a|/quadloop(?:-reader)?))"', script.read_text()))
assert len(copied) > 20 and {"app/quadloop", "io/quadloop-reader"} <= copied, f"only {sorted(copied)} are copied"
built = set(subprocess.check_output(["ninja", "-C", build, "-t", "query", "installed"], text=True).split())  # what it names itself
missing = sorted(copied - built)
if missing:
    sys.exit("not built by the target `installed`:\n  " + "\n  ".join(missing))
print(f"all {len(copied)} files that are installed are built")
