#!/usr/bin/env python3
"""A class has its name to itself: two of one name and namespace in one program are one to the linker, which takes the members of either for both.

    names_once.py REPOSITORY

Classes within an unnamed namespace, within functions and within other classes are nobody else's, so they are not counted.
"""
import re
import sys
from collections import defaultdict
from pathlib import Path

TOPS = ["adapt", "app", "flow", "generate", "io", "mesher", "quadloop", "smoother"]
OPENED = re.compile(r"namespace ?([\w:]*) \{")
CLOSED = re.compile(r"\}  // namespace")
CLASS = re.compile(r"(?:struct|class|enum|enum class|union) (\w+)(?: final)?(?: : [^;]*| *)\{")


def classes_of(path):
    """(name with its namespaces, line) of each class that other files could name too."""
    spaces = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if found := OPENED.match(line):
            spaces.append(found[1])
        elif CLOSED.match(line):
            spaces.pop()
        elif (found := CLASS.match(line)) and all(spaces):
            yield "::".join([*spaces, found[1]]), number


def main():
    root, places = Path(sys.argv[1]), defaultdict(list)
    for path in sorted(path for top in TOPS for path in (root / top).rglob("*.[ch]pp")):
        for name, number in classes_of(path):
            places[name].append(f"{path.relative_to(root)}:{number}")
    twice = {name: where for name, where in places.items() if len(where) > 1}
    for name, where in twice.items():
        print(f"{name} is defined more than once: {', '.join(where)}; rename all but one, or put them into an unnamed namespace")
    if len(places) < 100:
        sys.exit(f"only {len(places)} classes found: is {root} the repository?")
    sys.exit(1 if twice else 0)


main()
