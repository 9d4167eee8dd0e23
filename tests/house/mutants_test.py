"""scripts/mutants/rewrite.py on a small source: the mutations that it finds, and that each of them, switched on in the program compiled
from the rewritten source, does what it says. And that each line of accepted.txt takes mutants of the sources as they are: how many, it
prints."""
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(sys.argv[1])
sys.path.insert(0, str(ROOT / "scripts/mutants"))
sys.dont_write_bytecode = True
from accepted import accepted_patterns, sources  # noqa: E402
from rewrite import find_mutants, rewritten  # noqa: E402

SAMPLE = """\
#include <array>
#include <cstdio>  // a < b here is none, nor is "a - b" below
#define QUADLOOP_REQUIRE(condition, message) static_cast<void>(condition)
constexpr int most = 4;
template <int n>
int entry(const std::array<int, 2>& a) { return a[0] < n ? -1 : a[1]; }
int main() {
  const int a = 3, b = most;
  QUADLOOP_REQUIRE(a < b, "a - b");
  if (a < b && (b != 7 ||
                a > b)) std::printf("x");
  if (!b) std::printf("y");
  std::printf("%d %d", a - b, entry<2>({a, b}));
}
"""
# What is mutated, and what the program then prints.
EXPECTED = {
    "constexpr int most = «4 -> 5»;": "x-2 5",
    "int entry(const std::array<int, 2>& a) { return a[0] «< -> <=» n ? -1 : a[1]; }": "x-1 4",
    "const int a = «3 -> 4», b = most;": "0 4",
    "if («a < b -> true» && (b != 7 ||": "x-1 4",
    "if (a «< -> <=» b && (b != 7 ||": "x-1 4",
    "if (a < b && «(b != 7 || a > b) -> true») std::printf(\"x\");": "x-1 4",
    "if (a < b && («b != 7 -> false» ||": "-1 4",
    "if (a < b && (b «!= -> ==» 7 ||": "-1 4",
    "if (a < b && (b != «7 -> 8» ||": "x-1 4",
    "«a > b -> false»)) std::printf(\"x\");": "x-1 4",
    "a «> -> >=» b)) std::printf(\"x\");": "x-1 4",
    "if («!b -> not») std::printf(\"y\");": "xy-1 4",
    "std::printf(\"%d %d\", a «- -> +» b, entry<2>({a, b}));": "x7 4",
}


def accepted_in_vain():
    keys = [mutant.key for source in sources(ROOT) for mutant in find_mutants(source.relative_to(ROOT).as_posix(), source.read_text(), 0)]
    taken = {key: sum(pattern.fullmatch(found) is not None for found in keys) for key, pattern in accepted_patterns().items()}
    print("".join(f"{number:5} of {len(keys)}: {key}\n" for key, number in taken.items()))
    return [f"scripts/mutants/accepted.txt: no such mutant: {key}" for key, number in taken.items() if number == 0]


def main():
    mutants = find_mutants("sample.cpp", SAMPLE, 0)
    found = [mutant.key.removeprefix("sample.cpp: ") for mutant in mutants]
    failed = [f"not expected: {key}" for key in found if key not in EXPECTED] + [f"not found: {key}" for key in EXPECTED if key not in found]
    with tempfile.TemporaryDirectory() as folder:
        source, program = Path(folder, "sample.cpp"), Path(folder, "sample")
        source.write_text(f'#include "{ROOT}/scripts/mutants/mutants.hpp"\n' + rewritten(SAMPLE, mutants))
        subprocess.run(["c++", "-std=c++20", source, "-o", program], check=True)
        for number, key in [(-1, "none"), *enumerate(found)]:
            printed = subprocess.run([program], env={"QUADLOOP_MUTANT": str(number)}, capture_output=True, text=True).stdout
            if printed != EXPECTED.get(key, "x-1 4"):
                failed.append(f"{key}: prints {printed}")
    failed += accepted_in_vain()
    print("\n".join(failed) if failed else f"{len(found)} mutants, each as it says")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
