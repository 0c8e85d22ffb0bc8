# SPDX-License-Identifier: BSD-3-Clause
"""Constants of a material from measured impacts, or from storage and loss moduli.

The component fit of the library links GSL, which is under the GPL.
"""

from __future__ import annotations

from typing import Any, Callable

import numpy as np

from restitute import _library, errors
from restitute._library import call, ffi
from restitute.constants import shear_modulus
from restitute.fits import MEASURED, DmaFit, DropFit
from restitute.materials import Material, as_material
from restitute.scenes import SCENE, Impacts, warn_of_light
from restitute.values import broadcast, number, numbers, one_of

__all__ = ["fit_dma", "fit_drop_test"]

#: Models and their constants; those of prony go on with term1, term2, ...
MODELS = {"elastic": ("modulus",), "kelvin_voigt": ("modulus1", "viscosity"),
          "standard_solid": ("modulus1", "modulus2", "viscosity"),
          "maxwell": ("modulus", "viscosity"), "prony": ("equilibrium",)}
LOSSES = ("squares", "huber", "cauchy")
_MEMBERS = ("confidence", "reference_temperature", "starts", "seed", "threads")
GRAVITY = 9.80665  # m/s^2
_FIRST = {"youngs_modulus": "youngs", "shore_a": "shore_a"}  # and keywords of shear_modulus
_HIGH = 100.0  # m: nobody drops a ball from higher up
_SOFT = 1e3  # Pa: no ball of less is handled


class _Fitter:
    """A restitute_fitter. While it works, the library asks in this thread whether to go on, so
    that Python runs handlers of signals there. What they raise ends the call and is raised here."""

    def __init__(self, points, options, kept):
        self._raised, self._kept, self._count = None, kept, len(points)
        self._ask = ffi.callback("int(void *)", lambda _: 0, error=1, onerror=self._note)
        options.interrupted = self._ask
        handle = ffi.new("restitute_fitter **")
        self.call(_library.fit.restitute_fitter_create, len(points),
                  _library.pointer(points, "restitute_fit_point[]"), options, handle)
        self._handle = ffi.gc(handle[0], _library.fit.restitute_fitter_destroy)

    def _note(self, kind, value, trace):
        self._raised = value

    def call(self, function, *arguments):
        self._raised = None
        try:
            call(function, *arguments)
        except KeyboardInterrupt:
            raise self._raised or KeyboardInterrupt() from None

    def run(self, progress):
        """The result, and what the fitted solid gives for each point."""
        done, result = ffi.new("double *"), _library.struct("fit_result", "fit")
        while done[0] < 1:
            self.call(_library.fit.restitute_fitter_run, self._handle, done)
            if progress:
                progress(done[0])
        call(_library.fit.restitute_fitter_result, self._handle, result)
        fitted = {name: np.empty(self._count) for name in MEASURED}
        self.call(_library.fit.restitute_fitter_values, self._handle,
                  *map(_library.pointer, fitted.values()))
        return result, fitted


def fit_drop_test(*columns: Any, ez: Any = np.nan, ex: Any = np.nan, contact_time: Any = np.nan,
                  speed: Any = None, drop_height: Any = None, rebound_height: Any = None,
                  rebound_ratio: Any = None, temperature: Any = np.nan, weight: Any = None,
                  sigma_ez: Any = None, sigma_ex: Any = None, sigma_contact_time: Any = None,
                  friction: Any = None, partner: Any = "rigid", model: str = "standard_solid",
                  terms: Any = (), known: dict[str, float] | None = None,
                  poisson_ratio: float = 0.5, loss: str = "squares",
                  wlf: tuple[float, float] | None = None, name: str = "",
                  progress: Callable[[float], Any] | None = None, **more: Any) -> DropFit:
    """Fit the constants of a solid to measured impacts: some tenths of a second for twenty.

    Arrays broadcast; nan stands for what was not measured.

    Parameters
    ----------
    ez, ex, contact_time : array_like
        Measured; the time in s.
    speed : array_like
        m/s.
    drop_height, rebound_height : array_like
        m, instead of speed = sqrt(2 g h) and ez = sqrt(h_rebound/h_drop); no air.
    rebound_ratio : array_like
        Rebound over drop height (rebound resilience), in [0, 1]: ez is its root.
    temperature : array_like
        Relaxation times are multiplied by a_T, a fitted one a temperature, or by `wlf`: C1, C2.
    weight : array_like
        Of the impacts; only ratios matter.
    sigma_ez, sigma_ex, sigma_contact_time : array_like
        Instead: standard deviations. The noise is then known.
    friction : array_like
        By default it is fitted where ex was measured.
    partner : "rigid", "same", Material, name, path, or array_like of them
        "same": both bodies are of the solid that is looked for.
    model : {"standard_solid", "kelvin_voigt", "maxwell", "elastic", "prony"}
    terms : array_like
        Relaxation times of the model prony, s (not how many); 1 to 20.
    known : dict
        Constants that are not fitted, e.g. {"modulus1": 1e6}; see `MODELS`. In place of the first
        one also "youngs_modulus" or "shore_a", as of `restitute.shear_modulus`.
    loss : {"squares", "huber", "cauchy"}
        The last two are less disturbed by outliers.
    name : str
        Of the material.
    progress : callable
        progress(part done).
    **more
        `confidence`, `reference_temperature`, `starts`, `seed`, `threads`: members of
        `restitute_fit_options`. `radius`, `density` or `mass`, `angle`, ...: as in `pair`. One
        density for all is that of the fitted solid, too; if the wall is what deforms, give mass.

    Returns
    -------
    DropFit
        Its remarks say what the data leave open.

    Raises
    ------
    DomainError
        A value is out of its range, which the text names with its place; too few values.
    MissingComponent
        This installation has no component fit.
    KeyboardInterrupt
        By Ctrl-C, within 200 impacts.

    Warns
    -----
    ModelLimitWarning
        Impacts are beyond the contact model.

    Examples
    --------
    >>> import restitute
    >>> fit = fit_drop_test(drop_height=[0.1, 0.2, 0.5, 1], rebound_height=[0.07, 0.14, 0.34, 0.66],
    ...                     radius=0.02, mass=0.04, model="kelvin_voigt", known={"modulus1": 3e9})
    >>> fit.names, fit.is_good
    (['modulus1_pa', 'viscosity_pa_s'], True)
    """
    if columns:
        raise TypeError("fit_drop_test: give columns as keywords, e.g. drop_height=[0.1, 0.2]; the "
                        "command restitute fit reads files")
    for key in more:
        if key not in (*_MEMBERS, *SCENE):
            names = [*(fit_drop_test.__kwdefaults__ or ()), *_MEMBERS, *SCENE]
            raise TypeError(f"'{key}' is no keyword of fit_drop_test"
                            f"{errors.suggestion(key, names)}")
    members: dict[str, Any] = {key: more.pop(key) for key in _MEMBERS if key in more}
    given = {"ez": ez, "ex": ex, "contact_time": contact_time, "temperature": temperature,
             "sigma_ez": sigma_ez, "sigma_ex": sigma_ex, "sigma_contact_time": sigma_contact_time,
             "weight": weight, "speed": speed, "friction": friction, "drop_height": drop_height,
             "rebound_height": rebound_height, "rebound_ratio": rebound_ratio}
    given = {key: numbers(key, value) for key, value in given.items() if value is not None}
    broadcast(given)
    _heights(given)
    members["noise_known"] = any(f"sigma_{what}" in given for what in MEASURED)
    if "weight" in given:
        if members["noise_known"]:
            raise TypeError("weight and sigma_... are given: give one kind")
        weight = given.pop("weight")
        _check("weight", weight, 5e-324, 1e100, "must be > 0")
        deviation = np.sqrt(np.mean(weight) / weight)
        given.update(sigma_ez=deviation, sigma_ex=deviation,
                     sigma_contact_time=deviation * given["contact_time"])
    density = np.unique(numbers("density", more.get("density", np.nan)))
    points, records, kept = _points(given, partner, poisson_ratio, more)
    options, arrays = _options(model, terms, known, loss, wlf, poisson_ratio, members)
    result, fitted = _Fitter(points, options, (records, kept, arrays)).run(progress)
    measured = {what: points[what] for what in MEASURED}
    measured["normal_speed"] = records["normal_speed"]
    fit = DropFit(result, model, options.confidence, measured, fitted, name=name,
                  density=density[0] if density.size == 1 else np.nan,
                  window=_window(fitted["contact_time"], points["temperature"], options, result))
    for remark in fit.remarks:
        if "beyond the contact model" in remark:
            _library.warn(remark, errors.ModelLimitWarning)
    return fit


def _window(time, temperature, options, result):
    """The shortest and the longest contact time of the data, at the reference temperature; None if
    there are no two."""
    known, shifts = temperature[~np.isnan(temperature)], {}
    if known.size:
        reference = options.reference_temperature
        t = known - (known[0] if np.isnan(reference) else reference)
        with np.errstate(all="ignore"):  # nan: none is given
            shifts = dict(zip(known, 10 ** (-options.wlf_c1 * t / (options.wlf_c2 + t))))
        names = (_library.text(result.name[k]) for k in range(result.constants))
        fitted = {name[6:]: result.value[k] for k, name in enumerate(names)
                  if name.startswith("shift_")}
        shifts = {one: fitted.get(f"{one:g}", 1.0 if np.isnan(shift) else shift)
                  for one, shift in shifts.items()}
    time = time / np.array([shifts.get(one, 1.0) for one in temperature])
    time = time[np.isfinite(time) & (time > 0)]
    return (time.min(), time.max()) if time.size and time.min() < time.max() else None


def _heights(given):
    """Heights of drop and rebound, where these are given, as speed and ez."""
    drop, rebound, ratio = (given.pop(name, None)
                            for name in ("drop_height", "rebound_height", "rebound_ratio"))
    if drop is None and "speed" not in given:
        raise TypeError("speed is missing: must be > 0 (or drop_height)")
    if drop is not None:
        _check("drop_height", drop, 5e-324, np.inf, "must be > 0")
        if np.nanmax(drop, initial=0) > _HIGH:
            _library.warn(f"drop_height = {np.nanmax(drop):g} m: heights are in m, not in mm",
                          errors.UnitWarning)
        speed = given.get("speed", np.nan)
        if not np.all(np.isnan(speed) | np.isnan(drop)):
            raise TypeError("drop_height and speed both give the speed")
        given["speed"] = np.where(np.isnan(drop), speed, np.sqrt(2 * GRAVITY * drop))
    if rebound is not None:
        if drop is None or np.any(np.isnan(drop) & ~np.isnan(rebound)):
            raise TypeError("rebound_height without drop_height")
        _check("rebound_height", rebound, 0, np.where(np.isnan(drop), np.inf, drop),
               "must be in [0, drop_height]")
        given["ez"] = _root("rebound_height", rebound / drop, given["ez"])
    if ratio is not None:
        _check("rebound_ratio", ratio, 0, 1, "must be in [0, 1]")
        given["ez"] = _root("rebound_ratio", ratio, given["ez"])


def _root(name, ratio, ez):
    if np.any(~np.isnan(ratio) & ~np.isnan(ez)):
        raise TypeError(f"{name} and ez both give ez")
    return np.where(np.isnan(ratio), ez, np.sqrt(ratio))


def _check(name, values, low, high, words):
    """Refuse the first value that is outside; nan is not."""
    values, low, high = np.broadcast_arrays(np.asarray(values, float), low, high)
    bad = np.flatnonzero((values < low) | (values > high))
    if bad.size:
        where = f"points[{bad[0]}]." if values.ndim else ""
        raise errors.DomainError(f"{where}{name} = {values.flat[bad[0]]:.15g}: {words}")


def _points(given, partner, poisson_ratio, scene):
    """restitute_fit_point records and the scenes they point at, and what must live as long."""
    speed = given.pop("speed")
    friction = given.pop("friction", np.where(np.isnan(given["ex"]), 0.0, np.nan))
    partners = np.asarray(np.frompyfunc(_partner, 1, 1)(np.asarray(partner, object)), object)
    own = np.frompyfunc(lambda one: one.address if isinstance(one, Material) else 0, 1, 1)
    word = np.frompyfunc(lambda one: one if isinstance(one, str) else "rigid", 1, 1)
    shape = broadcast({"speed": speed, "friction": friction, "partner": partners, **given})
    stand_in = Material.elastic(1.0, poisson_ratio)  # for the solid that is looked for
    impacts = Impacts(stand_in, speed=np.broadcast_to(speed, shape), partner=word(partners),
                      friction=np.where(np.isnan(friction), 0.0, friction), **scene)
    if impacts.refused:
        first = min(impacts.refused)
        raise errors.DomainError(f"points[{first}].{impacts.refused[first]}")
    shape, records = impacts.shape, impacts.bound()
    records["friction"] = np.broadcast_to(friction, shape).ravel()
    records["material"] = np.broadcast_to(own(partners), shape).ravel()
    points = _library.structs("fit_point", len(records), "fit")
    for column, value in given.items():
        points[column] = np.broadcast_to(value, shape).ravel()
    places = np.arange(len(records), dtype=np.uint64) * np.uint64(records.itemsize)
    points["scene"] = records.ctypes.data + places
    return points, records, partners


def _partner(one):
    """A word, or what is one's Material."""
    word = isinstance(one, str) and one in ("rigid", "same")
    return one if word else as_material("partner", one)


def _options(model, terms, known, loss, wlf, poisson_ratio, members):
    """restitute_fit_options, and the arrays that must live as long."""
    one_of("model", model, MODELS)
    one_of("loss", loss, LOSSES)
    if isinstance(terms, (int, np.integer)):
        raise errors.DomainError(f"terms = {terms}: must be relaxation times (s), not how many, as "
                                 "[1e-4, 1e-2]")
    terms = np.atleast_1d(numbers("terms", terms))
    if (model == "prony") != (terms.size > 0):
        raise TypeError("terms and the model prony belong together")
    names = [*MODELS[model], *(f"term{k + 1}" for k in range(terms.size))]
    values = np.full(len(names), np.nan)
    for name, value in _shear(known or {}, names[0], poisson_ratio).items():
        if name not in names:
            raise errors.DomainError(f"known: '{name}' is no constant of this model"
                                     f"{errors.suggestion(name, [*names, *_FIRST])}")
        value = number(f"known: {name}", value)
        if not (1e-30 <= value <= 1e30 or (value == 0 and model == "prony")):
            raise errors.DomainError(f"known: {name} = {value:g}: must be in [1e-30, 1e30]")
        values[names.index(name)] = value
    arrays = [_library.pointer(terms), _library.pointer(values)]
    options = _library.struct(
        "fit_options", "fit", model=1 + list(MODELS).index(model), loss=LOSSES.index(loss),
        terms=terms.size, relaxation_time=arrays[0], known=arrays[1], poisson_ratio=poisson_ratio,
        **_wlf(wlf), **members)
    return options, arrays


def _shear(known, first, poisson_ratio):
    """Known constants, with a shear modulus, the first one, in place of E or a hardness."""
    if not isinstance(known, dict):
        raise TypeError(f"known = {errors.shown(known)}: must be a dict, as "
                        '{"youngs_modulus": 5.8e8}')
    known = dict(known)
    for name in _FIRST.keys() & known.keys():
        if first in known:
            raise TypeError(f"known: {first} and {name} are both given: one determines the other")
        try:
            value = shear_modulus(**{_FIRST[name]: number(f"known: {name}", known.pop(name))},
                                  poisson_ratio=poisson_ratio)
        except errors.DomainError as why:
            text = str(why)
            raise errors.DomainError(text if text.startswith("known: ") else f"known: {text}"
                                     ) from None
        known[first] = float(value)
    return known


def _wlf(constants):
    """C1 and C2 as members of options."""
    if constants is None:
        return {}
    if np.shape(constants) != (2,):
        raise errors.DomainError(f"wlf = {errors.shown(constants)}: must be C1 and C2")
    return dict(zip(("wlf_c1", "wlf_c2"), map(float, numbers("wlf", constants))))


def fit_dma(frequency: Any, storage: Any, loss: Any, temperature: Any = None, *,
            wlf: tuple[float, float] | None = None, name: str = "", density: float = np.nan,
            **options: Any) -> DmaFit:
    """A Prony series, of as few terms as the data carry, from storage and loss moduli.

    Parameters
    ----------
    frequency, storage, loss : array_like, shape (n,)
        Hz (omega = 2 pi f) and Pa.
    temperature : array_like, shape (n,), optional
        Curves of several are shifted into one.
    wlf : (float, float), optional
        C1 and C2; by default a free shift a temperature.
    name, density : str, float
        Of the material; kg/m^3.
    **options
        Members of `restitute_dma_options` (fit.h): `poisson_ratio`, `tension` (the moduli are E'
        and E''), `noise` (relative, of the moduli; default 0.01), `reference_temperature`.

    Raises
    ------
    DomainError
        The text names the row, the value and its range.
    MissingComponent, KeyboardInterrupt
        As `fit_drop_test`.

    Examples
    --------
    >>> import numpy as np, restitute
    >>> rubber, f = restitute.Material.maxwell(1e6, 1e4), np.geomspace(0.1, 1000, 25)
    >>> omega = 2 * np.pi * f
    >>> print(fit_dma(f, rubber.storage_modulus(omega), rubber.loss_modulus(omega)))
      equilibrium_modulus_pa     0
      modulus_pa[tau=0.01]       1e+06
    <BLANKLINE>
      Prony series of 1 terms, relative residuals: rms ..., largest ...
    """
    given = {"frequency": frequency, "storage": storage, "loss": loss, "temperature": temperature}
    columns = {key: numbers(key, value) for key, value in given.items() if value is not None}
    if not (np.isnan(number("density", density)) or 0 < density < np.inf):
        raise errors.DomainError(f"density = {density:g}: must be finite and > 0")
    warn_of_light({"density": density})
    shape = broadcast(columns)
    arrays = [np.array(np.broadcast_to(one, shape)).ravel() for one in columns.values()]
    settings = _library.struct("dma_options", "fit", **_wlf(wlf), **options)
    result = _library.struct("dma_result", "fit")
    pointers = [*map(_library.pointer, arrays), *([ffi.NULL] if temperature is None else [])]
    _library.interruptible(_library.fit.restitute_dma_fit, arrays[0].size, *pointers, settings,
                           result)
    middle = np.median(arrays[1])
    if middle < _SOFT:
        _library.warn(f"the median storage modulus is {middle:.3g} Pa: are moduli in Pa, not in "
                      "MPa?", errors.UnitWarning)
    return DmaFit(result, bool(settings.tension), arrays, name=name, density=density)
