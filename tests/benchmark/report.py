# SPDX-License-Identifier: BSD-3-Clause
"""Benchmarks to tables and figures of the records.

    report.py PROGRAMS DIRECTORY [--docs DOCS] [--parts ...] [--quick] [--kept]

Runs the programs of this folder that are in PROGRAMS. Their CSV goes to DIRECTORY. In the pages of
DOCS the text between `<!-- NAME -->` and `<!-- end -->` becomes the table NAME, and the figures go
to DOCS/figures. `--kept` takes the CSV that is there. `--quick` takes a few impacts, to see that
all of it runs.
"""
import argparse
import csv
import datetime
import math
import pathlib
import re
import shutil
import subprocess
import sys
from collections import defaultdict
from statistics import median

import figures

HERE = pathlib.Path(__file__).resolve().parent
ERRORS = (1e-3, 1e-4, 1e-5, 1e-6, 1e-8)
TOLERANCES = [10.0**-k for k in range(2, 9)]
LIBRARY = ("euler", "sync", "cvode")
PAPER = "paper-euler"
MAP_TOLERANCE, MAP_BUDGET = 1e-3, 0.5  # of the stability map; budget in s
NUMBERS_OF_COUNTS = ("truth-1", "truth-2", "truth-4", "truth-10", "two-terms", "PIB-v=1")


# Scenes

def rows_of(path):
    """The rows of a CSV file as dictionaries; lines with # are comments."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def scene(kind, name, chi, psi, delta1=math.nan, gamma=math.nan, g_inf=1.0, terms="", ez=None, ex=None, error=0.0):
    return dict(set=kind, name=name, chi=float(chi), psi=float(psi), delta1=float(delta1), gamma=float(gamma),
                g_inf=float(g_inf), terms=terms, ez=ez and float(ez), ex=ex and float(ex), error=float(error))


def steel_ball(data):
    """Sphere of 5 mm and 7800 kg/m^3 at 1 m/s on polyisobutylene: its terms over G_r and T, (23) and (24)."""
    terms = [(float(row["G_Pa"]), float(row["tau_s"])) for row in rows_of(data / "pib_prony.csv")]
    modulus, radius = sum(g for g, _ in terms), 5e-3
    mass = 7800 * 4 / 3 * math.pi * radius**3
    time = (15 * mass * 0.5 / (32 * modulus * math.sqrt(radius))) ** 0.4  # T = d0/v
    return " ".join(f"{g / modulus:.17g}:{tau / time:.17g}" for g, tau in terms)


def standard_scenes(data, quick):
    """The sets truth, prony and stiff of docs/records/bench.md."""
    truth = [scene("truth", f"truth-{i}", row["chi"], row["psi"], row["delta1"], row["gamma"], ez=row["ez"],
                   ex=row["ex"], error=max(float(row["err_ez"]), float(row["err_ex"])))
             for i, row in enumerate(rows_of(data / "impact_truth.csv"), 1)]
    prony = []
    for row in rows_of(data / "prony_truth.csv"):
        ball = row["g_inf"] == "pib"
        prony.append(scene("prony", row["name"].replace(" ", "-"), row["chi"], row["psi"], ez=row["ez"], ex=row["ex"],
                           g_inf=0 if ball else row["g_inf"], error=row["err"],
                           terms=steel_ball(data) if ball else row["terms"].replace(";", " ")))
    stiff = [scene("stiff", f"stiff-{delta1:g}-{psi:g}", 7 / 6, psi, delta1, 1e-6)
             for delta1 in (1e-6, 1e-3, 1, 1e3) for psi in (0.5, 1.5)]
    if quick:
        return [truth[i] for i in (0, 1, 2, 3, 9)] + prony[:1] + stiff[4:6]
    return truth + prony + stiff


def map_scenes(quick):
    powers = range(-6, 7, 4 if quick else 1)
    return [scene("map", f"map-{i}-{k}", 7 / 6, 1.5, 10.0**i, 10.0**k) for i in powers for k in powers]


# Running

class Report:
    """Where programs, results and pages are."""

    def __init__(self, programs, directory, docs, quick, kept):
        self.programs, self.directory, self.docs, self.quick, self.kept = programs, directory, docs, quick, kept
        directory.mkdir(parents=True, exist_ok=True)
        self.data = HERE.parent / "data"

    def run(self, name, *words):
        """The rows that a program prints, kept in DIRECTORY/NAME.csv."""
        path = self.directory / f"{name}.csv"
        if not self.kept:
            print("running", name, *words, flush=True)
            with open(path.with_suffix(".part"), "w", encoding="utf-8") as file:
                subprocess.run([self.programs / words[0], *map(str, words[1:])], stdout=file, check=True)
            path.with_suffix(".part").replace(path)
        return rows_of(path)

    def write_scenes(self, name, scenes):
        path = self.directory / f"{name}.csv"
        with open(path, "w", encoding="utf-8") as file:
            file.write("name,chi,psi,delta1,gamma,g_inf,terms\n")
            for s in scenes:
                file.write("{name},{chi:.17g},{psi:.17g},{delta1:.17g},{gamma:.17g},{g_inf:.17g},{terms}\n".format(**s))
        return path

    def put(self, page, name, lines):
        """Replace the table NAME of a page, and print it."""
        print(f"\n{page}: {name}", *lines, sep="\n")
        path = self.docs / page
        before = path.read_text(encoding="utf-8")
        text = "\n".join(lines) + "\n"
        after, count = re.subn(rf"(<!-- {name} -->\n\n).*?(\n<!-- end -->)", lambda m: m[1] + text + m[2], before, flags=re.S)
        if count != 1:
            raise SystemExit(f"report.py: {path}: must have one <!-- {name} -->, not {count}")
        path.write_text(after, encoding="utf-8")

    def dated(self, page, name):
        """When and from which commit a page's numbers are."""
        commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=HERE, capture_output=True, text=True,
                                check=False).stdout.strip() or "unknown"
        self.put(page, f"{name} recorded", [f"Recorded on {datetime.date.today()} from commit {commit}."])


def table(head, rows):
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head), *("| " + " | ".join(row) + " |" for row in rows)]


def short(value):
    """Two digits; nothing if there is no number."""
    if not math.isfinite(value):
        return ""
    return f"{value:#.2g}".rstrip(".") if abs(value) < 100 else f"{float(f'{value:.2g}'):.0f}"


def power(value):
    """As in 2.5e-4 and 1e-3."""
    return re.sub(r"(\.0)?e-0?", "e-", f"{value:.1e}") if math.isfinite(value) else ""


def si(seconds):
    """Two digits and a unit; an infinite median is "not reached"."""
    unit, scale = ("us", 1e6) if seconds < 1e-3 else ("ms", 1e3) if seconds < 1 else ("s", 1)
    return f"{short(seconds * scale)} {unit}" if math.isfinite(seconds) else "not reached"


# Error against run time

def judged(rows, scenes):
    """Rows with numbers, their scene and true error. Where a scene has no reference, it is the finest run of sync,
    which itself is left out."""
    scenes = {s["name"]: s for s in scenes}
    for row in rows:
        for key in ("tolerance", "seconds", "ez", "ex", "error_ez", "error_ex"):
            row[key] = float(row[key])
        for key in ("elements_asked", "steps_asked", "elements", "steps", "restarts", "events"):
            row[key] = int(row[key] or 0)
        row["scene"] = scenes[row["scene"]]
        row["solved"] = row["outcome"] in ("solved", "not reached")
    kept = []
    for row in rows:
        s = row["scene"]
        if s["ez"] is None:
            fine = min((r for r in rows if r["scene"] is s and r["method"] == "sync" and r["solved"]),
                       key=lambda r: r["tolerance"], default=None)
            if fine is None:
                continue
            s.update(ez=fine["ez"], ex=fine["ex"], error=max(fine["error_ez"], fine["error_ex"]), reference=fine)
        if row is s.get("reference"):
            continue
        row["error"] = max(abs(row["ez"] - s["ez"]), abs(row["ex"] - s["ex"])) if row["solved"] else math.inf
        row["estimate"] = max(row["error_ez"], row["error_ex"])
        kept.append(row)
    return kept


def settings(rows, method):
    """{setting: its runs}, a setting being a tolerance or a pair of elements and steps."""
    groups = defaultdict(list)
    for row in rows:
        if row["method"] == method:
            groups[row["tolerance"] if method in LIBRARY else (row["elements_asked"], row["steps_asked"])].append(row)
    return dict(groups)


def curve(rows, method, n_scenes):
    """(median time, least, median and largest error) of each setting that solves four fifths of the scenes; of pairs
    those than which none is faster and as exact."""
    points = []
    for runs in settings(rows, method).values():
        done = [r for r in runs if r["solved"]]
        if done and 5 * len(done) >= 4 * n_scenes:
            errors = [r["error"] for r in done]
            points.append((median(r["seconds"] for r in done), min(errors), median(errors), max(errors)))
    if method in LIBRARY:
        return points
    return [p for p in sorted(points) if not any(q[0] < p[0] and q[2] <= p[2] for q in points)]


def counts_for_speed(s):
    """Standard solids with 0 < psi < psi_c (31)."""
    psi_c = max(1, 2 * s["chi"] * (1 + s["ez"]) - s["ez"])
    return s["set"] == "truth" and s["delta1"] > 0 and s["gamma"] > 0 and 0 < s["psi"] < psi_c


def verified(row, error):
    """Within the error as far as the reference can tell."""
    return row["error"] <= max(error, 2 * row["scene"]["error"])


def fastest(rows, scenes):
    """Median over scenes of the shortest time; infinite where half of them have none. And how many have one."""
    times = [min((r["seconds"] for r in rows if r["scene"] is s), default=math.inf) for s in scenes]
    return median(times), sum(map(math.isfinite, times))


def speed(rows, scenes, method, error):
    """Time for an error: asked for (setting, median time, scenes within) and got (median time, scenes)."""
    mine = [r for r in rows if r["method"] == method and r["solved"]]
    asked = ("", math.inf, 0)
    for setting, runs in settings(mine, method).items():
        time, _ = fastest(runs, scenes)
        _, within = fastest([r for r in runs if verified(r, error)], scenes)
        if method in LIBRARY and setting == error:
            asked = ("", time, within)
        elif method not in LIBRARY and 2 * within >= len(scenes) and time < asked[1]:
            asked = (f", {setting[0]} x {setting[1]}", time, within)
    return asked, fastest([r for r in mine if verified(r, error)], scenes)


def speed_table(rows, scenes, methods):
    chosen = [s for s in scenes if counts_for_speed(s)]
    paper = {error: speed(rows, chosen, PAPER, error) for error in ERRORS}
    lines = []
    for method in methods:
        for error in ERRORS:
            asked, got = speed(rows, chosen, method, error) if method != PAPER else paper[error]
            ratios = [paper[error][0][1] / asked[1], paper[error][1][0] / got[0]] if method != PAPER else [math.nan] * 2
            lines.append([method if error == ERRORS[0] else "", power(error), si(asked[1]) + asked[0],
                          str(asked[2]), short(ratios[0]), si(got[0]), str(got[1]), short(ratios[1])])
    return table(["method", "error", "asked", "within", "ratio", "got", "reached", "ratio"], lines)


def summary_table(rows, method, n_scenes):
    lines = []
    for tolerance, runs in settings(rows, method).items():
        done = [r for r in runs if r["solved"]]
        if not done:
            continue
        above = [r for r in done if r["error"] > r["scene"]["error"]]
        honest = sum(r["error"] <= r["estimate"] + r["scene"]["error"] for r in done) / len(done)
        ratio = median(r["estimate"] / r["error"] for r in above) if above else math.nan
        time = si(median(r["seconds"] for r in done)) + (f" ({len(done)} scenes)" if len(done) < n_scenes else "")
        lines.append([power(tolerance), time, power(median(r['error'] for r in done)),
                      power(max(r['error'] for r in done)), short(ratio), f"{100 * honest:.1f} %"])
    return table(["tolerance", "time", "error", "largest", "estimate/error", "honest"], lines)


def work_table(rows, methods):
    """Medians of steps, and of restarts and events of cvode."""
    lines = []
    for tolerance in TOLERANCES[1:5]:
        cells = [power(tolerance)]
        for method in methods:
            done = [r for r in settings(rows, method).get(tolerance, []) if r["solved"]]
            cells += [str(int(median(r[key] for r in done))) if done else ""
                      for key in (("steps", "restarts", "events") if method == "cvode" else ("steps",))]
        lines.append(cells)
    head = [f"steps of `{m}`" for m in methods]
    return table(["tolerance", *head, *(["restarts, all runs", "events, all runs"] if "cvode" in methods else [])], lines)


def precision(report, methods):
    scenes = standard_scenes(report.data, report.quick)
    path = report.write_scenes("scenes", scenes)
    tolerances = TOLERANCES[:3] if report.quick else TOLERANCES
    rows = judged(report.run("runs", "impacts", path, "sweep", ",".join([*methods, PAPER, "paper-verlet", "paper-forward"]),
                             ",".join(f"{t:g}" for t in tolerances), 60 if report.quick else 0.4, 4 if report.quick else 9), scenes)
    report.put("records/bench.md", "speed", speed_table(rows, scenes, [*methods[:2], PAPER]))
    report.put("records/bench.md", "summary", summary_table(rows, "sync", len(scenes)))
    report.put("records/cvode.md", "steps", work_table(rows, methods))
    report.dated("records/bench.md", "precision")
    report.dated("records/cvode.md", "steps")
    curves = {m: curve(rows, m, len(scenes)) for m in [*methods[:2], PAPER]}
    figures.precision(curves, len(scenes), report.docs / "figures/work_precision.svg")


# Omissions, stability, contact step, look-ups, instructions

def omissions(report, methods):
    rows = report.run("omissions", "omissions", ",".join(methods), 5 if report.quick else 51)
    ratio = {(r["method"], r["left_out"], r["full"]): float(r["ratio"] or "nan") for r in rows}
    pairs = list(dict.fromkeys((r["left_out"], r["full"], r["lean"]) for r in rows))
    cells = {p: [short(ratio[m, p[0], p[1]]) for m in methods] for p in pairs}
    report.put("records/omissions.md", "omissions", table(
        ["left out", "full", "lean", *methods], [[*p, *cells[p]] for p in pairs if p[0] != "default impact"]))
    report.put("records/omissions.md", "solids", table(
        ["solid", *methods], [[p[1], *cells[p]] for p in pairs if p[0] == "default impact"]))
    report.dated("records/omissions.md", "omissions")
    figures.omissions(rows, methods, report.docs / "figures/omissions.svg")


def verdict(row):
    """What a cell of the stability map is."""
    slow = row["seconds"] > MAP_BUDGET or (row["outcome"] == "slow" and row["seconds"] > MAP_BUDGET / 20)
    if slow:
        return "too slow"
    if row["outcome"] in ("refused", "slow"):
        return "refused"
    if not (row["solved"] and -0.01 <= row["ez"] <= 1.01 and abs(row["ex"]) <= 1.01):
        return "unstable"
    certain = row["error"] - row["scene"]["error"]
    return "wrong" if certain > 10 * row["estimate"] and certain > 10 * MAP_TOLERANCE else "solved"


def stability(report, methods):
    scenes, levels = map_scenes(report.quick), 3 if report.quick else 5
    path = report.write_scenes("places", scenes)
    budget = 60 if report.quick else MAP_BUDGET
    rows = judged(report.run("stability", "impacts", path, "map", ",".join(methods), budget, levels), scenes)
    steps = [10**k for k in range(1, levels + 1)]
    cells = {(m, n): [] for m in methods for n in steps}
    for row in rows:
        cells[row["method"], row["steps_asked"]].append((row, verdict(row)))
    names, lines = ("solved", "refused", "unstable", "wrong", "too slow"), []
    for (method, n), found in cells.items():
        counts = {name: sum(v == name for _, v in found) for name in names}
        counts["too slow"] += len(scenes) - len(found)  # foreseeably
        largest = max((r["error"] for r, v in found if v == "solved"), default=math.nan)
        lines.append([method if n == 10 else "", str(n), *map(str, counts.values()), power(largest)])
    report.put("records/stability.md", "stability", table(["method", "steps", *names, "largest error"], lines))
    report.dated("records/stability.md", "stability")
    figures.stability(cells, methods, steps, report.docs / "figures/stability.svg")


def contact(report, _):
    rows = report.run("contact", "contact_step")
    report.put("dem.md", "contact", table(["law (8 elements)", "single calls", "in batches"], [
        [r["law"], *(f"{float(r[key]) / float(r['hertz_mindlin_ns']):.1f}" for key in ("single_ns", "batch_ns"))]
        for r in rows]))
    report.dated("dem.md", "contact")


def lookups(report, _):
    rows = report.run("lookups", "table_lookup", *([1] if report.quick else []))
    names = {"single": "`restitute_table_pair`", "many": "`restitute_table_pair_many`",
             "chained": "`restitute_table_pair`, each needs the result of the one before"}
    report.put("records/table.md", "lookups", table(["", "places", "ns", "calls of `pow`"], [
        [names[r["call"]], r["places"], f"{float(r['ns']):.0f}", f"{float(r['ns']) / float(r['pow_ns']):.1f}"] for r in rows]))
    report.dated("records/table.md", "lookups")


def counted(report, path, name, tolerance):
    """Instructions of one impact by a warm solver: three solves minus two; None: refused."""
    found = []
    for times in (2, 3):
        words = ["valgrind", "--tool=callgrind", "--toggle-collect=restitute_solve", "--callgrind-out-file=/dev/null",
                 str(report.programs / "impacts"), str(path), "repeat", "sync", f"{tolerance:g}", name, str(times)]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        match = re.search(r"Collected : (\d+)", done.stderr)
        if done.returncode or not match:
            return None
        found.append(int(match[1]))
    return found[1] - found[0]


def instructions(report, _):
    if not shutil.which("valgrind"):
        print("report.py: no valgrind, so instructions are not counted", file=sys.stderr)
        return
    tolerances, lines = TOLERANCES[:1] if report.quick else TOLERANCES, []
    for s in standard_scenes(report.data, report.quick):
        if s["name"] not in NUMBERS_OF_COUNTS[:1 if report.quick else None]:
            continue
        path = report.write_scenes("counted", [s])
        counts = [counted(report, path, s["name"], tolerance) for tolerance in tolerances]
        lines.append([s["name"], *(f"{n / 1000:.0f}" if n else "" for n in counts)])
    report.put("records/bench.md", "instructions", table(["scene", *(f"1e-{k}" for k in range(2, 2 + len(tolerances)))], lines))
    report.dated("records/bench.md", "instructions")


PARTS = {f.__name__: f for f in (precision, omissions, stability, contact, lookups, instructions)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", type=pathlib.Path)
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("--docs", type=pathlib.Path, default=HERE.parent.parent / "docs")
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=list(PARTS))
    parser.add_argument("--cvode", action="store_true", help="this build has the method cvode")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--kept", action="store_true")
    words = parser.parse_args()
    report = Report(words.programs, words.directory, words.docs, words.quick, words.kept)
    methods = ["euler", "sync", *(["cvode"] if words.cvode else [])]
    for part in words.parts:
        PARTS[part](report, [*methods[:2], PAPER] if part == "stability" else methods)


if __name__ == "__main__":
    main()
