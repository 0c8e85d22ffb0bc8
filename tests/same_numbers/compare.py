# SPDX-License-Identifier: BSD-3-Clause
"""Compares outputs of numbers.c:  compare.py FIRST OTHER"""
import hashlib
import sys
from collections import defaultdict
from pathlib import Path

# What other bits may change. sync and euler decide by comparisons, which rounding may turn: within
# their tolerances. Tables hold solved impacts; the fit solves some hundred.
BOUNDS = {"sync": 1e-6, "euler": 1e-2, "cvode": 1e-3, "bem": 0.1, "contact": 1e-9, "table": 1e-4,
          "fit": 1e-3, "files": 1e-14}


def read(path):
    found = defaultdict(list)
    for line in Path(path).read_text().splitlines():
        name, _, value = line.split()
        found[name].append(value)
    return found


first, other = map(read, sys.argv[1:])
print(Path(sys.argv[2]).stem)
failed = False
for name, values in other.items():
    pairs = [(float(a), float(b)) for a, b in zip(first[name], values)]
    scale = {"contact": max(abs(a) for a, _ in pairs)}.get(name)
    change = max(abs(a - b) / (scale or max(1, abs(a))) for a, b in pairs)
    others = sum(a != b for a, b in pairs)
    failed |= not change <= BOUNDS[name] or len(values) != len(first[name])
    digest = hashlib.sha256(" ".join(values).encode()).hexdigest()[:16]
    print(f"    {name:8} {len(values):5} numbers, hash {digest}, {others} others, "
          f"by {change:.1e} at most")
sys.exit(failed)
