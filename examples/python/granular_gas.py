# SPDX-License-Identifier: BSD-3-Clause
"""How a gas of rubber balls cools: direct simulation Monte Carlo with e_z and e_x from a table.

    python3 granular_gas.py [FIGURE]        default: granular_gas.svg

Collisions in a homogeneous gas are drawn at random, thousands in one step. A gas with a constant
e_z and no friction goes first: its temperature must follow Haff's law.
"""

import sys

import numpy as np

import restitute

SPHERES, PER_STEP = 10000, 1000  # and pairs that may collide in one step
RADIUS, DENSITY = 0.001, 1200.0  # m, kg/m^3
MASS = 4 / 3 * np.pi * RADIUS**3 * DENSITY
PATH = 0.01  # m, mean free path: 1 / (number density times pi times diameter squared)


def cool(pair, speed, coldest, rng):
    """Times (s) and temperatures (J) of a gas that starts without spin, until it is `coldest`.

    `speed` is the standard deviation of a component of the velocity, `pair(normal, sliding)` gives
    e_z and e_x.
    """
    velocity = speed * rng.standard_normal((SPHERES, 3))
    spin = np.zeros_like(velocity)
    start = energy(velocity, spin)
    lost = time = 0.0
    course = [(0.0, temperature(velocity))]
    while course[-1][1] > coldest:
        # A pair that meets in direction k collides at a rate proportional to its approach.
        i, j = rng.permutation(SPHERES)[: 2 * PER_STEP].reshape(2, -1)
        k = rng.standard_normal((PER_STEP, 3))
        k /= np.linalg.norm(k, axis=1, keepdims=True)
        fastest = 2 * np.linalg.norm(velocity, axis=1).max()
        approach = np.sum((velocity[i] - velocity[j]) * k, axis=1)
        hits = approach > fastest * rng.random(PER_STEP)
        i, j, k = i[hits], j[hits], k[hits]
        time += PER_STEP * PATH / (2 * SPHERES * fastest)

        lost += collide(velocity, spin, i, j, k, pair)
        course.append((time, temperature(velocity)))
    # Impacts lose what e_z and e_x say; nothing else may change the energy.
    assert abs(start - energy(velocity, spin) - lost) < 1e-9 * start
    return np.transpose(course)


def collide(velocity, spin, i, j, k, pair):
    """Impacts of the spheres i and j, k from i to j. Returns the energy lost (J)."""
    relative = velocity[i] - velocity[j] + RADIUS * np.cross(spin[i] + spin[j], k)
    normal = np.sum(relative * k, axis=1)
    sliding = relative - normal[:, None] * k
    slip = np.linalg.norm(sliding, axis=1)
    ez, ex = pair(normal, slip)
    # Solid spheres: a tangential impulse J changes the sliding velocity by 7 J/m.
    impulse = MASS * ((1 + ez) * normal / 2)[:, None] * k + MASS / 7 * (1 + ex)[:, None] * sliding
    velocity[i] -= impulse / MASS
    velocity[j] += impulse / MASS
    turn = np.cross(k, impulse) * RADIUS / (0.4 * MASS * RADIUS**2)
    spin[i] -= turn
    spin[j] -= turn
    return MASS * np.sum((1 - ez**2) * normal**2 / 4 + (1 - ex**2) * slip**2 / 14)


def temperature(velocity):
    return MASS * np.mean(velocity**2)


def energy(velocity, spin):
    return MASS / 2 * np.sum(velocity**2) + 0.2 * MASS * RADIUS**2 * np.sum(spin**2)


def main():
    speed, rng = 0.02, np.random.default_rng(1)
    hot = MASS * speed**2
    time, constant = cool(lambda vn, vt: (0.8 + 0 * vn, 0 * vt - 1), speed, 0.02 * hot, rng)
    # Haff's law, with the collision rate of Maxwell's distribution.
    rate = 4 / np.sqrt(np.pi) * speed / PATH * (1 - 0.8**2) / 6
    worst = np.abs(constant * (1 + rate * time) ** 2 / hot - 1).max()
    print(f"constant e_z: Haff's law holds within {worst:.1%}")
    # The true velocities are not quite Maxwell's: 2 % by e_z = 0.8; 1 % is noise.
    assert worst < 0.03

    rubber = restitute.Material.standard_solid(1e6, 3e6, 300.0, name="rubber")
    table = restitute.Table.build(
        rubber, radius=RADIUS, density=DENSITY, radius2=RADIUS, density2=DENSITY, partner="same",
        friction=0.3, speeds=(1e-7, 1), tolerance=1e-3, threads=0,
    )
    print(table)
    later, cooled = cool(lambda vn, vt: table.pair(vn, vt, check=False), speed, 0.02 * hot, rng)
    flagged = np.mean(table.flags(speed * np.abs(rng.standard_normal(1000))) != 0)
    print(f"rubber: {later[-1]:.1f} s to a fiftieth, constant e_z: {time[-1]:.1f} s")
    print(f"at the beginning {flagged:.0%} of the impacts pass a limit of the model")

    ax = restitute.plot.sheet(title="Two granular gases cool", note="DSMC of 10000 spheres")
    ax.loglog(time[1:], constant[1:] / hot, label="constant e_z = 0.8")
    ax.loglog(later[1:], cooled[1:] / hot, label="rubber, friction 0.3")
    ax.set(xlabel="time (s)", ylabel="temperature / initial")
    ax.legend(frameon=False)
    figure = sys.argv[1] if len(sys.argv) > 1 else "granular_gas.svg"
    restitute.plot.save(ax, figure)
    print("figure:", figure)


if __name__ == "__main__":
    main()
