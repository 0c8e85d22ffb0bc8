#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A long run of LAMMPS with pair_style restitute, restarted ten times (docs/records/extremes.md):

    long_dem.py BUILT DIRECTORY [--steps 10010000] [--beads 500] [--ranks 1] [--report]

BUILT is what examples/lammps/build.sh made. Beads are poured into a tube, shaken, left alone,
shaken again and left alone. Each of eleven processes goes on from the restart file of the one
before it; a second call goes on where the first was stopped. --report looks at what is there.
"""
import argparse
import filecmp
import itertools
import math
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
PARTS = 11
EVERY, PERIOD = 1000, 60000
COLUMNS = "step atoms kinetic mechanical stored friction dashpots input steps contacts".split()
# Of the energy lost or brought in since the process began: the trapezoidal rule of the contacts'
# ledger, as in examples/lammps/tests/test_energy.py.
LEDGER = 0.01
# What moves and what is stored falls in every 1000 steps of a tube at rest, but for the rounding of
# the sums over all beads.
ROUNDING = 1e-12


def windows(steps):
    """Of the two shakes: first step, number of whole periods."""
    return [(int(first * steps), int(length * steps) // PERIOD)
            for first, length in ((0.8, 5), (5.9, 4.6))]


def overlap(steps):
    """Steps after the end of a part that the next process makes, too."""
    return steps // 20 // EVERY * EVERY


def command(args, part):
    steps = args.steps // PARTS
    (begin1, periods1), (begin2, periods2) = windows(steps)
    values = {"plugin": args.built / "restituteplugin.so", "part": part, "steps": steps,
              "bead": HERE.parents[1] / "examples/lammps/bead.json", "beads": args.beads,
              "every": EVERY, "period": PERIOD, "overlap": overlap(steps),
              "begin1": begin1, "periods1": periods1, "begin2": begin2, "periods2": periods2}
    venv = args.built / "venv/bin"
    words = [venv / "mpiexec", "-n", args.ranks, venv / "lmp", "-in", HERE / "in.long", "-nocite",
             "-screen", "none", "-log", f"part.{part}.log"]
    return list(map(str, itertools.chain(words, *(("-var", *pair) for pair in values.items()))))


def report_part(directory, part, args):
    """Prints what a part did; its last step, its intervals at rest, and what is wrong."""
    steps, beads = args.steps // PARTS, args.beads
    shaken = [(begin, begin + PERIOD * periods) for begin, periods in windows(steps)]
    log = directory / f"part.{part}.log"
    text = log.read_text() if log.exists() else ""
    found = {}  # by step: one that two runs print counts once
    for words in map(str.split, text.splitlines()):
        if len(words) == len(COLUMNS) and words[0].isdigit() and int(words[1]) == beads:
            found.setdefault(int(words[0]), dict(zip(COLUMNS, map(float, words))))
    rows, faults = list(found.values()), []
    if len(rows) < 2:
        return 0, 0, [f"part {part}: {len(rows)} rows"]
    first, last = rows[0], rows[-1]
    moved, worst, gain, scale, rests = 0.0, 0.0, -math.inf, 0.0, 0
    for before, row in zip(rows, rows[1:]):
        moved += row["input"]
        lost = row["friction"] + row["dashpots"] - first["friction"] - first["dashpots"]
        scale = max(scale, lost, abs(moved))
        has = row["mechanical"] + row["stored"]
        worst = max(worst, abs(has + lost - moved - first["mechanical"] - first["stored"]))
        if not any(begin < row["step"] and before["step"] < end for begin, end in shaken):
            rests += 1
            gain = max(gain, has - before["mechanical"] - before["stored"])
        if row["friction"] < before["friction"] or row["dashpots"] < before["dashpots"]:
            faults.append(f"part {part}, step {row['step']:.0f}: a loss falls")
    whole, again = (directory / f"{name}.{part - 1}.restart" for name in ("whole", "again"))
    same = filecmp.cmp(whole, again, shallow=False) if whole.exists() and again.exists() else None
    memory = re.findall(r"Maximum resident set size:? *([\d.]+)", text)
    print(f"part {part}: to step {last['step']:.0f}, {last['contacts']:.0f} new contacts, "
          f"restarted with the same bits: {same}, lost {scale:.3e} J, "
          f"ledger off by {worst:.1e} J, largest change in 1000 steps at rest {gain:.1e} J, "
          f"kinetic {last['kinetic']:.1e} J, memory {memory} MB")
    wrong = {
        f"ends at step {last['step']:.0f}": last["step"] < part * steps + overlap(steps),
        "not compared with the process that went on": same is None and part > 1,
        "the restarted process is not the one that went on": same is False,
        f"energy is created at rest, {gain:.1e} J": gain > ROUNDING * last["mechanical"],
        "the ledger does not close": worst > LEDGER * scale + 1e-12 * last["mechanical"]}
    faults += [f"part {part}: {what}" for what, found in wrong.items() if found]
    return last["step"], rests, faults


def main():
    raw = argparse.RawTextHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=raw)
    parser.add_argument("built", type=lambda text: Path(text).resolve())
    parser.add_argument("directory", type=Path)
    for name, value in ("steps", 10010000), ("beads", 500), ("ranks", 1):
        parser.add_argument(f"--{name}", type=int, default=value)
    parser.add_argument("--report", action="store_true")
    args = parser.parse_args()
    args.directory.mkdir(parents=True, exist_ok=True)
    step, rests, faults = 0, 0, []
    for part in range(1, PARTS + 1):
        if not args.report and not (args.directory / f"whole.{part}.restart").exists():
            subprocess.run(command(args, part), cwd=args.directory, check=True)
        last, found, wrong = report_part(args.directory, part, args)
        step, rests, faults = max(step, last), rests + found, faults + wrong
    if rests == 0:
        faults.append("no interval at rest")
    print(f"{step:.0f} steps;", "; ".join(faults) or "no fault")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
