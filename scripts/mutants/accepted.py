"""What scripts/mutate judges, and accepted.txt: which of its survivors are no gap."""
import re
from pathlib import Path

FOLDERS = ["mesher/cut", "mesher/forest", "mesher/snap", "mesher/sizes", "smoother", "adapt"]  # a run judges all or some of them


def sources(root, folders=FOLDERS):
    return sorted(p for folder in folders for p in (root / folder).rglob("*.cpp"))


def accepted_patterns():
    """A key of accepted.txt, in which … stands for any text -> the mutants' keys that it takes."""
    lines = (Path(__file__).parent / "accepted.txt").read_text().splitlines()
    keys = [line.rsplit("   # ", 1)[0] for line in lines if line and not line.startswith("#")]
    return {key: re.compile(".*".join(map(re.escape, key.split("…")))) for key in keys}
