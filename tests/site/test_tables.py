# SPDX-License-Identifier: BSD-3-Clause
"""The tables of the site and the program that reads them, beside the library: test_tables.py SITE

SITE is docs/site. Without node the program is not run.
"""
import json
import shutil
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np

import restitute

site = Path(sys.argv[1])
sys.path.insert(0, str(site))
import tables  # noqa: E402

SOLIDS = {
    "elastic": restitute.Material.elastic(1e9, 0.3),
    "standard solid": restitute.Material.standard_solid(1e6, 3e6, 300.0, 0.4, density=1100),
    "Kelvin-Voigt": restitute.Material.kelvin_voigt(1e6, 50.0),
    "two terms": restitute.Material.prony([1e-4, 1e-2], [5e6, 1e6], 1e6, density=1000),
}
# Above it a curve looks wrong: a line of the figure is this wide.
WIDE = 5e-3
RUN = """
const { evaluate } = require(process.argv[1]);
const { table, impacts } = JSON.parse(require("fs").readFileSync(0, "utf8"));
process.stdout.write(JSON.stringify(impacts.map((impact) => evaluate(table, impact))));
"""


def by_node(table, impacts):
    """What impact.js says of each impact."""
    rows = [dict(zip(impacts, map(float, row))) for row in zip(*impacts.values())]
    done = subprocess.run(["node", "-e", RUN, str(site.resolve() / "impact.js")], check=True, text=True,
                          capture_output=True, input=json.dumps({"table": table, "impacts": rows}))
    return json.loads(done.stdout)


def check(name, material, node):
    table = json.loads(json.dumps(tables.table_of(material), allow_nan=False))
    impacts = tables.random_impacts(200, 1, table["density"])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", restitute.ModelLimitWarning)
        exact = restitute.pair(material, method="sync", tolerance=1e-4, threads=0, **impacts)
    ez, ex = tables.look_up(table, **impacts)
    worst = {"ez": np.max(np.abs(ez - exact.ez)), "ex": np.max(np.abs(ex - exact.ex))}
    print(f"{name}: errors {worst['ez']:.2g} and {worst['ex']:.2g}, stated {table['error']}")
    for key, error in worst.items():
        assert error <= table["error"][key] <= WIDE, (name, key)
    if not node:
        return
    rows = by_node(table, impacts)
    # Both add the same numbers in another order.
    assert max(abs(row["ez"] - one) for row, one in zip(rows, ez)) < 1e-12
    assert max(abs(row["ex"] - one) for row, one in zip(rows, ex)) < 1e-12
    # Smooth along log T, as e_z is: 1 % is far below the width of a line of the shaded region.
    for key in ("radius_ratio", "speed_ratio", "displacement_ratio", "contact_time"):
        found = np.array([row[key] for row in rows], float)
        np.testing.assert_allclose(found, getattr(exact, key), rtol=1e-2, atol=1e-12, err_msg=f"{name}, {key}")


def main():
    node = shutil.which("node")
    for name, material in SOLIDS.items():
        check(name, material, node)
    if not node:
        print("skipped: no node (Debian: nodejs), so impact.js did not run")


main()
