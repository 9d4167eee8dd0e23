"""cases/naca_design/design.ipynb, executed: it has the code of design.py, all cells run, drag falls at constant lift, and the pictures are in its output.

    notebook_test.py CASE_FOLDER OUT_FOLDER [--update]     # --update writes the notebook from the script
"""
import base64
import json
import re
import subprocess
import sys
from pathlib import Path

SKIPPED = 77
case, out = map(Path, sys.argv[1:3])
script, notebook = case / "design.py", case / "design.ipynb"


def sections(text):
    """(heading, code) of each part of a script that begins with `# %%`."""
    return [(heading.strip(), code.strip()) for heading, code in re.findall(r"^# %%(.*?)\n(.*?)(?=^# %%|\Z)", text, re.M | re.S)]


def made_from(text):
    cells = []
    for number, (heading, code) in enumerate(sections(text)):
        cells.append({"cell_type": "markdown", "id": f"text-{number}", "metadata": {}, "source": heading})
        cells.append({"cell_type": "code", "execution_count": None, "id": f"code-{number}", "metadata": {}, "outputs": [], "source": code})
    kernel = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}, "language_info": {"name": "python"}}
    return {"cells": cells, "metadata": kernel, "nbformat": 4, "nbformat_minor": 5}


def executed():
    out.mkdir(parents=True, exist_ok=True)
    subprocess.run([sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--ExecutePreprocessor.timeout=1200", "--output-dir", out,
                    "--output", "executed", notebook], check=True, cwd=out)
    return json.loads((out / "executed.ipynb").read_text())


def check_outputs(cells):
    code = [cell for cell in cells if cell["cell_type"] == "code"]
    assert all(cell["execution_count"] for cell in code), "a cell did not run"
    outputs = [output for cell in code for output in cell["outputs"]]
    assert not any(output["output_type"] == "error" for output in outputs), outputs
    pictures = [base64.b64decode(output["data"]["image/png"]) for output in outputs if "image/png" in output.get("data", {})]
    assert len(pictures) == 2 and all(len(picture) > 10000 for picture in pictures), [len(picture) for picture in pictures]
    for number, picture in enumerate(pictures):
        (out / f"picture_{number}.png").write_bytes(picture)
    said = "".join("".join(output["text"]) for output in outputs if output["output_type"] == "stream" and output["name"] == "stdout")
    print(said)
    rows = [tuple(map(float, row)) for row in re.findall(r"cd (\S+)  cl (\S+)  alpha", said)]
    best_drag, best_lift = min(row for row in rows if abs(row[1] / rows[0][1] - 1) < 2e-3)
    assert best_drag < 0.25 * rows[0][0], (rows[0], best_drag, best_lift)
    assert len(rows) <= 60, f"{len(rows)} flows"


if "--update" in sys.argv:
    notebook.write_text(json.dumps(made_from(script.read_text()), indent=1) + "\n")
    sys.exit()
try:
    import ipykernel  # noqa: F401
    import matplotlib  # noqa: F401
    import nbconvert  # noqa: F401
    import scipy  # noqa: F401
except ImportError as error:
    print(f"SKIPPED: {error}")
    sys.exit(SKIPPED)
stored = json.loads(notebook.read_text())
assert notebook.stat().st_size < 60000, "the notebook is too large"
assert stored == made_from(script.read_text()), "design.ipynb is not design.py: run notebook_test.py with --update"
check_outputs(executed()["cells"])
