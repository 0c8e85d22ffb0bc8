# SPDX-License-Identifier: BSD-3-Clause
"""Constants of a material from measured impacts, or from storage and loss moduli (component fit, under the GPL)."""
from __future__ import annotations

from typing import Any

import numpy as np

from restitute import _library, errors
from restitute._library import call, ffi
from restitute.materials import Material
from restitute.scenes import Impacts

__all__ = ["DmaFit", "DropFit", "fit_dma", "fit_drop_test"]

MODELS = {"elastic": ("modulus",), "kelvin_voigt": ("modulus1", "viscosity"),
          "standard_solid": ("modulus1", "modulus2", "viscosity"), "maxwell": ("modulus", "viscosity"),
          "prony": ("equilibrium",)}
LOSSES = ("squares", "huber", "cauchy")
GRAVITY = 9.80665  # m/s^2
_MEASURED = ("ez", "ex", "contact_time")


class _Fit:
    """What every fit has: `remarks`, a list of texts; `flags`, bits of `restitute_fit_flag`; `material`."""

    def __init__(self, struct, model, about):
        self.__dict__.update(_library.members(struct))
        self.remarks = self.remarks.splitlines()
        self.model = model
        self.material = Material(struct.material, about.pop("name", ""), about.pop("source", ""), model, **about)

    @property
    def is_good(self) -> bool:
        """The data follow the model and determine its constants, and the search came to its end."""
        fit = _library.fit
        return not self.flags & (fit.RESTITUTE_FIT_FLAG_UNDETERMINED | fit.RESTITUTE_FIT_FLAG_MISFIT
                                 | fit.RESTITUTE_FIT_FLAG_UNFINISHED)


class DropFit(_Fit):
    """A fit of measured impacts.

    Attributes
    ----------
    names : list of str
        The n constants: those of the solid, e.g. "modulus1_pa", then "friction" and shifts.
    value, low, high : ndarray, shape (n,)
        And their intervals. 0 or inf: no such bound; both the value: known.
    correlation : ndarray, shape (n, n)
        Of the logarithms.
    values, rank : int
        Measured values, and combinations of constants that they determine.
    rms, noise, condition : float
        Of the weighted residuals; condition number of the Jacobian.
    measured : dict of ndarray, shape (m,)
        "ez", "ex", "contact_time" of the m points, and their "normal_speed"; nan: not measured.
    remarks, flags, is_good, material, model, impacts
        What the data leave open or the model misses, in words and as bits; the fitted solid.
    """

    def __init__(self, struct, model, fitter, measured, about):
        super().__init__(struct, model, about)
        n = self.constants
        self.names = [_library.text(struct.name[k]) for k in range(n)]
        self.value, self.low, self.high = (np.array(one[:n]) for one in (self.value, self.low, self.high))
        self.correlation = np.array([list(struct.correlation[k])[:n] for k in range(n)])
        self.measured, self._fitter, self._fitted = measured, fitter, None

    @property
    def fitted(self) -> dict:
        """What the fitted solid gives for each point: arrays "ez", "ex", "contact_time" of shape (m,)."""
        if self._fitted is None:
            arrays = [np.empty(len(self.measured["ez"])) for _ in _MEASURED]
            self._fitter.call(_library.fit.restitute_fitter_values, self._fitter.handle, *map(_library.pointer, arrays))
            self._fitted = dict(zip(_MEASURED, arrays))
        return self._fitted

    @property
    def residuals(self) -> dict:
        """Measured minus fitted, likewise."""
        return {name: self.measured[name] - self.fitted[name] for name in _MEASURED}

    def __repr__(self):
        lines = [f"{name} = {value:.6g} ({low:.6g} to {high:.6g})"
                 for name, value, low, high in zip(self.names, self.value, self.low, self.high)]
        return "\n".join([f"<restitute.DropFit {self.model}", *lines, *self.remarks]) + ">"


class DmaFit(_Fit):
    """A Prony series from moduli.

    Attributes
    ----------
    equilibrium_modulus : float
        Pa.
    relaxation_time, modulus : ndarray, shape (n,)
        s, Pa.
    temperature, shift : ndarray, shape (m,)
        Distinct temperatures and a_T, by which times are multiplied.
    wlf_c1, wlf_c2 : float
        Given, or fitted to the shifts; nan: none.
    rms, worst : float
        Relative residuals.
    remarks, flags, is_good, material
        As of `DropFit`.
    """

    def __init__(self, struct, about):
        super().__init__(struct, "prony", about)
        for name in ("relaxation_time", "modulus"):
            setattr(self, name, np.array(getattr(self, name)[:self.terms]))
        for name in ("temperature", "shift"):
            setattr(self, name, np.array(getattr(self, name)[:self.temperatures]))

    def moduli(self, frequency):
        """Storage and loss modulus, Pa, at reduced frequencies a_T f (Hz), arrays of any shape."""
        x = 2 * np.pi * np.multiply.outer(np.asarray(frequency, float), self.relaxation_time)
        return (self.equilibrium_modulus + np.sum(self.modulus * x**2 / (1 + x**2), -1),
                np.sum(self.modulus * x / (1 + x**2), -1))

    def __repr__(self):
        return "\n".join([f"<restitute.DmaFit of {self.terms} terms, rms {self.rms:.3g}", *self.remarks]) + ">"


class _Fitter:
    """A restitute_fitter, and Ctrl-C while it works: the library asks in this thread, so that Python runs handlers of
    signals there. What they raise ends the call and is raised here."""

    def __init__(self, points, count, options, keep):
        self._raised, self._keep = None, keep
        self._ask = ffi.callback("int(void *)", lambda _: 0, error=1, onerror=self._note)
        options.interrupted = self._ask
        handle = ffi.new("restitute_fitter **")
        self.call(_library.fit.restitute_fitter_create, count, points, options, handle)
        self.handle = ffi.gc(handle[0], _library.fit.restitute_fitter_destroy)

    def _note(self, kind, value, trace):
        self._raised = value

    def call(self, function, *arguments):
        self._raised = None
        try:
            call(function, *arguments)
        except KeyboardInterrupt:
            raise self._raised or KeyboardInterrupt from None

    def run(self, progress):
        done = ffi.new("double *")
        while done[0] < 1:
            self.call(_library.fit.restitute_fitter_run, self.handle, done)
            if progress:
                progress(done[0])


def fit_drop_test(*, ez=np.nan, ex=np.nan, contact_time=np.nan, drop_height=None, rebound_height=None,
                  rebound_ratio=None, temperature=np.nan, weight=None, sigma_ez=None, sigma_ex=None,
                  sigma_contact_time=None, model="standard_solid", terms=(), known=None, poisson_ratio=0.5,
                  loss="squares", confidence=0.95, reference_temperature=np.nan, wlf=None, starts=0, seed=1, threads=1,
                  partner: Any = "rigid", friction=None, progress=None, name="", **scene) -> DropFit:
    """Fit the constants of a solid to measured impacts: some tenths of a second for twenty.

    Arrays broadcast; nan stands for what was not measured.

    Parameters
    ----------
    ez, ex, contact_time : array_like
        Measured; the time in s.
    drop_height, rebound_height : array_like, optional
        m, instead of `speed` (sqrt(2 g h)) and `ez` (sqrt(h_rebound/h_drop)); no air.
    rebound_ratio : array_like, optional
        Rebound over drop height (rebound resilience), in [0, 1]: ez is its root.
    temperature : array_like
        Relaxation times are multiplied by a_T: a fitted shift a temperature, or by `wlf`.
    weight : array_like, optional
        Relative weights; only ratios matter.
    sigma_ez, sigma_ex, sigma_contact_time : array_like, optional
        Standard deviations: the noise is then known.
    model : {"standard_solid", "kelvin_voigt", "maxwell", "elastic", "prony"}
    terms : array_like
        Relaxation times of the model prony, s; 1 to 20.
    known : dict, optional
        Constants that are not fitted, e.g. {"modulus1": 1e6}; of prony "equilibrium", "term1", ...
    poisson_ratio, loss, confidence, reference_temperature, starts, seed, threads
        As in `restitute_fit_options`; loss is "squares", "huber" or "cauchy".
    wlf : (float, float), optional
        C1 and C2 of the shifts.
    partner : "rigid", "same" or Material
        Of the other body; "same": both are of the solid that is looked for.
    friction : array_like, optional
        By default it is fitted where ex was measured.
    progress : callable, optional
        progress(part done).
    name : str
        Of the material.
    **scene
        As in `pair`: `radius`, `density` or `mass`, `speed`, `angle`, ...; partner="same": both bodies are
        of the solid.

    Returns
    -------
    DropFit
        Read its remarks: they say what the data leave open.

    Raises
    ------
    DomainError
        A value is out of its range, or fewer values than constants.
    MissingComponent
        This installation has no component fit.
    KeyboardInterrupt
        By Ctrl-C, within 200 impacts.

    Examples
    --------
    >>> import restitute
    >>> fit = restitute.fit_drop_test(drop_height=[0.1, 0.2, 0.5, 1.0], rebound_height=[0.072, 0.141, 0.339, 0.66],
    ...                               radius=0.02, mass=0.04, model="kelvin_voigt", known={"modulus1": 1e8})
    >>> fit.names
    ['modulus1_pa', 'viscosity_pa_s']
    """
    nan = np.nan
    speed, ez = _heights(drop_height, rebound_height, rebound_ratio, scene.pop("speed", None), ez)
    columns = {"ez": ez, "ex": ex, "contact_time": contact_time, "temperature": temperature}
    sigmas = dict(zip(_MEASURED, (sigma_ez, sigma_ex, sigma_contact_time)))
    noise_known = any(sigma is not None for sigma in sigmas.values())
    if noise_known and weight is not None:
        raise TypeError("weight and sigma_... are given: give one kind")
    if weight is not None:
        deviation = np.sqrt(np.mean(weight) / np.asarray(weight, float))
        sigmas = {"ez": deviation, "ex": deviation, "contact_time": deviation * contact_time}
    columns.update({f"sigma_{name}": sigma for name, sigma in sigmas.items() if sigma is not None})
    if friction is None:
        friction = np.where(np.isnan(ex), 0.0, nan)
    # Arrays of one shape; the solid that is looked for has a stand-in.
    shape = np.broadcast_shapes(np.shape(speed), np.shape(friction), *(np.shape(one) for one in columns.values()))
    impacts = Impacts(Material.elastic(1.0, poisson_ratio), speed=np.broadcast_to(speed, shape),
                      friction=np.where(np.isnan(friction), 0.0, friction),
                      partner=partner if isinstance(partner, str) else "rigid", **scene)
    if impacts.refused:
        first = min(impacts.refused)
        raise errors.DomainError(f"points[{first}]: {impacts.refused[first]}")
    records = impacts.bound()
    records["friction"] = np.broadcast_to(friction, impacts.shape).ravel()
    records["material"] = partner.address if isinstance(partner, Material) else 0
    points = _library.structs("fit_point", len(records), "fit")
    for column, value in columns.items():
        points[column] = np.broadcast_to(value, impacts.shape).ravel()
    points["scene"] = records.ctypes.data + records.itemsize * np.arange(len(records), dtype=np.uint64)
    options, keep = _options(model, terms, known, wlf, poisson_ratio=poisson_ratio, confidence=confidence, loss=loss,
                             reference_temperature=reference_temperature, starts=starts, seed=seed, threads=threads,
                             noise_known=noise_known)
    fitter = _Fitter(_library.pointer(points, "restitute_fit_point[]"), len(points), options, (keep, partner))
    fitter.run(progress)
    result = _library.struct("fit_result", "fit")
    call(_library.fit.restitute_fitter_result, fitter.handle, result)
    measured = {column: points[column] for column in (*_MEASURED, "temperature")}
    return DropFit(result, model, fitter, {**measured, "normal_speed": records["normal_speed"]}, {"name": name})


def _heights(drop, rebound, ratio, speed, ez):
    """Speed and ez from heights of drop and rebound."""
    given = [name for name, value in (("ez", ez), ("rebound_height", rebound), ("rebound_ratio", ratio))
             if value is not None and not np.all(np.isnan(value))]
    if len(given) > 1:
        raise TypeError(f"{given[0]} and {given[1]} both give ez")
    if (drop is None) == (speed is None):
        raise TypeError("speed or drop_height, one of them, gives the speed")
    if rebound is not None and drop is None:
        raise TypeError("rebound_height needs drop_height")
    if rebound is not None:
        _check("rebound_height", rebound, 0, drop, "must be in [0, drop_height]")
        ratio = np.divide(rebound, drop)
    if ratio is not None:
        _check("rebound_ratio", ratio, 0, 1, "must be in [0, 1]")
        ez = np.sqrt(ratio)
    return speed if drop is None else np.sqrt(2 * GRAVITY * np.asarray(drop, float)), ez


def _check(name, values, low, high, words):
    values, low, high = np.broadcast_arrays(np.asarray(values, float), low, high)
    bad = np.flatnonzero((values < low) | (values > high))
    if bad.size:
        raise errors.DomainError(f"points[{bad[0]}].{name} = {values.flat[bad[0]]:.15g}: {words}")


def _options(model, terms, known, wlf, loss, **members):
    """restitute_fit_options, and the arrays that must live as long."""
    for name, value, words in (("model", model, MODELS), ("loss", loss, LOSSES)):
        if value not in words:
            raise errors.DomainError(f"{name} = {value!r}: must be one of {', '.join(words)}")
    terms = np.atleast_1d(np.asarray(terms, float))
    if (model == "prony") != (terms.size > 0):
        raise errors.DomainError("terms and model prony belong together")
    names = [*MODELS[model], *(f"term{k + 1}" for k in range(terms.size))]
    values = np.full(len(names), np.nan)
    for name, value in (known or {}).items():
        if name not in names:
            raise errors.DomainError(f"known: {name!r} is no constant of this model: must be one of {', '.join(names)}")
        values[names.index(name)] = value
    keep = [_library.pointer(terms), _library.pointer(values)]
    options = _library.struct("fit_options", "fit", model=1 + list(MODELS).index(model), loss=LOSSES.index(loss),
                              terms=terms.size, relaxation_time=keep[0], known=keep[1], **members)
    if wlf is not None:
        options.wlf_c1, options.wlf_c2 = wlf
    return options, keep


def fit_dma(frequency, storage, loss, temperature=None, *, poisson_ratio=0.5, tension=False, noise=0.01,
            reference_temperature=np.nan, wlf=None, name="") -> DmaFit:
    """A Prony series, of as few terms as the data carry, from storage and loss moduli.

    Parameters
    ----------
    frequency : array_like, shape (n,)
        Hz; omega = 2 pi f.
    storage, loss : array_like, shape (n,)
        Pa, in shear, or with `tension` E' and E''.
    temperature : array_like, shape (n,), optional
        Curves of several are shifted into one.
    noise : float
        Relative standard deviation of the moduli, in [1e-4, 0.5].
    reference_temperature : float
        Where a_T = 1; default that of the first row.
    wlf : (float, float), optional
        C1 and C2; by default a free shift a temperature.

    Returns
    -------
    DmaFit

    Raises
    ------
    DomainError, MissingComponent
        As `fit_drop_test`.
    KeyboardInterrupt
        By Ctrl-C, at once.

    Examples
    --------
    >>> import numpy as np, restitute
    >>> f = np.geomspace(0.1, 1000, 25)
    >>> x = 2 * np.pi * f * 0.01
    >>> fit_dma(f, 1e6 * x**2 / (1 + x**2), 1e6 * x / (1 + x**2)).relaxation_time.round(5)
    array([0.01])
    """
    columns = [np.asarray(one, float) for one in (frequency, storage, loss) + (() if temperature is None else (temperature,))]
    columns = [np.ascontiguousarray(one.ravel()) for one in np.broadcast_arrays(*columns)]
    options = _library.struct("dma_options", "fit", poisson_ratio=poisson_ratio, tension=tension, noise=noise,
                              reference_temperature=reference_temperature)
    if wlf is not None:
        options.wlf_c1, options.wlf_c2 = wlf
    result = _library.struct("dma_result", "fit")
    pointers = [*map(_library.pointer, columns), *([ffi.NULL] if temperature is None else [])]
    _library.interruptible(_library.fit.restitute_dma_fit, columns[0].size, *pointers, options, result)
    return DmaFit(result, {"name": name})
