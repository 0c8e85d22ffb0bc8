#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reads the file of a table with h5py, and looks up pairs in it.

A table of one contact:
    read_table.py FILE V_N V_T      prints what the file says of itself, and ez and ex of an impact (m/s)
    read_table.py FILE              prints ez over the speed, as CSV

A table with axes of delta1 and gamma:
    read_table.py FILE CHI PSI DELTA1 GAMMA

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
BELOW_ONE = 1 - 2.0**-53


def cubic(nodes, x):
    """First of the four nodes of the cell that x is in, and their weights; cells share the nodes at their ends."""
    first = 3 * min(max(np.searchsorted(nodes[::3], x, side="right") - 1, 0), (len(nodes) - 1) // 3 - 1)
    own = nodes[first : first + 4]
    weights = [np.prod([(x - b) / (a - b) for b in own if b != a]) for a in own]
    return first, np.array(weights)


def root(y):
    return np.sqrt(y + SOFT**2) - SOFT


def stick_nodes(table):
    """How many places of psi are at most 1; the others, if there are any, lie between 1 and psi_c."""
    return 3 * table.attrs["stick_cells"] + 1


def by_inverse(table):
    """Whether cubics are of 1/(1 + ez) and of what ex exceeds the closed form of full slip by, on both sides of psi = 1."""
    return table.attrs["slip_cells"] > 0 and 0.5 < table.attrs["own_chi"] <= 2


def ez_at(table, v_n):
    """ez, and where its nodes are; beyond the ends of the table those of the ends."""
    speed = table["speed"][:]
    v_n = min(max(v_n, table.attrs["range_first_low"]), table.attrs["range_first_high"])
    first, weights = cubic(speed, v_n)
    nodes = table["ez"][first : first + 4, 0]
    ez = 1 / (weights @ (1 / (1 + nodes))) - 1 if by_inverse(table) else weights @ nodes
    return float(min(max(ez, 0), 1)), first, weights


def pair_at(table, v_n, v_t):
    """ez and ex of an impact. Full slip is its closed form, from psi_c on."""
    chi, psi = table.attrs["own_chi"], table.attrs["psi_factor"] * abs(v_t) / v_n
    ez, first, weights = ez_at(table, v_n)
    full = 2 * chi * (1 + ez)
    critical = full - ez if 2 * chi > 1 else 1
    if psi > critical:
        return ez, full / psi - 1
    place, stick = table["psi"][:], stick_nodes(table)
    kept = table["ex"][first : first + 4, 0, :, 0]
    if psi <= 1:
        column, by_psi = cubic(place[:stick], psi)
        closed = 0
        if by_inverse(table):  # as on the other side of psi = 1
            closed = full - 1
            kept = kept - (2 * chi * (1 + table["ez"][first : first + 4]) - 1)
    else:
        y = (psi - 1) / (critical - 1)
        half = (len(place) - stick) // 2
        lower = place[stick : stick + half] - 1  # the upper half are the same places, seen from psi_c
        column, by_psi = cubic(root(lower), root(min(y, 1 - y)))
        column += stick + (half if y > 0.5 else 0)
        closed = full / psi - 1
    ex = float(weights @ kept[:, column : column + 4] @ by_psi) + closed
    return ez, min(max(ex, -1), 1)


def find_leaf(leaves, chain, octave, root_of_w, sheet, gamma, places):
    """The cell that a place is in, and places in [0, 1) in it along w, gamma, chi and psi. places: w, chi, psi in [0, 1) of the root."""
    whole, left = 0, list(places)
    for along in chain:  # the halves that the place is in, one bit each
        left[along] *= 2
        whole = 2 * whole + int(left[along])
        left[along] %= 1
    octaves, roots, sheets, depth, path, level, part = leaves.T
    here = (octaves == octave) & (roots == root_of_w) & (sheets == sheet)
    here &= (path == whole >> (len(chain) - depth)) & (part == np.floor(gamma * 2.0**level))
    leaf = np.flatnonzero(here)[0]
    halvings = np.bincount(chain[: depth[leaf]], minlength=3)
    w, chi, psi = (u * 2.0**n % 1 for u, n in zip(places, halvings))
    return leaf, (w, gamma * 2.0 ** level[leaf] % 1, chi, psi)


def polynomial(coefficients, functions, places):
    """Coefficients belong to products of functions of u in [0, 1), five along each axis."""
    total = coefficients.astype(float)
    for u, own in zip(places, functions.T):
        parabola = 4 * u * (1 - u)
        part = 4 / 3 * (2 * u - 1) * parabola
        total = total * np.array([1 - u, part * (4 * u - 3), parabola, part * (4 * u - 1), u])[own]
    return total.sum()


def place_in_roots(table, delta1, gamma):
    """Octave of gamma, root of w, and places in [0, 1) in them. w = delta1 h, and h is the cubic through its nodes of the octave."""
    gamma = min(gamma, np.nextafter(table.attrs["axis_gamma_high"], 0))
    octave = np.frexp(gamma / table.attrs["axis_gamma_low"])[1] - 1
    start = table.attrs["axis_gamma_low"] * 2.0**octave
    nodes = start * (1 + np.arange(4) / 3)
    h = cubic(nodes, gamma)[1] @ (nodes**0.56 * (1 + nodes) ** 0.44)
    along_w = np.log2(delta1 * h) / 2.0 ** table.attrs["w_width"] - table.attrs["w_first"]
    root_of_w = min(max(int(along_w), 0), table.attrs["w_roots"] - 1)
    return octave, root_of_w, gamma / start - 1, min(max(along_w - root_of_w, 0), BELOW_ONE)


def sheet_of(psi, critical):
    """Sheet of psi, place in [0, 1) on it, and y."""
    if psi <= 1:
        return 0, min(psi, BELOW_ONE), 0
    y = min((psi - 1) / (critical - 1), 1)
    t = root(y) / (2 * root(0.5)) if y <= 0.5 else 1 - root(1 - y) / (2 * root(0.5))
    quarter = min(int(4 * t), 3)
    return 1 + quarter, min(4 * t - quarter, BELOW_ONE), y


def numbers_pair(table, chi, psi, delta1, gamma):
    """ez and ex by the dimensionless numbers; beyond its ranges the ends of the table."""
    ranges = [[table.attrs[f"range_{name}_{end}"] for end in ("low", "high")] for name in ("chi", "first", "gamma")]
    chi, delta1, gamma = (min(max(x, low), high) for x, (low, high) in zip((chi, delta1, gamma), ranges))
    octave, root_of_w, by_gamma, by_w = place_in_roots(table, delta1, gamma)
    chain = np.zeros(12, dtype=int)  # ez: along w alone
    functions = table["functions"][:]
    leaf, places = find_leaf(table["rebound_leaves"][:], chain, octave, root_of_w, 0, by_gamma, (by_w, 0, 0))
    of_ez = functions[functions[:, 2:].sum(axis=1) == 0]  # of w and gamma alone
    ez = min(max(polynomial(table["ez"][leaf], of_ez, places), 0), 1)
    full = 2 * chi * (1 + ez)
    critical = full - ez if 2 * chi > 1 else 1
    if psi > critical:
        return ez, full / psi - 1
    sheet, by_psi, y = sheet_of(psi, critical)
    low, high = ranges[0]
    by_chi = min((chi - low) / (high - low), BELOW_ONE) if low < high else 0
    by_axis = (by_w, by_chi, by_psi)
    leaf, places = find_leaf(table["leaves"][:], table["chain"][:], octave, root_of_w, sheet, by_gamma, by_axis)
    kept = polynomial(table["ex"][leaf], functions, places)
    return ez, float(min(max((kept + y * ez) / max(psi, 1), -1), 1))


def print_pair(table, pair):
    print(f"# restitute {table.attrs['restitute_version'].decode()}, verified errors", end=" ")
    print(f"{table.attrs['error_ez']:.1e} (ez), {table.attrs['error_ex']:.1e} (ex)")
    print("ez = {:.15g}\nex = {:.15g}".format(*pair))


def main(arguments):
    if len(arguments) not in (1, 3, 5):
        sys.exit(__doc__)
    numbers = [float(text) for text in arguments[1:]]
    with h5py.File(arguments[0], "r") as table:
        if len(arguments) == 5:
            if table.attrs["cells"] == 0:
                sys.exit(f"{arguments[0]}: not a table with axes of delta1 and gamma")
            print_pair(table, numbers_pair(table, *numbers))
            return
        if table.attrs["kind"] != b"contact" or len(table["speed"]) < 4 or len(table["psi"]) < 4:
            sys.exit(f"{arguments[0]}: not a table of one contact with friction of a solid whose ez changes with speed")
        if len(arguments) == 3:
            print_pair(table, pair_at(table, *numbers))
            return
        print("speed_m_s,ez")
        low, high = table.attrs["range_first_low"], table.attrs["range_first_high"]
        for v_n in np.geomspace(low, high, 61):
            print(f"{v_n:.6g},{ez_at(table, v_n)[0]:.9f}")


if __name__ == "__main__":
    main(sys.argv[1:])
