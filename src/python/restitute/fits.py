# SPDX-License-Identifier: BSD-3-Clause
"""What fits give: constants with intervals, remarks, curves for figures."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from restitute import _library
from restitute.materials import Material, document, write_file

__all__ = ["MEASURED", "DmaFit", "DropFit", "Fit"]

_METAL, _STIFF = 3000.0, 1e9  # kg/m^3 and Pa: no soft solid is as dense

#: What a drop test may measure.
MEASURED = ("ez", "ex", "contact_time")


class Fit:
    """What fits have in common; print one to see it all, `save` its material for other programs.

    Attributes
    ----------
    material : Material
        The fitted solid. Its `window` is that of the contact times of the data, of DMA 1/(2 f).
    names : list of str
        Its n constants, e.g. "modulus1_pa", then "friction" and "shift_..." where fitted.
    value, low, high : ndarray, shape (n,)
        And their intervals. 0 or inf: no such bound; both the value: known; nan: no interval.
    correlation : ndarray, shape (n, n)
        Of their logarithms, of drop tests.
    remarks : list of str
        What the data leave open, and what the model misses.
    flags : int
        Bits of `restitute_fit_flag`; `is_good` sums them up.
    """

    summary = ""
    assumed = False  #: A drop test without any scale: the modulus is none of the data
    correlation = np.empty((0, 0))

    def __init__(self, struct: Any, model: str, constants: list, **about: Any):
        self.remarks, self.flags = _library.text(struct.remarks).splitlines(), struct.flags
        self.model, self.rms = model, struct.rms
        self.material = Material(struct.material, model=model, **about)
        names, *numbers = zip(*constants)
        self.names, (self.value, self.low, self.high) = list(names), np.array(numbers)

    def origin(self, data: str = "") -> str:
        """The source that the material file names, with a name of the data."""
        return (f"restitute {_library.text(_library.core.restitute_version())} fit"
                f"{' of ' if data else ''}{data}: {'modulus assumed; ' if self.assumed else ''}"
                f"{self.summary}")

    @property
    def is_good(self) -> bool:
        """The data follow the model and determine its constants, and the search has ended."""
        bad = ("UNDETERMINED", "MISFIT", "UNFINISHED")
        return not any(self.flags & getattr(_library.fit, f"RESTITUTE_FIT_FLAG_{word}")
                       for word in bad)

    @property
    def verdict(self) -> str:
        """Whether the model fits within the scatter of the data, in a line."""
        flags = self.flags
        if flags & _library.fit.RESTITUTE_FIT_FLAG_UNFINISHED:
            return "nothing tells whether the model fits: the search has not ended"
        if flags & _library.fit.RESTITUTE_FIT_FLAG_MISFIT:
            return "the model does not fit: the data do not follow it"
        if np.isnan(getattr(self, "noise", 0.0)):
            return "nothing tells whether the model fits: no more values than constants"
        rest = ("; what is not determined does not matter to e at these speeds"
                if flags & _library.fit.RESTITUTE_FIT_FLAG_UNDETERMINED else "")
        return f"the model fits within the scatter of the data{rest}"

    def save(self, path: str | os.PathLike) -> None:
        """Write the material file that the command, C and the adapters read: see `Material.save`.

        The constants in it are those of the model.
        """
        write_file(path, self.document())

    def document(self) -> dict[str, Any]:
        """What the material file says."""
        constants = {name: value for name, value in zip(self.names, self.value.tolist())
                     if "modulus" in name or "viscosity" in name}
        return document(self.material, None if self.model == "prony" else constants)

    def __str__(self):
        lines = []
        for name, value, low, high in zip(self.names, self.value, self.low, self.high):
            ends = ("" if np.isnan(low) else " known" if low == high else
                    f" {low:.6g} to {high:.6g}" if 0 < low and high < np.inf else
                    f" above {low:.6g}" if low > 0 else
                    f" below {high:.6g}" if high < np.inf else " not determined")
            lines.append(f"  {name:26} {value:<13.6g}{ends}".rstrip())
        for i, row in enumerate(self.correlation[1:], 1):
            lines += ["", "  correlations of the logarithms"] if i == 1 else []
            lines.append(f"  {self.names[i]:26} " + " ".join(f"{c:6.3f}" for c in row[:i]))
        return "\n".join([*lines, "", f"  {self.summary}", f"  {self.verdict}"])

    def __repr__(self):
        return "\n".join([f"<restitute.{type(self).__name__} {self.model}", str(self),
                          *(f"  remark: {remark}" for remark in self.remarks)]) + ">"


class DropFit(Fit):
    """A fit of m measured impacts.

    Attributes
    ----------
    values, rank, impacts : int
        Measured values; combinations of constants that they determine; impacts solved.
    rms, noise, condition : float
        Of the weighted residuals; noise is nan if no degree of freedom is left.
    measured : dict of ndarray, shape (m,)
        "ez", "ex", "contact_time" (s), nan where there is none, and "normal_speed" (m/s).
    fitted : dict of ndarray, shape (m,)
        "ez", "ex", "contact_time" that the solid gives, measured or not.
    """

    def __init__(self, struct: Any, model: str, confidence: float, measured: dict, fitted: dict,
                 window: tuple | None, **about: Any):
        n = struct.constants
        self.assumed = "as of 1 MPa are assumed" in _library.text(struct.remarks)
        super().__init__(struct, model, [
            (_library.text(struct.name[k]), struct.value[k], struct.low[k], struct.high[k])
            for k in range(n)], window=None if self.assumed else window, **about)
        self.correlation = np.array([list(struct.correlation[k])[:n] for k in range(n)])
        self.values, self.rank, self.impacts = struct.values, struct.rank, struct.impacts
        self.noise, self.condition = struct.noise, struct.condition
        self.measured, self.fitted, self.confidence = measured, fitted, confidence
        self.summary = (
            f"rms of the residuals of {self.values} values {self.rms:.3g}, noise {self.noise:.3g}; "
            f"{self.rank} constants or combinations of them determined, intervals of "
            f"{100 * self.confidence:g} %; {self.impacts} impacts solved")
        self.material.source = self.origin()
        series, density = self.material.series, self.material.density
        if density > _METAL and series.equilibrium_modulus + series.modulus.sum() < _STIFF:
            self.remarks.append(f"density = {density:g} kg/m^3 is taken to be that of the fitted "
                                "solid: of a steel ball on rubber give the mass instead")

    @property
    def residuals(self) -> dict[str, np.ndarray]:
        """Measured minus fitted, likewise."""
        return {name: self.measured[name] - self.fitted[name] for name in MEASURED}

    def curves(self) -> dict[str, tuple]:
        """Speed, measured and fitted values, for `restitute.plot.fit`."""
        speed = self.measured["normal_speed"]
        return {name: (speed, self.measured[name], self.fitted[name]) for name in MEASURED}


class DmaFit(Fit):
    """A Prony series from moduli.

    Attributes
    ----------
    temperature, shift : ndarray, shape (m,)
        Distinct temperatures and their a_T, by which times are multiplied.
    wlf : (float, float)
        C1 and C2, given, or fitted to the shifts; nan: none.
    rms, worst : float
        Of the relative residuals.
    """

    def __init__(self, struct: Any, tension: bool, measured: list, **about: Any):
        terms, count = struct.terms, struct.temperatures
        self.temperature = np.array(list(struct.temperature)[:count])
        self.shift, self.worst = np.array(list(struct.shift)[:count]), struct.worst
        self.wlf = (struct.wlf_c1, struct.wlf_c2)
        constants = [("equilibrium_modulus_pa", struct.equilibrium_modulus)]
        constants += [(f"modulus_pa[tau={struct.relaxation_time[k]:.6g}]", struct.modulus[k])
                      for k in range(terms)]
        constants += [(f"shift_{t:g}", shift) for t, shift in zip(self.temperature, self.shift)]
        constants += [(f"wlf_c{k + 1}", c) for k, c in enumerate(self.wlf) if not np.isnan(c)]
        self._tension, self._measured = tension, measured
        f = self._reduced()  # a contact of time t is half a sine
        window = (0.5 / f.max(), 0.5 / f.min()) if f.max() > f.min() else None
        super().__init__(struct, "prony", [(*one, np.nan, np.nan) for one in constants],
                         window=window, **about)
        self.summary = (f"Prony series of {terms} terms, relative residuals: rms {self.rms:.3g}, "
                        f"largest {self.worst:.3g}")
        self.material.source = self.origin()

    def _reduced(self):
        """a_T times frequency."""
        frequency, _, _, *temperature = self._measured
        if not temperature:
            return frequency
        return frequency * self.shift[np.searchsorted(self.temperature, temperature[0])]

    def curves(self) -> dict[str, tuple]:
        """a_T times frequency, measured and fitted shear moduli, for `restitute.plot.fit`."""
        frequency, (_, storage, loss, *_) = self._reduced(), self._measured
        factor = 1 / (2 * (1 + self.material.poisson_ratio)) if self._tension else 1
        omega = 2 * np.pi * frequency
        return {"storage": (frequency, factor * storage, self.material.storage_modulus(omega)),
                "loss": (frequency, factor * loss, self.material.loss_modulus(omega))}
