"""Figures of docs/performance.md: each script writes what it has measured between two markers of its own; nothing else there is a figure."""
import os
import platform
import re
from datetime import date
from pathlib import Path


def machine():
    model = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    memory = int(re.search(r"MemTotal: +(\d+)", Path("/proc/meminfo").read_text())[1]) / 2**20
    return f"{model[1] if model else platform.machine()}, {os.cpu_count()} cores, {memory:.0f} GiB, {platform.system()} {platform.release()}"


def add_update(parser):
    parser.add_argument("--update", type=Path, metavar="FILE", help="puts the figures into the file, between this script's two markers")


def tell(text, script, update):
    """Prints the figures with the machine they were measured on, and puts them into the file if there is one."""
    text = f"{machine()}; {date.today()}; {text}"
    print(text)
    if update is None:
        return
    begin, end = f"<!-- figures: written by {script} -->", f"<!-- end of figures of {script} -->"
    before, rest = update.read_text().split(begin)
    update.write_text(f"{before}{begin}\n{text}\n{end}{rest.split(end)[1]}")
