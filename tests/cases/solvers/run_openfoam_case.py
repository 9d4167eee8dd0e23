#!/usr/bin/env python3
"""What quadloop makes of a user's case for OpenFOAM, by a program that stands in for its solver: which files are copied, what is refused before the first
mesh, what is told of an error, what an mpirun is allowed, and layers that follow the y+ which OpenFOAM has on walls alone.

    run_openfoam_case.py --quadloop PROGRAM
"""
import argparse
import json
import math
import os
import shutil
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from adapt_runs import adapt, attempt, expect_refusal, require
from quadloop_runs import MPIRUN, ROOT, run

# Writes a density with a step at x = 0.5, and y+ and a shear of its own on the ramp. A file `fault` in the case says what goes wrong.
SOLVER = '''#!/usr/bin/env python3
import re, sys
from pathlib import Path
def head(kind, name):
    return "FoamFile\\n{\\n version 2.0;\\n format ascii;\\n class " + kind + ";\\n object " + name + ";\\n}\\n"
def body(name):
    return Path("constant/polyMesh", name).read_text().split("}", 1)[1]
fault = Path("fault").read_text() if Path("fault").exists() else ""
if fault == "fatal":
    print("--> FOAM FATAL IO ERROR: \\nCannot find patchField entry for square\\n\\nfile: 0/p.boundaryField from line 2 to 9.\\n")
    print("    From function void Foam::x()\\n    in file /build/y.C at line 180.\\n\\nFOAM exiting\\n")
    sys.exit(1)
points = [tuple(map(float, row.split())) for row in re.findall(r"\\(([^()]*)\\)", body("points"))]
faces = [list(map(int, row.split())) for row in re.findall(r"\\d+\\(([^()]*)\\)", body("faces"))]
owner = list(map(int, re.search(r"\\(([^()]*)\\)", body("owner")).group(1).split()))
patches = re.findall(r"(\\w+)\\s*\\{[^}]*type\\s+(\\w+);[^}]*nFaces\\s+(\\d+);[^}]*startFace\\s+(\\d+);", body("boundary"))
cells = max(owner) + 1
x = [0] * cells
for corners, cell in zip(faces, owner):
    x[cell] = sum(points[node][0] for node in corners) / len(corners)
out = Path("7")
out.mkdir(exist_ok=True)
rho = "".join(f"{1 + (at > 0.5)}\\n" for at in x)
(out / "rho").write_text(head("volScalarField", "rho") + f"internalField nonuniform List<scalar>\\n{cells}\\n(\\n{rho})\\n;\\nboundaryField {{}}\\n")
values = ""
for name, kind, count, first in patches:
    if kind == "wall":
        mine = " ".join(str(Y_PLUS) for _ in range(int(count)))
        values += name + " { type calculated; value nonuniform List<scalar> " + count + "(" + mine + "); }\\n"
    else:
        values += name + " { type calculated; value uniform 0; }\\n"
(out / "yPlus").write_text(head("volScalarField", "yPlus") + "internalField uniform 0;\\nboundaryField\\n{\\n" + values + "}\\n")
'''
CONTROL = "// application none;\nFoamFile { format ascii; class dictionary; }\nfunctions { one { writeFormat binary; application two; } }\n" \
          "application   standInFoam;\nwriteFormat   ascii;\nwriteCompression off;\n"
FIELD = "FoamFile { format ascii; class volScalarField; object rho; }\ninternalField uniform 1;\nboundaryField {}\n"


def wedge_case(folder, template="case_of_foam", **keys):
    """The wedge on few cells. `keys` are of [solver]."""
    folder.mkdir(parents=True)
    shutil.copy(ROOT / "cases" / "wedge" / "wedge.geom", folder)
    text = (ROOT / "cases" / "openfoam_wedge" / "case.toml").read_text()
    text = text[:text.index("[solver]")].replace("../wedge/", "")
    lines = "".join(f"{key} = {json.dumps(value)}\n" for key, value in keys.items())
    case = folder / "case.toml"
    case.write_text(text + f'[solver]\nkind = "openfoam"\ntemplate = "{template}"\n{lines}')
    foam = folder / template
    for part in ("0", "constant", "system"):
        (foam / part).mkdir(parents=True)
    (foam / "system" / "controlDict").write_text(CONTROL)
    (foam / "0" / "rho").write_text(FIELD)
    return case


COARSE = ["--set", "spacing.min=0.1", "--set", "spacing.max=0.2", "--set", "adapt.min=0.02"]


def check_copies(program, folder):
    """The run's folder inside the template, and a former one."""
    case = wedge_case(folder / "copies", ".")
    top = case.parent
    adapt(program, case, top / "former" / "run", options=[*COARSE, "--cycles", "0"])
    adapt(program, case, top / "constant" / "run", options=[*COARSE, "--cycles", "1"])
    for copy in (top / "constant" / "run" / f"cycle_{k:02d}" / "openfoam" for k in (0, 1)):
        found = sorted(str(path.relative_to(copy)) for path in copy.rglob("*") if path.is_file() and "polyMesh" not in str(path))
        require(found == ["0/rho", "7/rho", "7/yPlus", "case.toml", "system/controlDict", "wedge.geom"], f"copied: {found}")
    records = [json.loads((top / "constant" / "run" / f"cycle_{k:02d}" / "record.json").read_text()) for k in (0, 1)]
    require(records[0]["template_digest"] == records[1]["template_digest"], "the run counts as a part of its template")
    adapt(program, case, top / "constant" / "run", options=[*COARSE, "--cycles", "2", "--resume"])


def check_refusals(program, folder):
    def expect(name, parts, change):
        case = wedge_case(folder / name)
        change(case.parent / "case_of_foam")
        out = folder / (name + ".out")
        expect_refusal(program, 1, parts, "adapt", case, "-o", out, *COARSE)
        require(not out.exists(), f"{name}: a refused case has left a folder")

    def control(old, new):
        def change(foam):
            require(old in CONTROL, old)
            (foam / "system" / "controlDict").write_text(CONTROL.replace(old, new))
        return change

    expect("dangling", ["constant/old", "broken link"], lambda foam: (foam / "constant" / "old").symlink_to("nowhere"))
    expect("circle", ["constant/self", "contains it"], lambda foam: (foam / "constant" / "self").symlink_to(foam / "constant"))
    expect("no_application", ["controlDict", "names no application"], control("application   standInFoam;", ""))
    expect("binary", ["controlDict: writeFormat is binary"], control("writeFormat   ascii", "writeFormat binary"))
    expect("compressed", ["controlDict: writeCompression is on"], control("writeCompression off", "writeCompression yes"))
    expect("gzip", ["0/rho.gz", "gunzip"], lambda foam: (foam / "0" / "rho.gz").write_text("?"))
    expect("included", ["0/rho", "has no internalField"], lambda foam: (foam / "0" / "rho").write_text(FIELD.replace("internalField uniform 1;", '#include "one"')))


def check_errors(program, folder):
    case = wedge_case(folder / "errors")
    (case.parent / "case_of_foam" / "fault").write_text("fatal")
    expect_refusal(program, 3, ["the solver 'standInFoam' of cycle 0", "FOAM FATAL IO ERROR: Cannot find patchField entry for square file: 0/p"],
                   "adapt", case, "-o", folder / "fatal", *COARSE)
    case = wedge_case(folder / "variable")
    expect_refusal(program, 1, ["adapt.variable", "'T'", "rho"], "adapt", case, "-o", folder / "other", *COARSE, "--set", 'adapt.variable="T"')


def check_mpirun(program, folder):
    """As root, and on more ranks than there are cores, where neither quadloop's user nor its own mpirun has said that this may be."""
    case = wedge_case(folder / "ranks", ranks=os.cpu_count() + 3)
    allrun = case.parent / "case_of_foam" / "Allrun"
    allrun.write_text(f"#!/bin/sh\nset -e\n{MPIRUN} -n $1 true\nstandInFoam\n")
    allrun.chmod(0o755)
    kept = {name: os.environ.pop(name) for name in list(os.environ) if name.startswith(("OMPI_ALLOW", "OMPI_MCA_rmaps", "PRTE_MCA"))}
    adapt(program, case, folder / "of_ranks", options=[*COARSE, "--cycles", "0"])
    os.environ.update(kept)


def check_y_plus(program, folder):
    """The stand-in has the same y+ in the middle of each cell at the wall, whatever its height: heights become those of the y+ that is wanted."""
    case = wedge_case(folder / "follow")
    text = case.read_text().replace('[boundary.ramp]\nbc = "wall"', '[boundary.ramp]\nbc = "wall"\nlayers = { first = "yplus:1", growth = 1.2, count = 4 }')
    case.write_text(text)
    options = [*COARSE, "--cycles", "1", "--set", "flow.reynolds=20000", "adapt.refine=100", "adapt.coarsen=100"]
    adapt(program, case, folder / "followed", options=options)
    heights = [json.loads((folder / "followed" / f"cycle_{k:02d}" / "record.json").read_text())["first_heights"]["ramp"] for k in (0, 1)]
    least, before = heights[1][0], heights[0][0]
    require(math.isclose(least, before / (2 * Y_PLUS), rel_tol=0.05), f"first heights: {heights}")


def check_end(program, folder):
    case = wedge_case(folder / "end")
    said = run([program, "adapt", case, "-o", folder / "ended", *COARSE, "--set", "adapt.max_nodes=20", "--cycles", "1"])
    require("after cycle 0 no cell is refined or coarsened, so the run ends: adapt.max_nodes = 20 is reached" in said, said)


Y_PLUS = 2.0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", default=str(ROOT / "build" / "release" / "app" / "quadloop"))
    program = parser.parse_args().quadloop
    with tempfile.TemporaryDirectory(prefix="quadloop_openfoam_case_") as name:
        folder = Path(name)
        stand_in = folder / "bin" / "standInFoam"
        stand_in.parent.mkdir()
        stand_in.write_text(SOLVER.replace("Y_PLUS", repr(Y_PLUS)))
        stand_in.chmod(0o755)
        os.environ["PATH"] = f"{stand_in.parent}:{os.environ['PATH']}"
        for check in (check_copies, check_refusals, check_errors, check_mpirun, check_y_plus, check_end):
            check(program, folder)


if __name__ == "__main__":
    main()
