#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Benchmarks to tables and figures of the records:  report.py PROGRAMS DIRECTORY [OPTION ...]

Runs the programs of this folder that are in PROGRAMS. Their CSV goes to DIRECTORY. In the pages of
DOCS the text between `<!-- NAME -->` and `<!-- end -->` becomes the table NAME, and the figures go
to DOCS/figures.
"""
import argparse
import datetime
import math
import re
import shutil
import subprocess
import sys
from pathlib import Path

import figures
import numpy as np
from scenes import map_scenes, numbers, rows_of, runs_of, standard_scenes, write_scenes

HERE = Path(__file__).resolve().parent
DATA = HERE.parent / "data"
PAPER = "paper-euler"
ERRORS = (1e-3, 1e-4, 1e-5, 1e-6, 1e-8)
TOLERANCES = [10.0**-k for k in range(2, 9)]
MAP_TOLERANCE, MAP_BUDGET = 1e-3, 0.5  # of impacts.c; s
COUNTED = ("truth-1", "truth-2", "truth-4", "truth-10", "two-terms", "PIB-v=1")


class Report:
    """Where programs, results and pages are."""

    def __init__(self, programs, directory, docs, quick=False, kept=False):
        self.programs, self.directory, self.docs = programs, directory, docs
        self.quick, self.kept = quick, kept
        directory.mkdir(parents=True, exist_ok=True)

    def run(self, name, *words):
        """DIRECTORY/NAME.csv with what a program prints."""
        path = self.directory / f"{name}.csv"
        if not self.kept:
            print("running", *words, flush=True)
            with open(path.with_suffix(".part"), "w", encoding="utf-8") as file:
                subprocess.run([self.programs / words[0], *map(str, words[1:])], stdout=file,
                               check=True)
            path.with_suffix(".part").replace(path)
        return path

    def put(self, page, name, lines):
        """Replace the table NAME of a page, with its date and commit, and print it."""
        done = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=HERE,
                              capture_output=True, text=True)
        commit = done.stdout.strip() or "an unknown commit"
        made = f"Recorded on {datetime.date.today()} from {commit}:"
        print(f"\n{page}: {name}", *lines, sep="\n")
        path, text = self.docs / page, "\n".join([made, "", *lines, ""])
        block = re.compile(rf"(<!-- {name} -->\n\n).*?(\n<!-- end -->)", re.S)
        after, count = block.subn(lambda m: m[1] + text + m[2], path.read_text(encoding="utf-8"))
        if count != 1:
            raise SystemExit(f"report.py: {path}: must have one <!-- {name} -->, not {count}")
        path.write_text(after, encoding="utf-8")


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return ["| " + " | ".join(map(str, line)) + " |" for line in lines]


def short(value):
    """Two digits; nothing if there is no number."""
    if not math.isfinite(value):
        return ""
    return f"{value:#.2g}".rstrip(".") if abs(value) < 100 else f"{float(f'{value:.2g}'):.0f}"


def power(value):
    """As in 2.5e-4 and 1e-3."""
    return re.sub(r"(\.0)?e-0?", "e-", f"{value:.1e}") if 0 < value < 0.1 else short(value)


def si(seconds):
    """Two digits and a unit; an infinite median is "not reached"."""
    unit, scale = ("us", 1e6) if seconds < 1e-3 else ("ms", 1e3) if seconds < 1 else ("s", 1)
    return f"{short(seconds * scale)} {unit}" if math.isfinite(seconds) else "not reached"


def settings(runs, method):
    """Masks of the runs of a method, one a setting, from coarse to fine."""
    mine = runs.method == method
    return [mine & (runs.setting == setting) for setting in dict.fromkeys(runs.setting[mine])]


def curve(runs, method, n_scenes):
    """Median time, least, median and largest error of each setting that solves four fifths of the
    scenes; of the paper's algorithm those than which none is faster and as exact."""
    points = []
    for mask in settings(runs, method):
        done = mask & runs.solved
        if 5 * sum(done) >= 4 * n_scenes:
            error = runs.error[done]
            points.append((np.median(runs.seconds[done]), min(error), np.median(error), max(error)))
    if method != PAPER:
        return points
    return [p for p in sorted(points) if not any(q[0] < p[0] and q[2] <= p[2] for q in points)]


def fastest(runs, mask, places):
    """Median over scenes of the shortest time, infinite if half of them have none; and how many
    scenes have one."""
    times = [np.min(runs.seconds[mask & (runs.place == place)], initial=np.inf) for place in places]
    return np.median(times), int(np.isfinite(times).sum())


def speed(runs, places, method, error):
    """Time for an error, asked for (median, scenes within it, elements and steps) and got (median,
    scenes). A reference is allowed twice its own error."""
    verified = runs.solved & (runs.error <= np.maximum(error, 2 * runs.unsure))
    asked = (np.inf, 0, "")
    for mask in settings(runs, method):
        time, _ = fastest(runs, mask & runs.solved, places)
        _, within = fastest(runs, mask & verified, places)
        setting = runs.setting[mask][0]
        if method != PAPER and math.isclose(float(setting), error):
            asked = (time, within, "")
        if method == PAPER and 2 * within >= len(places) and time < asked[0]:
            asked = (time, within, f", {setting}")
    return asked, fastest(runs, (runs.method == method) & verified, places)


def speed_table(runs, scenes, methods):
    places = [place for place, scene in enumerate(scenes) if scene.partly_slips]
    lines = []
    for method in [*methods, PAPER]:
        for error in ERRORS:
            asked, got = speed(runs, places, method, error)
            paper = speed(runs, places, PAPER, error)
            ratios = [short(p[0] / m[0]) if method != PAPER else ""
                      for p, m in zip(paper, (asked, got))]
            lines.append([method if error == ERRORS[0] else "", power(error),
                          si(asked[0]) + asked[2], asked[1], ratios[0],
                          si(got[0]), got[1], ratios[1]])
    return table(["method", "error", "asked", "within", "ratio", "got", "reached", "ratio"], lines)


def summary_table(runs, method, n_scenes):
    lines = []
    for mask in settings(runs, method):
        done = mask & runs.solved
        error, estimate, unsure = runs.error[done], runs.estimate[done], runs.unsure[done]
        above = error > unsure  # else how much of it is the reference's cannot be told
        count = f" ({sum(done)} scenes)" if sum(done) < n_scenes else ""
        lines.append([power(runs.tolerance[mask][0]), si(np.median(runs.seconds[done])) + count,
                      power(np.median(error)), power(max(error)),
                      short(np.median((estimate / error)[above])),
                      f"{100 * np.mean(error <= estimate + unsure):.1f} %"])
    return table(["tolerance", "time", "error", "largest", "estimate/error", "honest"], lines)


def precision(report, methods):
    scenes = standard_scenes(DATA, report.quick)
    write_scenes(report.directory / "scenes.csv", scenes)
    tolerances = ",".join(f"{t:g}" for t in TOLERANCES[:3 if report.quick else None])
    swept = [*methods, PAPER, *(["paper-verlet", "paper-forward"] if report.quick else [])]
    path = report.run("runs", "impacts", report.directory / "scenes.csv", "sweep", ",".join(swept),
                      tolerances, *((60, 4) if report.quick else (0.4, 9)))
    runs = runs_of(path, scenes)
    report.put("records/bench.md", "speed", speed_table(runs, scenes, methods[:2]))
    report.put("records/bench.md", "summary", summary_table(runs, "sync", len(scenes)))
    figures.precision({m: curve(runs, m, len(scenes)) for m in [*methods[:2], PAPER]}, len(scenes),
                      report.docs / "figures/work_precision.svg")


def omissions(report, methods):
    repeats = 5 if report.quick else 51
    rows = rows_of(report.run("omissions", "omissions", ",".join(methods), repeats))
    lines = {}
    for row in rows:
        words = row["left_out"], row["full"], row["lean"]
        lines.setdefault(words, []).append(short(float(row["ratio"] or "nan")))
    default = "default impact"
    parts = [[*words, *cells] for words, cells in lines.items() if words[0] != default]
    solids = [[words[1], *cells] for words, cells in lines.items() if words[0] == default]
    page = "records/omissions.md"
    report.put(page, "omissions", table(["left out", "full", "lean", *methods], parts))
    report.put(page, "solids", table(["solid", *methods], solids))
    figures.omissions(rows, report.docs / "figures/omissions.svg")


def verdicts(runs, budget=MAP_BUDGET):
    """What each cell of the stability map is. A run that gives up at once was not slow."""
    gave_up = runs.outcome == "slow"
    slow = (runs.seconds > budget) | (gave_up & (runs.seconds > budget / 20))
    inside = (runs.ez >= -0.01) & (runs.ez <= 1.01) & (abs(runs.ex) <= 1.01)
    certain = runs.error - runs.unsure
    wrong = (certain > 10 * runs.estimate) & (certain > 10 * MAP_TOLERANCE)
    return np.select([slow, gave_up | (runs.outcome == "refused"), ~(runs.solved & inside), wrong],
                     ["too slow", "refused", "unstable", "wrong"], "solved")


def stability(report, methods):
    methods, levels = [*methods[:2], PAPER], 3 if report.quick else 5
    budget = 60 if report.quick else MAP_BUDGET
    scenes = map_scenes(report.quick)
    write_scenes(report.directory / "places.csv", scenes)
    runs = runs_of(report.run("stability", "impacts", report.directory / "places.csv", "map",
                              ",".join(methods), budget, levels), scenes)
    names = ("solved", "refused", "unstable", "wrong", "too slow")
    found, lines = verdicts(runs, budget), []
    for method in methods:
        for steps in (10**level for level in range(1, levels + 1)):
            here = (runs.method == method) & (runs.steps_asked == steps)
            counts = [sum(here & (found == name)) for name in names]
            counts[-1] += len(scenes) - sum(here)  # foreseeably
            largest = max(runs.error[here & (found == "solved")], default=math.nan)
            lines.append([method if steps == 10 else "", steps, *counts, power(largest)])
    report.put("records/stability.md", "stability",
               table(["method", "steps", *names, "largest error"], lines))
    figures.stability(runs, found, scenes, methods, levels, report.docs / "figures/stability.svg")


def contact(report, _):
    lines = []
    for row in rows_of(report.run("contact", "contact_step")):
        bare, single, batch = numbers(row, "hertz_mindlin_ns", "single_ns", "batch_ns")
        lines.append([row["law"], f"{single / bare:.1f}", f"{batch / bare:.1f}"])
    head = ["law (8 elements)", "single calls", "in batches"]
    report.put("dem.md", "contact", table(head, lines))


def lookups(report, _):
    names = {"single": "`restitute_table_pair`", "many": "`restitute_table_pair_many`",
             "chained": "`restitute_table_pair`, each needs the result of the one before"}
    lines = []
    for row in rows_of(report.run("lookups", "table_lookup", *([1] if report.quick else []))):
        ns, of_pow = numbers(row, "ns", "pow_ns")
        lines.append([names[row["call"]], row["places"], f"{ns:.0f}", f"{ns / of_pow:.1f}"])
    report.put("records/table.md", "lookups", table(["", "places", "ns", "calls of `pow`"], lines))


def instructions(report, _):
    """Of one impact by a warm solver: three solves minus two."""
    if not shutil.which("valgrind"):
        print("report.py: no valgrind, so instructions are not counted", file=sys.stderr)
        return
    tolerances, lines = TOLERANCES[:1 if report.quick else None], []
    path, counter = report.directory / "counted.csv", ["valgrind", "--tool=callgrind"]
    counter += ["--toggle-collect=restitute_solve", "--callgrind-out-file=/dev/null"]
    for scene in standard_scenes(DATA, report.quick):
        if scene.name not in COUNTED[:1 if report.quick else None]:
            continue
        write_scenes(path, [scene])
        lines.append([scene.name])
        for tolerance in tolerances:
            words = [report.programs / "impacts", path, "repeat", "sync", tolerance, scene.name]
            said = [subprocess.run([*counter, *map(str, words), times], check=True, text=True,
                                   capture_output=True).stderr for times in ("2", "3")]
            two, three = (int(re.search(r"Collected : (\d+)", text)[1]) for text in said)
            lines[-1].append(f"{(three - two) / 1000:.0f}")
    report.put("records/bench.md", "instructions", table(["scene", *map(power, tolerances)], lines))


PARTS = {f.__name__: f for f in (precision, omissions, stability, contact, lookups, instructions)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", type=Path)
    parser.add_argument("directory", type=Path)
    parser.add_argument("--docs", type=Path, default=HERE.parent.parent / "docs")
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=list(PARTS))
    parser.add_argument("--cvode", action="store_true", help="this build has the method cvode")
    parser.add_argument("--quick", action="store_true", help="few impacts, to see that it runs")
    parser.add_argument("--kept", action="store_true", help="take the CSV that is there")
    words = parser.parse_args()
    report = Report(words.programs, words.directory, words.docs, words.quick, words.kept)
    np.seterr(divide="ignore", invalid="ignore")  # what is not reached has no ratio
    for part in words.parts:
        PARTS[part](report, ["euler", "sync", *(["cvode"] if words.cvode else [])])


if __name__ == "__main__":
    main()
