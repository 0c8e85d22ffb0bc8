# SPDX-License-Identifier: BSD-3-Clause
"""Every allocation of our libraries beneath the Python package fails in turn, alone and with all
after it: MemoryError, or a result that is right; and then the same call gives the right result.

    LD_PRELOAD=librestitute_faults.so PYTHONPATH=PACKAGE python3 memory.py
"""
import ctypes
import os
import tempfile

import numpy as np

import restitute

FAIL = ctypes.CDLL(None).fault_memory
BALL = {"radius": 0.005, "density": 7800, "friction": 0.3}
rubber = restitute.Material.standard_solid(1e6, 3e6, 300.0, poisson_ratio=0.5)
speeds = np.linspace(0.1, 0.5, 4)


def built():
    return restitute.Table.build(rubber, speeds=(0.1, 0.1), tolerance=1e-2, **BALL)


table = built()
path = os.path.join(tempfile.mkdtemp(), "t.h5")
drops = {"speed": speeds, "ez": [0.9, 0.86, 0.83, 0.8], "starts": 1, "model": "kelvin_voigt",
         **{name: BALL[name] for name in ("radius", "density")}}
curve = np.array([0.01, 0.1, 1, 10, 100]), np.array([1, 2, 5, 10, 12]) * 1e5, np.array(
    [5, 10, 20, 20, 10]) * 1e4
CALLS = {
    "material": lambda: restitute.Material.prony([1e-3], [1e6], 1e6).relaxation_modulus(1e-3),
    "material by name": lambda: restitute.material("polyisobutylene").relaxation_modulus(1e-3),
    "pair": lambda: restitute.pair(rubber, speed=speeds, angle=30, **BALL).ex,
    "history": lambda: restitute.history(rubber, speed=0.1, samples=9, **BALL).normal_force,
    "cvode": lambda: restitute.pair(rubber, speed=0.1, method="cvode", **BALL).ez,
    "bem": lambda: restitute.pair(rubber, speed=0.1, method="bem", tolerance=0.1, **BALL).ez,
    "table": lambda: built().pair(0.1, 0.05).ex,
    "table file": lambda: (table.save(path), restitute.Table.load(path).pair(0.1, 0.05).ex)[1],
    "contact law": lambda: restitute.ContactLaw(rubber).time_scale(0.01, 0.01, 0.1),
    "drop test": lambda: restitute.fit_drop_test(**drops).value,
    "DMA": lambda: restitute.fit_dma(*curve).value,
}


def main():
    failures = 0
    for name, call in CALLS.items():
        try:
            expected = np.asarray(call()).tobytes()
        except restitute.errors.MissingComponent:
            continue
        FAIL(10**9, 0)  # none: they are counted
        call()
        count, refused = FAIL(0, 0), 0
        for for_good in (0, 1):
            for number in {*range(1, min(count, 40) + 1), *range(40, count + 1, count // 40 + 1)}:
                FAIL(number, for_good)
                try:
                    right = np.asarray(call()).tobytes() == expected
                except MemoryError:
                    right, refused = True, refused + 1
                finally:
                    FAIL(0, 0)
                if not right or np.asarray(call()).tobytes() != expected:
                    failures += 1
                    print(f"FAILED: {name}, allocation {number} of {count}", flush=True)
        if not refused:
            failures += 1
            print(f"FAILED: {name}: none of {count} allocations is missed")
        print(f"memory of {name}: {count} allocations, {refused} refusals", flush=True)
    return failures


if __name__ == "__main__":
    raise SystemExit(min(main(), 1))
