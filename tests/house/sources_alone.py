"""sources_alone.py SOURCES [PATTERN]: every source compiles by itself, as the preset `files` does it, and so includes what it uses: in a unit of the
preset `release` the sources before it may have included that. The compiler checks without generating code; only sources that match PATTERN."""
import json
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

source_folder, pattern = Path(sys.argv[1]), re.compile(sys.argv[2] if len(sys.argv) > 2 else "")
with tempfile.TemporaryDirectory() as build:
    subprocess.run(["cmake", "--preset", "files", "-B", build, "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", "-DCMAKE_CXX_COMPILER_LAUNCHER=env"],
                   cwd=source_folder, check=True, stdout=subprocess.DEVNULL)
    commands = [entry for entry in json.loads((Path(build) / "compile_commands.json").read_text()) if pattern.search(entry["file"])]

    def check(entry):
        command = re.sub(r" -o \S+", " -fsyntax-only", entry["command"])
        done = subprocess.run(command, shell=True, cwd=entry["directory"], stderr=subprocess.PIPE, text=True)
        return entry["file"], done.returncode, done.stderr

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        failed = [(file, errors) for file, status, errors in pool.map(check, commands) if status != 0]
for file, errors in failed:
    print(f"{file}:\n{errors[:2000]}")
print(f"{len(commands)} sources, {len(failed)} of them do not compile by themselves")
sys.exit(bool(failed) or not commands)
