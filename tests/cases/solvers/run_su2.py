#!/usr/bin/env python3
"""The loop with SU2 as its solver, by a program that stands in for it (su2_stand_in.py): both kinds of restart files, a start from the flow carried over,
forces from the history and along walls, the same files on any number of ranks; and the cases for SU2 ask for conditions on the boundaries that their meshes have.

    run_su2.py --quadloop PROGRAM
"""
import argparse
import json
import shutil
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from adapt_runs import adapt, attempt, require, require_same_folders
from quadloop_runs import ROOT

STAND_IN = Path(__file__).resolve().parent / "su2_stand_in.py"
CONFIG = """% A comment
SOLVER= EULER
MARKER_EULER= ( wedge, lid )
MARKER_SUPERSONIC_INLET= ( inlet, 1.0 )
MARKER_OUTLET= ( outlet, 1.0 )
MESH_FILENAME= other.su2   % to be replaced
OUTPUT_FILES= ( {files} )
GAMMA_VALUE= 1.4
CFL_NUMBER= 10
"""


def wedge_case(folder, files):
    """The wedge with SU2 in the place of the built-in solver, few cycles."""
    folder.mkdir()
    given = ROOT / "cases" / "wedge"
    for outline in given.glob("*.geom"):
        (folder / outline.name).write_text(outline.read_text())
    text = (given / "case.toml").read_text()
    head = text[:text.index("[solver]")].replace("cycles = 5", "cycles = 3")
    names = [line.split("[boundary.")[1].split("]")[0] for line in head.splitlines() if line.startswith("[boundary.")]
    (folder / "flow.cfg").write_text(CONFIG.format(files=files).replace("( wedge, lid )", "( " + ", ".join(names) + " )"))
    case = folder / "case.toml"
    case.write_text(head + f"""[flow]
speed = 2.0
pressure = 0.7142857142857143

[solver]
kind = "su2"
template = "flow.cfg"
command = ["{sys.executable}", "{STAND_IN}", "su2.cfg"]
warm = {{ cfl_number = 1000, CFL_ADAPT_PARAM = "( 0.5, 1.04 )" }}
""")
    return case


def check_cycles(made, restart, cycles):
    records = [json.loads((made / f"cycle_{k:02d}" / "record.json").read_text()) for k in range(cycles + 1)]
    require(records[-1]["nodes"] > 1.5 * records[0]["nodes"], f"the shock did not refine: {[r['nodes'] for r in records]}")
    for k, record in enumerate(records):
        folder = made / f"cycle_{k:02d}"
        require(abs(record["cl"] - 0.301) < 1e-12 and abs(record["cd"] - 0.021) < 1e-12, f"cycle {k}: forces are not those of the history: {record}")
        require(abs(record["residual"] / 1e-3 - 1) < 1e-12 and record["log_residual"] == -5, f"cycle {k}: residual {record['residual']}")
        require((folder / restart).exists(), f"cycle {k} has no {restart}")
        config = (folder / "su2.cfg").read_text().splitlines()
        require(("CFL_NUMBER= 1000" in config) == (k > 0) and ("CFL_NUMBER= 10" in config) == (k == 0), f"cycle {k}: {config}")
        require(("CFL_ADAPT_PARAM= ( 0.5, 1.04 )" in config) == (k > 0), f"cycle {k}: {config}")
        log = (folder / "solver.log").read_text()
        require(log == ("started from nothing\n" if k == 0 else "started from Density Momentum_x Momentum_y Energy\n"), f"cycle {k}: {log}")
        ramp = record["forces"]["ramp"]
        pressure = (1.706579 - 1) / (0.5 * 1.4 * 2 ** 2)
        require(abs(ramp["cl"] / -pressure - 1) < 0.05 and abs(ramp["cd"] / (pressure * 0.176327) - 1) < 0.05, f"cycle {k}: forces on the ramp: {ramp}")
        rows = (folder / "mesh.walls.csv").read_text().splitlines()
        require(rows[0] == "boundary,s,x,y,Cp,Mach" and abs(float(rows[len(rows) // 2].split(",")[4]) - pressure) < 1e-3, f"cycle {k}: {rows[:2]}")
        head = next(line for line in (folder / "mesh.mesh").read_text().splitlines() if line.startswith("#names"))
        require(head.split()[1:] == ["Density", "Momentum_x", "Momentum_y", "Energy", "x_velocity", "y_velocity", "pressure", "mach", "total_pressure"], head)


def check_refusals(program, folder):
    case = wedge_case(folder / "refused", "PARAVIEW")
    status, said = attempt(program, "adapt", case, "-o", folder / "out")
    require(status == 1 and "flow.cfg: OUTPUT_FILES names neither RESTART" in said, f"{status} {said}")
    config = folder / "refused" / "flow.cfg"
    config.write_text("SOLVER= EULER\nSOLVER= RANS\n")
    status, said = attempt(program, "adapt", case, "-o", folder / "out")
    require(status == 1 and "flow.cfg:2: SOLVER is there twice" in said, f"{status} {said}")
    config.unlink()
    status, said = attempt(program, "adapt", case, "-o", folder / "out")
    require(status == 1 and "flow.cfg" in said, f"{status} {said}")
    text = case.read_text()
    for entry in ("mesh_filename", "RESTART_SOL"):
        case.write_text(text.replace("cfl_number", entry))
        status, said = attempt(program, "adapt", case, "-o", folder / "out")
        require(status == 1 and f"{entry}' is set by quadloop in each cycle" in said, f"{status} {said}")
    case.write_text(text.replace('template = "flow.cfg"\n', ""))
    status, said = attempt(program, "adapt", case, "-o", folder / "out")
    require(status == 1 and "'solver.template' is missing" in said, f"{status} {said}")
    config.write_text(CONFIG.format(files="RESTART"))
    case.write_text(text)
    status, said = attempt(program, "adapt", case, "-o", folder / "out")
    require(status == 3 and "solver.log has: marker" in said and "has no condition" in said, f"a marker without a condition: {status} {said}")
    require("MPI_ABORT" not in said, f"a launcher's last line: {said}")


def check_unconverged(program, folder):
    """A flow that ends at the limit of iterations is told, and does not settle the run."""
    case = wedge_case(folder / "unconverged", "RESTART")
    config = folder / "unconverged" / "flow.cfg"
    given = config.read_text()
    for goal, converged in (("-5", True), ("-6", False)):
        config.write_text(given + f"ITER= 4\nCONV_RESIDUAL_MINVAL= {goal}\n")
        made = folder / f"unconverged_{converged}"
        status, said = attempt(program, "adapt", case, "-o", made, "--cycles", "2", "--set", "adapt.until.cl=0.1")
        require(status == 0, said)
        told = "SU2 reached its limit of iterations (ITER= 4) before it converged; its residual is 10^-5.00, and CONV_RESIDUAL_MINVAL= -6."
        require((told in said) != converged, said)
        record = json.loads((made / "cycle_01" / "record.json").read_text())
        require(record["converged"] is converged and record["log_residual"] == -5 and record["settled"] is converged, f"{record}")
        require((made / "cycle_02").exists() != converged, f"the run ends after {sorted(made.iterdir())}")


def check_diverged(program, folder):
    """A flow that diverges is run again with lower CFL numbers, once."""
    case = wedge_case(folder / "diverged", "RESTART")
    config = folder / "diverged" / "flow.cfg"
    given = config.read_text()
    told = "SU2 diverged in this cycle and was run again with a tenth of the CFL numbers"
    for stable, repeats in ((10, [False, True]), (1, [True, True])):
        config.write_text(given + f"STABLE_CFL= {stable}\n")
        made = folder / f"diverged_{stable}"
        status, said = attempt(program, "adapt", case, "-o", made, "--cycles", "1")
        require(status == 0 and told in said, f"{status} {said}")
        for k, repeated in enumerate(repeats):
            used = (made / f"cycle_{k:02d}" / "su2.cfg").read_text().splitlines()
            require(("CFL_NUMBER= 1" in used) == repeated, f"cycle {k}: {used}")
    config.write_text(given + "STABLE_CFL= 0.5\n")
    status, said = attempt(program, "adapt", case, "-o", folder / "diverged_twice", "--cycles", "1")
    require(status == 3 and "SU2 has diverged" in said and told not in said, f"{status} {said}")


def check_finish(program, folder):
    """A second run in each cycle, from the solution of the first one; if it diverges, the cycle has the flow of the first one."""
    case = wedge_case(folder / "finish", "RESTART")
    with open(folder / "finish" / "flow.cfg", "a") as config:
        config.write("STABLE_CFL= 2000\n")
    with open(case, "a") as text:
        text.write('finish = { MUSCL_TURB = "YES" }\n')
    for ranks in (1, 3):
        adapt(program, case, folder / f"finished_{ranks}", ranks=ranks, options=["--cycles", "1"])
    made = folder / "finished_1"
    require_same_folders(made, folder / "finished_3", "a second run on 3 ranks")
    for k in range(2):
        used = (made / f"cycle_{k:02d}" / "su2.cfg").read_text().splitlines()
        require("MUSCL_TURB= YES" in used and "CFL_NUMBER= 1000" in used and "RESTART_SOL= YES" in used, f"cycle {k}: {used}")
        log = (made / f"cycle_{k:02d}" / "solver.log").read_text()
        require(log == "started from Density Momentum_x Momentum_y Energy\n", f"cycle {k}: {log}")
    told = "SU2 diverged in the second run of this cycle"
    growing = ["solver.finish.RESIDUAL_CHANGE=0.5", "solver.finish.CONV_RESIDUAL_MINVAL=-6", "solver.finish.ITER=4"]
    for name, settings in (("stopped", ["solver.finish.CFL_NUMBER=3000"]), ("growing", growing)):
        status, said = attempt(program, "adapt", case, "-o", folder / name, "--cycles", "0", "--set", *settings)
        require(status == 0 and told in said, f"{status} {said}")
        kept, whole = ((folder / made / "cycle_00" / "mesh.mesh").read_bytes() for made in (name, "finished_1"))
        require(kept == whole, f"{name}: the flow of the first run is not kept")
        record = json.loads((folder / name / "cycle_00" / "record.json").read_text())
        require(record["log_residual"] == -5, f"{name}: {record['log_residual']} is not the residual of the first run")


def check_no_su2(program, folder):
    """Without a command, on a machine without SU2."""
    case = wedge_case(folder / "no_su2", "RESTART")
    case.write_text(case.read_text().split("command =")[0])
    status, said = attempt(program, "adapt", case, "-o", folder / "made_without")
    require(status == 1 and "[solver] has no command, so SU2_CFD is run: the program 'SU2_CFD' is in no folder of PATH" in said, f"{status} {said}")


def check_resume(program, folder):
    """A changed configuration is told, by its name; the cycles that are there stay."""
    case, made = wedge_case(folder / "resumed", "RESTART"), folder / "resumed_run"
    adapt(program, case, made, options=["--cycles", "1"])
    before = (made / "cycle_01" / "record.json").read_text()
    require('"template_digest": "' in before and '"solver.template/flow.cfg": "' in before, before)
    status, said = attempt(program, "adapt", case, "-o", made, "--resume", "--cycles", "2")
    require(status == 0 and "flow.cfg" not in said, f"the same configuration: {status} {said}")
    with open(folder / "resumed" / "flow.cfg", "a") as config:
        config.write("ITER= 3\n")
    status, said = attempt(program, "adapt", case, "-o", made, "--resume", "--cycles", "3")
    told = "the file 'flow.cfg' of solver.template has changed; the cycles up to cycle_02 remain unchanged"
    require(status == 0 and told in said, f"another configuration: {status} {said}")
    require((made / "cycle_01" / "record.json").read_text() == before, "a whole cycle has changed")
    digests = [json.loads((made / f"cycle_{k:02d}" / "record.json").read_text())["template_digest"] for k in range(4)]
    require(len(set(digests[:3])) == 1 and digests[3] != digests[0], f"digests {digests}")
    command = json.dumps(["sh", "-c", f"{sys.executable} {STAND_IN} su2.cfg && echo % >> {folder / 'resumed' / 'flow.cfg'}"])
    adapt(program, case, folder / "edited", options=["--cycles", "2", "--set", f"solver.command={command}"])
    digests = {json.loads((folder / "edited" / f"cycle_{k:02d}" / "record.json").read_text())["template_digest"] for k in range(3)}
    require(len(digests) == 3, f"a configuration that changes while the loop runs: {digests}")


def check_cases(program, folder):
    """Their configurations on their first meshes."""
    cases = ROOT / "cases"
    for given in [*sorted(cases.glob("su2_*")), *sorted(cases.glob("*_rans")), cases / "crm_hl_section"]:
        command = json.dumps([sys.executable, str(STAND_IN), "su2.cfg"])
        adapt(program, given / "case.toml", folder / given.name, options=["--cycles", "0", "--set", f"solver.command={command}"])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quadloop", type=Path, required=True)
    program = parser.parse_args().quadloop.resolve()
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for files, restart in (("RESTART, PARAVIEW", "restart.dat"), ("RESTART_ASCII", "restart.csv")):
            case = wedge_case(folder / restart, files)
            made = folder / f"made_{restart}"
            adapt(program, case, made)
            check_cycles(made, restart, 3)
            adapt(program, case, folder / f"on_3_{restart}", ranks=3)
            require_same_folders(made, folder / f"on_3_{restart}", "on 3 ranks")
        check_refusals(program, folder)
        check_unconverged(program, folder)
        check_diverged(program, folder)
        check_finish(program, folder)
        if shutil.which("SU2_CFD") is None:
            check_no_su2(program, folder)
        check_resume(program, folder)
        check_cases(program, folder)
    print("the loop with SU2's stand-in: both kinds of restart files, 1 and 3 ranks, refusals, cases")


main()
