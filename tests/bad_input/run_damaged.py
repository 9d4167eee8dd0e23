"""Damages files bit by bit, cuts them, and lets the program read them: it must end with 0 or 1, a refusal be one line that names the file, and
neither memory nor time go beyond what a small file explains. Meshes go to `check`, the tree to `mesh --tree`. Seeded.

    python3 run_damaged.py QUADLOOP COUNT [SUFFIX...]
"""

import os
import random
import resource
import subprocess
import sys
import tempfile

CASE = """[geometry]
file = "box.geom"
[spacing]
min = 0.1
max = 0.25
[boundary.wall]
bc = "wall"
[smooth]
sweeps = 0
[output]
formats = ["mesh", "qmesh", "cgns", "vtu", "su2", "msh"]
"""
OUTLINE = "2\nbox\n4\n0 0\n2 0\n2 1\n0 1\nwall\n4\n0.7 0.4\n0.7 0.6\n0.9 0.6\n0.9 0.4\n"
SUFFIXES = ("cgns", "tree.h5", "mesh", "qmesh", "vtu", "su2", "msh")
BY_LIBRARY = ("cgns", "tree.h5")  # the others, which are parsed here, are damaged by the thousand in tests/io/damaged_text_test
LARGEST_MEMORY = 700 << 10  # KiB, of the program and of its child
LARGEST_TIME = 25  # processor seconds: a child that loops is stopped after 5


def damaged(whole, draw):
    data = bytearray(whole)
    kind = draw.random()
    if kind < 0.15:
        return bytes(data[: draw.randrange(len(data))])
    begin = draw.randrange(len(data))
    near = 4096 if kind < 0.6 else len(data)  # what tells where the rest lies stands close together
    for _ in range(draw.choice((1, 1, 1, 2, 4, 16))):
        at = (begin + draw.randrange(near)) % len(data)
        data[at] ^= 1 << draw.randrange(8)
    return bytes(data)


def run(program, arguments, folder):
    """Its result, processor seconds, and KiB of memory."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = subprocess.run([program] + arguments, cwd=folder, capture_output=True, timeout=600)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return result, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, after.ru_maxrss


def fault_of(program, name, folder):
    arguments = ["mesh", "case.toml", "--tree", name, "-o", "out", "--quiet"] if name.endswith(".h5") else ["check", name, "--quiet"]
    result, seconds, memory = run(program, arguments, folder)
    lines = [line for line in result.stderr.split(b"\n") if line and not line.startswith(b"quadloop: warning")]
    if result.returncode not in (0, 1):
        return f"exit status {result.returncode}: {result.stderr[:400]!r}"
    if len(lines) != result.returncode or not all(line.startswith(b"quadloop: error: " + name.encode()) for line in lines):
        return f"exit status {result.returncode}, but stderr is {result.stderr[:400]!r}"
    if seconds > LARGEST_TIME:
        return f"{seconds:.1f} s of processor time"
    if memory > LARGEST_MEMORY:
        return f"{memory >> 10} MiB of memory"
    return None


def main():
    program, count, suffixes = os.path.abspath(sys.argv[1]), int(sys.argv[2]), sys.argv[3:] or SUFFIXES
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("box.geom", OUTLINE), ("case.toml", CASE)):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        subprocess.run([program, "mesh", "case.toml", "-o", "whole", "--quiet"], cwd=folder, check=True)
        for suffix in suffixes:
            name = "damaged." + suffix
            with open(os.path.join(folder, "whole." + suffix), "rb") as file:
                whole = file.read()
            draw = random.Random(suffix)
            for number in range(count if suffix in BY_LIBRARY else count // 5):
                data = damaged(whole, draw)
                with open(os.path.join(folder, name), "wb") as file:
                    file.write(data)
                fault = fault_of(program, name, folder)
                os.remove(os.path.join(folder, name))
                if fault:
                    print(f"{suffix}, damage {number}: {fault}")
                    failed += 1
    print(f"damaged files of {', '.join(suffixes)}: {failed} faults")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
