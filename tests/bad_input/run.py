"""Runs the program on every refusal of cases.py: the exit status must be right, stderr hold one line that names the place, after the
warnings that came before it, and no new file be left behind.

    python3 run.py QUADLOOP MPIRUN RANKS
"""

import os
import subprocess
import sys
import tempfile

import cases


def files_below(folder):
    return sorted(os.path.join(place, name) for place, _, names in os.walk(folder) for name in names)


def lines_of_ours(text):
    """mpirun adds its own lines about a program that failed; ours begin with the program's name."""
    return [line for line in text.splitlines() if line.startswith("quadloop")]


# After a rank has ended with an error mpirun waits so many seconds before it kills the others, which have ended too.
AT_ONCE = dict(os.environ, OMPI_MCA_odls_base_sigkill_timeout="0")


def run(program, mpirun, ranks, arguments, folder):
    launcher = [mpirun, "-n", str(ranks)] if ranks > 1 else []
    return subprocess.run(launcher + [program] + arguments, cwd=folder, capture_output=True, text=True, timeout=60, env=AT_ONCE)


def faults_of(refusal, program, mpirun, ranks):
    with tempfile.TemporaryDirectory() as folder:
        os.mkdir(os.path.join(folder, "taken.mesh"))
        for name, text in (("box.geom", refusal.geometry), ("case.toml", refusal.case)):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        before = files_below(folder)
        result = run(program, mpirun, ranks, refusal.arguments, folder)
        lines = lines_of_ours(result.stderr)
        if result.returncode != refusal.status:
            yield f"exit status {result.returncode}, not {refusal.status}: {result.stderr}"
        kinds = [line.split(":")[1].strip() for line in lines]
        if kinds != ["warning"] * refusal.warnings + ["error"] or (ranks == 1 and len(result.stderr.splitlines()) != len(lines)):
            yield f"not {refusal.warnings} warnings and one error on stderr: {result.stderr!r}"
        for piece in refusal.says:
            if piece not in result.stderr:
                yield f"'{piece}' is not in: {result.stderr!r}"
        if result.stdout:
            yield f"text on stdout: {result.stdout!r}"
        if files_below(folder) != before:
            yield f"files left behind: {sorted(set(files_below(folder)) - set(before))}"


def check_success(program, mpirun, ranks):
    """The case that all refusals are made from is itself good, and help and version are no failure."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("box.geom", cases.SQUARE), ("case.toml", cases.CASE)):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        several = ["mesh", "-o", "out", "--set", "spacing.max=0.5", "smooth.sweeps=3", "case.toml", "--quiet"]
        for arguments in (["mesh", "case.toml", "-o", "out", "--quiet"], several, ["mesh", "--help"], ["--version"], ["--help"], ["mesh", "--version"]):
            result = run(program, mpirun, ranks, arguments, folder)
            if result.returncode != 0 or result.stderr:
                yield f"{arguments}: exit status {result.returncode}, stderr {result.stderr!r}"
            if ("--quiet" in arguments) != (result.stdout == ""):
                yield f"{arguments}: stdout {result.stdout!r}"
            if "mesh" in arguments and "--help" in arguments and not all(flag in result.stdout for flag in ("--quiet", "--verbose")):
                yield f"{arguments}: not every flag is listed"
            if "--version" in arguments and len(result.stdout.splitlines()) != 1:
                yield f"{arguments}: one line, from one rank, not {result.stdout!r}"


def main():
    program, mpirun, ranks = os.path.abspath(sys.argv[1]), sys.argv[2], int(sys.argv[3])
    failed = 0
    for fault in check_success(program, mpirun, ranks):
        print(f"good input: {fault}")
        failed += 1
    for refusal in cases.ALL:
        for fault in faults_of(refusal, program, mpirun, ranks):
            print(f"{refusal.name}: {fault}")
            failed += 1
    print(f"{len(cases.ALL)} refusals on {ranks} ranks, {failed} faults")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
