"""What the tests of the adaptive loop share: a tiny case with a solver that can be told to fail, and folders compared. Standard library only."""
import filecmp
import json
import os
import shutil
import subprocess
from pathlib import Path

from quadloop_runs import MPIRUN, ROOT, fail, run

RING = ROOT / "cases" / "ring"

# A ring of a wide step on a coarse mesh: a cycle takes a fraction of a second.
TINY = """[geometry]
file = "square.geom"
[spacing]
min = 0.25
max = 0.5
gradation = 1.5
[boundary.frame]
bc = "farfield"
[adapt]
cycles = 4
variable = "height"
threshold = "deviation"
refine = 0.5
coarsen = 0.5
min = 0.03
[solver]
kind = "command"
command = ["python3", "{case}/solver.py", "{mesh}", "{solution}"]
timeout = 100
"""


def require(holds, message):
    if not holds:
        fail(message)


def sets(assignments):
    return [word for text in assignments for word in ("--set", text)]


def records(folder):
    return [json.loads((cycle / "record.json").read_text()) for cycle in sorted(folder.glob("cycle_*"))]


def adapt_three_ways(program, case, folder, options=()):
    """Two cycles on one rank, on three, and with the second one made again by --resume: meshes, trees and estimates are the same. {way: its records}."""
    words = ["--cycles", "2", *options]
    run([program, "-q", "adapt", case, "-o", folder / "one", *words])
    run([MPIRUN, "-n", "3", program, "-q", "adapt", case, "-o", folder / "three", *words])
    shutil.copytree(folder / "one", folder / "again")
    shutil.rmtree(folder / "again" / "cycle_02")
    run([program, "-q", "adapt", case, "-o", folder / "again", "--resume", *words])
    for cycle in ("cycle_01", "cycle_02"):
        for name in ("mesh.mesh", "mesh.tree.h5", "mesh.estimate.vtu"):
            one = folder / "one" / cycle / name
            for way in ("three", "again"):
                other = folder / way / cycle / name
                require(one.read_bytes() == other.read_bytes(), f"{one} and {other} differ")
    return {way: records(folder / way) for way in ("one", "three", "again")}


def remesh_as_the_loop(program, case, folder):
    """`remesh` from the first cycle of adapt_three_ways(), on one rank and on two: next_1 and next_2 have the tree of the second cycle, and one mesh."""
    last = folder / "one" / "cycle_01"
    for ranks in (1, 2):
        run(command_of(program, ranks, "remesh", case, "-q", "--tree", last / "mesh.tree.h5", "--solution", last / "mesh.mesh", "-o", folder / f"next_{ranks}"))
    tree = (folder / "one" / "cycle_02" / "mesh.tree.h5").read_bytes()
    require((folder / "next_1.tree.h5").read_bytes() == tree, "remesh makes another tree than the loop")
    require((folder / "next_2.tree.h5").read_bytes() == tree, "remesh makes another tree on 2 ranks")
    require((folder / "next_1.mesh").read_bytes() == (folder / "next_2.mesh").read_bytes(), "remesh makes another mesh on 2 ranks")


def tiny_case(folder, solver=None, text=TINY):
    """The case file of a tiny ring in `folder`; `solver` is the text of another solver.py."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "square.geom").write_text((RING / "square.geom").read_text())
    (folder / "solver.py").write_text(solver or (RING / "solver.py").read_text().replace("0.01", "0.1"))
    case = folder / "case.toml"
    case.write_text(text)
    return case


def command_of(program, ranks, *words):
    launcher = [MPIRUN, "-n", str(ranks)] if ranks > 1 else []
    return [str(word) for word in (*launcher, program, *words)]


def adapt(program, case, folder, ranks=1, options=()):
    return run(command_of(program, ranks, "adapt", case, "-o", folder, *options))


def attempt(program, *words, ranks=1):
    """(exit status, what stands on stderr) of a command that may fail."""
    command = command_of(program, ranks, *words)
    print("+", " ".join(command), flush=True)
    at_once = dict(os.environ, OMPI_MCA_odls_base_sigkill_timeout="0")  # mpirun would wait a second before it kills ranks that have ended too
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300, env=at_once)
    return done.returncode, done.stderr


def expect_refusal(program, status, parts, *words, ranks=1):
    found, message = attempt(program, *words, ranks=ranks)
    require(found == status, f"exit status {found} instead of {status}: {message}")
    for part in parts:
        require(part in message, f"the message does not say '{part}': {message}")


def files_in(folder):
    """{path below `folder`: path} of all files."""
    return {str(path.relative_to(folder)): path for path in sorted(Path(folder).rglob("*")) if not path.is_dir()}


def without_times(path):
    record = json.loads(path.read_text())
    require(record.pop("seconds", None), f"{path} has no seconds")
    return list(record.items())  # the order of the members counts


def same_file(name, one, other):
    if name.endswith("log.txt") or name.endswith("solver.log"):
        return True
    if name.endswith("record.json"):
        return without_times(one) == without_times(other)
    return filecmp.cmp(one, other, shallow=False)


def require_same_folders(one, other, context):
    """Byte for byte, but for what tells of time."""
    left, right = files_in(one), files_in(other)
    require(left, f"{one} is empty")
    require(left.keys() == right.keys(), f"{context}: other files: {sorted(left.keys() ^ right.keys())[:6]}")
    different = [name for name in left if not same_file(name, left[name], right[name])]
    require(not different, f"{context}: {len(different)} files differ: {different[:6]}")


def states(folder):
    """{path: inode, time and size}: equal only where nobody has touched the files."""
    found = {}
    for name, path in files_in(folder).items():
        state = path.stat()
        found[name] = (state.st_ino, state.st_mtime_ns, state.st_size)
    return found
