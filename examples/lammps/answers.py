# SPDX-License-Identifier: GPL-2.0-or-later
"""What tests of DEM adapters share: materials, and the library's answers to compare a DEM code
with.

From the environment: RESTITUTE (the command).
"""
import csv
import json
import os
import subprocess
import sys

RESTITUTE = os.environ["RESTITUTE"]
MATERIALS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "src", "materials")


def check(is_so, message):
    """Ends the test with the message if it is not so."""
    if not is_so:
        sys.exit("failed: " + message)


def material(name, **values):
    """Writes NAME.json in the current directory and returns its name."""
    values = {"name": name, "poisson_ratio": 0.5} | values
    with open(name + ".json", "w") as out:
        json.dump(values, out)
    return name + ".json"


def library_pairs(cases):
    """Results of the command, one dictionary of numbers a case, by the method sync."""
    names = sorted({name for case in cases for name in case})
    with open("cases.csv", "w", newline="") as out:
        rows = csv.DictWriter(out, names)
        rows.writeheader()
        rows.writerows(cases)
    subprocess.run([RESTITUTE, "pair", "--input", "cases.csv", "--method", "sync", "--tolerance", "1e-5",
                    "--output", "results.csv"], check=True)
    with open("results.csv") as results:
        found = list(csv.DictReader(line for line in results if not line.startswith("#")))
    return [{name: float(row[name]) for name in ("ez", "ex", "contact_time", "max_indentation")} for row in found]
