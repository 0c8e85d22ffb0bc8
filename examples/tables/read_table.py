#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reads the file of a table with h5py, and looks up pairs in it.

    read_table.py FILE V_N V_T      prints the file's description, and ez and ex of an impact (m/s)
    read_table.py FILE              prints ez over the speed, as CSV

The library itself is not needed: all that a table is stands in its file
(include/restitute/table_files.h). Exit status 77: h5py is not installed.
"""

import math
import sys

try:
    import h5py
    import numpy as np
except ImportError as missing:
    print(f"{missing}: python3 -m pip install h5py", file=sys.stderr)
    sys.exit(77)

# s(v) = k + p(m - 1) for v = 2^k m, 1 <= m < 2: log2(v) within 7e-7
P = [0.014565551164493075, -0.07702542887920055, 0.19215686619879618, -0.3255206379958932, 0.4738685537384745]
P += [-0.7207275153258296, 1.4426826110991595, 0]
C = 2e-4


def along_speed(v):
    fraction, exponent = math.frexp(v)
    return exponent - 1 + np.polyval(P, 2 * fraction - 1)


def along_psi(y):
    return 0.5 + (y - 0.5) * (1 + C**0.25 - (y * (1 - y) + C) ** 0.25)


def hermite(u, width):
    """Weights of value and slope at u = 0, then at u = 1, of a cell of that width."""
    return np.array([(1 - u) ** 2 * (1 + 2 * u), width * (1 - u) ** 2 * u, u**2 * (3 - 2 * u), -width * u**2 * (1 - u)])


def find_speed(table, v_n):
    """Lower node of the cell of speed, and the weights of both nodes."""
    v = min(max(v_n, table["numbers"]["low"]), table["numbers"]["high"])
    nodes = table["speed"][:]
    i = min(np.searchsorted(nodes, v, side="right") - 1, len(nodes) - 2)
    low, high = along_speed(nodes[i]), along_speed(nodes[i + 1])
    return i, hermite((along_speed(v) - low) / (high - low), high - low)


def ez_at(table, v_n):
    i, weights = find_speed(table, v_n)
    return float(min(max(weights @ table["ez"][i : i + 2].ravel(), 0), 1))


def pair_at(table, v_n, v_t):
    numbers = table["numbers"][()]
    chi, psi = numbers["chi"], numbers["psi_factor"] * abs(v_t) / v_n
    stick, slip = numbers["stick_cells"], numbers["slip_cells"]
    ez = ez_at(table, v_n)
    width = max(2 * chi - 1, 0) * (1 + ez)  # psi_c - 1
    if psi > 1 and psi - 1 >= width:
        return ez, 2 * chi * (1 + ez) / psi - 1  # slip to the end (27)
    y = (psi - 1) / width if psi > 1 else 0
    place = along_psi(y) * slip if psi > 1 else psi * stick
    cell = min(int(place), (slip if psi > 1 else stick) - 1)
    i, by_speed = find_speed(table, v_n)
    first = cell + (stick + 1 if psi > 1 else 0)
    nodes = table["ex"][i : i + 2, first : first + 2]  # [speed][psi][g, dg/ds, dg/dp, d2g/ds dp]
    by_psi = hermite(place - cell, 1)
    g = 0
    for n in range(2):
        for m in range(2):
            f, f_s, f_p, f_sp = nodes[n, m]
            g += by_speed[2 * n] * (by_psi[2 * m] * f + by_psi[2 * m + 1] * f_p)
            g += by_speed[2 * n + 1] * (by_psi[2 * m] * f_s + by_psi[2 * m + 1] * f_sp)
    return ez, float(min(max((g + y * ez) / max(psi, 1), -1), 1))


def main(arguments):
    if len(arguments) not in (1, 3):
        sys.exit(__doc__)
    with h5py.File(arguments[0], "r") as table:
        if len(arguments) == 3:
            numbers = table["numbers"][()]
            print(f"# restitute {numbers['restitute_version'].decode()}, verified errors", end=" ")
            print(f"{numbers['error_ez']:.1e} (ez), {numbers['error_ex']:.1e} (ex)")
            print("ez = {:.15g}\nex = {:.15g}".format(*pair_at(table, *[float(text) for text in arguments[1:]])))
            return
        print("speed_m_s,ez")
        for v_n in np.geomspace(table["numbers"]["low"], table["numbers"]["high"], 61):
            print(f"{v_n:.6g},{ez_at(table, v_n):.9f}")


if __name__ == "__main__":
    main(sys.argv[1:])
