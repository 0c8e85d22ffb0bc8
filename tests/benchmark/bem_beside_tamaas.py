# SPDX-License-Identifier: BSD-3-Clause
"""The elastic normal problem by restitute and by tamaas 2.9.0, side by side:
bem_beside_tamaas.py BEM_HERTZ [M]

BEM_HERTZ is the program of bem_hertz.c. Needs tamaas==2.9.0 (pip). tamaas gets the force that
restitute found, on the same cells, without images (its operator dcfft). Prints the largest
difference of pressures over the largest pressure, and both times.
"""
import subprocess
import sys
import tempfile
import time

import numpy as np
import tamaas as tm

program, m = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 128
with tempfile.NamedTemporaryFile() as file:
    out = subprocess.run([program, str(m), file.name], check=True, capture_output=True, text=True).stdout
    spacing, force, iterations, seconds = (float(word) for word in out.split())
    quarter = np.loadtxt(file.name)
ours = np.block([[quarter[::-1, ::-1], quarter[::-1, :]], [quarter[:, ::-1], quarter]])

tm.set_log_level(tm.LogLevel.error)
tm.initialize(1)
n, side = 2 * m, 2 * m * spacing
x = (np.arange(n) - m + 0.5) * spacing
surface = -(x[:, None] ** 2 + x[None, :] ** 2) / 2
model = tm.ModelFactory.createModel(tm.model_type.basic_2d, [side, side], [n, n])
model.E, model.nu = 4.0, 0.0  # E* = 4
tm.ModelFactory.registerNonPeriodic(model, "dcfft")
best = float("inf")
for _ in range(3):
    model.traction[:] = 0
    solver = tm.PolonskyKeerRey(model, surface, 1e-7)
    solver.setIntegralOperator("dcfft")
    before = time.perf_counter()
    solver.solve(force / side**2)
    best = min(best, time.perf_counter() - before)
theirs = np.asarray(model.traction).reshape(n, n)
print(f"{n} x {n} cells: largest difference {np.abs(ours - theirs).max() / ours.max():.2e} of the largest pressure, "
      f"restitute {seconds:.4f} s ({iterations:.0f} iterations), tamaas {tm.__version__} {best:.4f} s")
