# SPDX-License-Identifier: BSD-3-Clause
"""Compares outputs of numbers.c:  compare.py FIRST OTHER [COMPONENT ...]

Both must have the numbers of every component, but OTHER may lack those that are named."""
import hashlib
import sys
from collections import defaultdict
from pathlib import Path

# What other bits may change: a hundred times what was seen (docs/records/extremes.md). Iterations
# and adaptive steps multiply rounding until they stop.
BOUNDS = {"sync": 1e-11, "euler": 1e-11, "cvode": 1e-9, "bem": 1e-9, "contact": 1e-11,
          "table": 1e-11, "fit": 1e-8, "files": 1e-14}
# One number in ten of cvode may change by a tenth of its tolerance. Comparisons end its steps and
# slip: on one machine a change of psi by 1e-14 changes e_x by up to 2e-5.
RARE = {"cvode": 1e-4}


def read(path):
    found = defaultdict(list)
    for line in Path(path).read_text().splitlines():
        name, _, value = line.split()
        found[name].append(value)
    return found


first, other = map(read, sys.argv[1:3])
print(Path(sys.argv[2]).stem)
failed = False
for name in sorted(BOUNDS.keys() | first.keys() | other.keys()):
    values = other.get(name, [])
    if name not in BOUNDS or not first.get(name) or not values:
        optional = name in BOUNDS and name in sys.argv[3:] and not values
        print(f"    {name:8} {'left out' if optional else 'MISSING or unknown'}")
        failed |= not optional
        continue
    pairs = [(float(a), float(b)) for a, b in zip(first[name], values)]
    scale = {"contact": max(abs(a) for a, _ in pairs)}.get(name)
    changes = [abs(a - b) / (scale or max(1, abs(a))) for a, b in pairs]
    others = sum(a != b for a, b in pairs)
    beyond = sum(not change <= BOUNDS[name] for change in changes)
    failed |= (beyond > (len(values) // 10 if name in RARE else 0) or len(values) != len(first[name])
               or not all(change <= RARE.get(name, BOUNDS[name]) for change in changes))
    digest = hashlib.sha256(" ".join(values).encode()).hexdigest()[:16]
    print(f"    {name:8} {len(values):5} numbers, hash {digest}, {others} others, "
          f"{beyond} beyond {BOUNDS[name]}, by {max(changes):.1e} at most")
sys.exit(failed)
