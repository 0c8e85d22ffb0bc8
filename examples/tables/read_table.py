#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reads the file of a table of one contact with h5py, and looks up pairs in it.

    read_table.py FILE V_N V_T      prints what the file says of itself, and ez and ex of an impact (m/s)
    read_table.py FILE              prints ez over the speed, as CSV

The library itself is not needed: all that a table is stands in its file (include/restitute/table.h, restitute_table_data). Exit
status 77: h5py is not installed.
"""

import sys

try:
    import h5py
    import numpy as np
except ImportError as missing:
    print(f"{missing}: python3 -m pip install h5py", file=sys.stderr)
    sys.exit(77)

SOFT = 1 / 64  # r(y) = sqrt(y + c^2) - c: the places that are evenly divided on the slip side


def cubic(nodes, x):
    """First of the four nodes of the cell that x is in, and their weights; cells share the nodes at their ends."""
    first = 3 * min(max(np.searchsorted(nodes[::3], x, side="right") - 1, 0), (len(nodes) - 1) // 3 - 1)
    own = nodes[first : first + 4]
    weights = [np.prod([(x - b) / (a - b) for b in own if b != a]) for a in own]
    return first, np.array(weights)


def root(y):
    return np.sqrt(y + SOFT**2) - SOFT


def ez_at(table, v_n):
    """ez, and where its nodes are; beyond the ends of the table those of the ends."""
    speed = table["speed"][:]
    v_n = min(max(v_n, table.attrs["range_first_low"]), table.attrs["range_first_high"])
    first, weights = cubic(speed, v_n)
    return float(weights @ table["ez"][first : first + 4, 0]), first, weights


def pair_at(table, v_n, v_t):
    """ez and ex of an impact. Full slip is its closed form, from psi_c on."""
    chi, psi = table.attrs["own_chi"], table.attrs["psi_factor"] * abs(v_t) / v_n
    ez, first, weights = ez_at(table, v_n)
    full = 2 * chi * (1 + ez)
    critical = full - ez if 2 * chi > 1 else 1
    if psi > critical:
        return ez, full / psi - 1
    place, stick = table["psi"][:], 3 * table.attrs["stick_cells"] + 1
    if psi <= 1:
        column, by_psi = cubic(place[:stick], psi)
        closed = 0
    else:
        y = (psi - 1) / (critical - 1)
        half = (len(place) - stick) // 2
        lower = place[stick : stick + half] - 1  # the upper half are the same places, seen from psi_c
        column, by_psi = cubic(root(lower), root(min(y, 1 - y)))
        column += stick + (half if y > 0.5 else 0)
        closed = full / psi - 1
    ex = weights @ table["ex"][first : first + 4, 0, column : column + 4, 0] @ by_psi
    return ez, float(ex) + closed


def main(arguments):
    if len(arguments) not in (1, 3):
        sys.exit(__doc__)
    with h5py.File(arguments[0], "r") as table:
        if table.attrs["kind"] != b"contact" or len(table["speed"]) < 4 or len(table["psi"]) < 4:
            sys.exit(f"{arguments[0]}: not a table of one contact with friction of a solid whose ez changes with speed")
        if len(arguments) == 3:
            v_n, v_t = float(arguments[1]), float(arguments[2])
            print(f"# restitute {table.attrs['restitute_version'].decode()}, verified errors", end=" ")
            print(f"{table.attrs['error_ez']:.1e} (ez), {table.attrs['error_ex']:.1e} (ex)")
            print("ez = {:.15g}\nex = {:.15g}".format(*pair_at(table, v_n, v_t)))
            return
        print("speed_m_s,ez")
        low, high = table.attrs["range_first_low"], table.attrs["range_first_high"]
        for v_n in np.geomspace(low, high, 61):
            print(f"{v_n:.6g},{ez_at(table, v_n)[0]:.9f}")


if __name__ == "__main__":
    main(sys.argv[1:])
