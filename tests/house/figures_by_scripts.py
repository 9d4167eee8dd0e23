#!/usr/bin/env python3
"""docs/performance.md holds no measured figure but those that scripts write between their markers.

    figures_by_scripts.py docs/performance.md
"""
import re
import sys
from pathlib import Path

WRITTEN = re.compile(r"<!-- figures: written by (\S+) -->.*?<!-- end of figures of \1 -->", re.DOTALL)
FIGURE = re.compile(r"\d+\.\d|\d ?%|\d (s|seconds|MB|GB|bytes|million)\b|\d times\b")


def main():
    text = Path(sys.argv[1]).read_text(encoding="utf-8")
    scripts = set(WRITTEN.findall(text))
    stray = [line for line in WRITTEN.sub("", text).splitlines() if FIGURE.search(line)]
    for line in stray:
        print(f"a figure that no script writes: {line}")
    missing = [script for script in scripts if not (Path(__file__).parents[1] / "bench" / script).exists()]
    print(*(f"there is no script tests/bench/{script}" for script in missing), sep="\n")
    return 1 if stray or missing or not scripts else 0


if __name__ == "__main__":
    sys.exit(main())
