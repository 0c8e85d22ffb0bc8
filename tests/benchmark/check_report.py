# SPDX-License-Identifier: BSD-3-Clause
"""A short report, and whether its numbers are possible: check_report.py PROGRAMS DOCS [--cvode]

The working directory is used up. Times are not looked at.
"""
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import report
from scenes import map_scenes, rows_of, runs_of, standard_scenes

programs, docs = Path(sys.argv[1]), Path(sys.argv[2])
PAGES = ("records/bench.md", "records/omissions.md", "records/stability.md", "records/table.md",
         "dem.md")
for page in PAGES:
    Path("docs", page).parent.mkdir(parents=True, exist_ok=True)
    shutil.copy(docs / page, Path("docs", page))
Path("docs/figures").mkdir(exist_ok=True)
subprocess.run([sys.executable, "-B", report.__file__, programs, "csv", "--docs", "docs", "--quick",
                *sys.argv[3:]], check=True)

# Every run is a pair within its bounds. The paper's algorithm may gain energy by its error in time:
# with 128 steps, the fewest here, paper-forward returns e_z = 1.045 for 1.
runs = runs_of("csv/runs.csv", standard_scenes(report.DATA, quick=True))
library = np.isin(runs.method, ("euler", "sync", "cvode"))
gain = np.where(library, 1e-6, 0.05)
assert len(runs.ez) > 300 and all(runs.solved) and all(runs.seconds > 0)
assert all((runs.ez >= -1e-6) & (runs.ez <= 1 + gain) & (abs(runs.ex) <= 1 + gain))
assert all(runs.error[library] <= (runs.tolerance + runs.unsure)[library])


def error_of(method, setting):
    chosen = (runs.scene == "truth-10") & (runs.method == method) & (runs.setting == setting)
    (error,) = runs.error[chosen]
    return error


# The paper's algorithm is of first order where elements and steps are doubled: grids are coarse, so
# for a factor of 4 one within a third. With velocities from before the step it is far worse.
fine = error_of(report.PAPER, "64 x 4096")
assert 3 < error_of(report.PAPER, "16 x 1024") / fine < 5.3
assert error_of("paper-forward", "64 x 4096") > 3 * fine

# Velocity Verlet goes through the positions of Euler with positions first: they differ by rounding.
euler, verlet = (runs.method == report.PAPER), (runs.method == "paper-verlet")
assert all(runs.setting[euler] == runs.setting[verlet])
assert max(abs(runs.ez[euler] - runs.ez[verlet])) < 1e-10
assert max(abs(runs.ex[euler] - runs.ex[verlet])) < 1e-10

assert all(float(row["ratio"]) > 0 for row in rows_of("csv/omissions.csv"))

# 4 x 4 places and 3 numbers of steps: no method of the library is wrong, and ten steps are too long
# somewhere.
cells = runs_of("csv/stability.csv", map_scenes(quick=True))
found = set(zip(cells.method, cells.steps_asked, report.verdicts(cells, 60)))
assert sum(cells.method != "reference") == 3 * 3 * 16
assert "wrong" not in {verdict for _, _, verdict in found}
assert {(report.PAPER, 10, "unstable"), ("euler", 10, "refused")} <= found

for name in ("work_precision", "omissions", "stability"):
    assert "<path" in Path("docs/figures", f"{name}.svg").read_text(encoding="utf-8"), name
for page in PAGES:
    assert Path("docs", page).read_bytes() != (docs / page).read_bytes(), page
