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
import math
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
PARTS = 11
EVERY, PERIOD = 1000, 60000
COLUMNS = "step atoms kinetic mechanical stored friction dashpots input steps contacts"
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


def command(args, part):
    steps = args.steps // PARTS
    values = {"plugin": args.built / "restituteplugin.so", "part": part, "steps": steps,
              "bead": HERE.parents[1] / "examples/lammps/bead.json", "beads": args.beads,
              "every": EVERY, "period": PERIOD, "overlap": steps // 20 // EVERY * EVERY}
    for k, (begin, periods) in enumerate(windows(steps), 1):
        values |= {f"begin{k}": begin, f"periods{k}": periods}
    venv = args.built / "venv/bin"
    words = [venv / "mpiexec", "-n", args.ranks, venv / "lmp", "-in", HERE / "in.long", "-nocite",
             "-screen", "none", "-log", f"part.{part}.log"]
    for name, value in values.items():
        words += ["-var", name, value]
    return [str(word) for word in words]


def rows_of(directory, part):
    """Lines of the log by step; a step that two runs print counts once."""
    text = (directory / f"part.{part}.log").read_text()
    found = {}
    for line in text.splitlines():
        words = line.split()
        if len(words) == len(COLUMNS.split()) and re.fullmatch(r"\d+", words[0]):
            row = dict(zip(COLUMNS.split(), map(float, words)))
            found.setdefault(int(row["step"]), row)
    return list(found.values()), text


def report(args):
    steps, beads = args.steps // PARTS, args.beads
    shaken = [(begin, begin + PERIOD * periods) for begin, periods in windows(steps)]
    faults, last = [], None
    for part in range(1, PARTS + 1):
        if not (args.directory / f"part.{part}.log").exists():
            break
        rows, text = rows_of(args.directory, part)
        rows = [row for row in rows if row["atoms"] == beads]
        if len(rows) < 2:
            continue
        whole, again = (args.directory / f"{name}.{part - 1}.restart"
                        for name in ("whole", "again"))
        same = filecmp.cmp(whole, again, shallow=False) if again.exists() else None
        first, moved, worst, gain, scale = rows[0], 0.0, 0.0, -math.inf, 0.0
        for before, row in zip(rows, rows[1:]):
            moved += row["input"]
            lost = row["friction"] + row["dashpots"] - first["friction"] - first["dashpots"]
            scale = max(scale, lost, abs(moved))
            has = row["mechanical"] + row["stored"]
            worst = max(worst, abs(has + lost - moved - first["mechanical"] - first["stored"]))
            if not any(begin < row["step"] and before["step"] < end for begin, end in shaken):
                gain = max(gain, has - before["mechanical"] - before["stored"])
            if row["friction"] < before["friction"] or row["dashpots"] < before["dashpots"]:
                faults.append(f"part {part}, step {row['step']:.0f}: a loss falls")
        memory = re.findall(r"Maximum resident set size:? *([\d.]+)", text)
        last = rows[-1]
        print(f"part {part}: to step {last['step']:.0f}, {last['contacts']:.0f} new contacts, "
              f"restarted with the same bits: {same}, lost {scale:.3e} J, "
              f"ledger off by {worst:.1e} J, largest change in 1000 steps at rest {gain:.1e} J, "
              f"kinetic {last['kinetic']:.1e} J, memory {memory} MB")
        if same is False:
            faults.append(f"part {part}: the restarted process is not the one that went on")
        if gain > ROUNDING * last["mechanical"]:
            faults.append(f"part {part}: energy is created at rest, {gain:.1e} J")
        if worst > LEDGER * scale + 1e-12 * last["mechanical"]:
            faults.append(f"part {part}: the ledger does not close")
    print(f"{last['step'] if last else 0:.0f} steps;", "; ".join(faults) or "no fault")
    return 1 if faults else 0


def main():
    raw = argparse.RawTextHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=raw)
    parser.add_argument("built", type=Path)
    parser.add_argument("directory", type=Path)
    for name, value in ("steps", 10010000), ("beads", 500), ("ranks", 1):
        parser.add_argument(f"--{name}", type=int, default=value)
    parser.add_argument("--report", action="store_true")
    args = parser.parse_args()
    args.built = args.built.resolve()
    args.directory.mkdir(parents=True, exist_ok=True)
    for part in range(1, PARTS + 1):
        if args.report or (args.directory / f"whole.{part}.restart").exists():
            continue
        done = subprocess.run(command(args, part), cwd=args.directory, capture_output=True,
                              text=True)
        if done.returncode:
            sys.exit(f"part {part}: {done.stdout[-2000:]}{done.stderr[-2000:]}")
    sys.exit(report(args))


if __name__ == "__main__":
    main()
