#!/usr/bin/env python3
"""Each room of the house, a header with its sources, has a test, or a reason why a neighbour's covers it.

    rooms_have_tests.py REPOSITORY

A room's own test stands in the folder of tests/ that mirrors its own, or below, and includes its header. The file
covered_by_neighbours beside this names each other room, one a line: `room: test: reason`. And each test is built: its
source stands in a CMakeLists.txt, each folder with one of these in that of tests/.
"""
import re
import sys
from pathlib import Path

TOPS = ["adapt", "app", "flow", "generate", "io", "mesher", "quadloop", "smoother"]
OTHER_KINDS = ["property"]  # folders of tests that mirror none
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.M)


def mirror_of(folder):
    return Path("tests") / (folder.relative_to("mesher") if folder.parts[0] == "mesher" else folder)


def sources_below(folder, suffixes):
    return (path for path in sorted(folder.rglob("*")) if path.suffix in suffixes)


def has_own_test(room, root):
    tests = sources_below(root / mirror_of(room.parent), (".cpp", ".hpp"))
    return any(room.as_posix() in INCLUDE.findall(test.read_text()) for test in tests)


def excused(lines, rooms, root):
    """The rooms that the list names, and what is wrong with it."""
    named, faults = [], []
    for number, line in enumerate(lines, 1):
        parts = [part.strip() for part in line.split(":", 2)]
        room, test, reason = parts if len(parts) == 3 else (line, "", "")
        fault = ("is not `room: test: reason`" if not reason else
                 "there is no such room" if Path(room) not in rooms else
                 f"there is no test {test}" if not (root / test).is_file() else
                 "the room stands here twice" if Path(room) in named else
                 "the room has a test of its own: the line can go" if has_own_test(Path(room), root) else None)
        named.append(Path(room))
        if fault:
            faults.append(f"covered_by_neighbours:{number}: {room}: {fault}")
    return named, faults


def unbuilt(root):
    """What CMake does not know of: folders of tests/, and sources of tests."""
    tests = root / "tests"
    lists = {path.parent: re.sub(r"#.*", "", path.read_text()) for path in sorted(tests.rglob("CMakeLists.txt"))}
    entered = {tests} | {folder / word for folder, text in lists.items()
                         for call in re.findall(r"\b(?:add_subdirectory|foreach)\s*\(([^)]*)\)", text) for word in call.split()}
    yield from (f"{folder.relative_to(root)}: its CMakeLists.txt is entered by none" for folder in lists if folder not in entered)
    built = {(folder / word).resolve() for folder, text in lists.items() for word in re.findall(r"[^\s()\"]+_test\.cpp\b", text)}
    yield from (f"{path.relative_to(root)}: no CMakeLists.txt builds it" for path in sorted(tests.rglob("*_test.cpp")) if path not in built)


def main():
    root = Path(sys.argv[1]).resolve()
    rooms = [path.relative_to(root) for top in TOPS for path in sources_below(root / top, (".hpp",))]
    list_of_excused = Path(__file__).with_name("covered_by_neighbours")
    named, faults = excused(list_of_excused.read_text().splitlines(), rooms, root)
    faults += [f"{room}: no test below {mirror_of(room.parent)} includes it, and covered_by_neighbours does not name it"
               for room in rooms if room not in named and not has_own_test(room, root)]
    mirrors = {mirror_of(room.parent) for room in rooms} | {Path("tests") / kind for kind in OTHER_KINDS}
    faults += [f"{test}: its folder mirrors none" for path in (root / "tests").rglob("*_test.cpp")
               if (test := path.relative_to(root)).parent not in mirrors]
    faults += unbuilt(root)
    print("\n".join(faults) if faults else f"{len(rooms)} rooms, {len(named)} of them covered by a neighbour's test")
    return 1 if faults or not rooms else 0


if __name__ == "__main__":
    sys.exit(main())
