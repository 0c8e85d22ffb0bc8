# SPDX-License-Identifier: BSD-3-Clause
"""Linear-viscoelastic solids: of constants, from files, by name, of two unlike bodies."""
from __future__ import annotations

import json
import math
import os
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from restitute import _library, errors
from restitute._library import call, ffi
from restitute._places import MATERIALS
from restitute.values import number, numbers, refuse

__all__ = ["Material", "Series", "as_material", "document", "material", "material_names",
           "write_file"]
_FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), MATERIALS)


class Series(NamedTuple):
    """G(t) = equilibrium_modulus + sum_k modulus_k exp(-t/relaxation_time_k)
    + parallel_viscosity delta(t)."""

    relaxation_time: np.ndarray  #: s, ascending
    modulus: np.ndarray  #: Pa
    equilibrium_modulus: float  #: Pa
    parallel_viscosity: float  #: Pa s


class Material:
    """A linear-viscoelastic solid: its shear relaxation modulus and Poisson's ratio,

        G(t) = G_inf + sum_k G_k exp(-t/tau_k) + eta_inf delta(t).

    Immutable; threads may share it. The constructors take shear moduli (see `shear_modulus`) and,
    as further keywords, `name`, `source` and `density`. Materials are equal if their series,
    Poisson's ratios and densities are.

    Attributes
    ----------
    name, source, model : str
        What a file says; empty without one.
    density : float
        kg/m^3; nan if none is given.
    temperature : float
        Of the constants, degrees Celsius; nan if none is given.
    wlf : (float, float, float), or None
        c1, c2 (K) and reference temperature T0 (degrees Celsius) of the shift of times with
        temperature, log10 a_T = -c1 (T - T0)/(c2 + T - T0).
    wlf_range : (float, float)
        Degrees Celsius between which the shift holds; (-inf, inf) if none are given.
    parts : tuple of two Materials, or None
        Those of an effective solid.

    Raises
    ------
    DomainError
        A modulus outside of 1e-30 to 1e30 Pa, a relaxation time outside of 1e-30 to 1e30 s,
        Poisson's ratio outside of 0 to 0.5.

    Examples
    --------
    >>> rubber = Material.standard_solid(1e6, 3e6, 300.0, name="rubber", density=1100)
    >>> rubber.relaxation_modulus([1e-9, 1e3]).round(-4)
    array([4000000., 1000000.])
    """

    def __init__(self, handle: Any, *, name: str = "", source: str = "", model: str = "",
                 density: float = math.nan, parts: tuple[Material, Material] | None = None,
                 window: tuple[float, float] | None = None, temperature: float = math.nan,
                 wlf: tuple[float, float, float] | None = None,
                 wlf_range: tuple[float, float] = (-math.inf, math.inf)):
        if not isinstance(handle, ffi.CData):
            raise TypeError("Material(...): take restitute.material of a name or a file, or a "
                            "constructor such as Material.elastic")
        self._handle = ffi.gc(handle, _library.core.restitute_material_destroy)
        self.name, self.source, self.model, self.parts = name, source, model, parts
        self.density, self.temperature = number("density", density), temperature
        self.wlf, self.wlf_range = wlf, wlf_range
        if window is not None:
            call(_library.core.restitute_material_set_window, handle, *map(float, window))
        self.address = int(ffi.cast("uintptr_t", handle))

    @classmethod
    def _made(cls, kind, about, *arguments, **constants) -> Material:
        for name in about:
            known = [*constants, "name", "source", "density", "window", "temperature", "wlf",
                     "wlf_range"]
            if name not in (*known, "model", "parts"):
                raise TypeError(f"'{name}' is no keyword of Material.{kind}"
                                f"{errors.suggestion(name, known)}")
        handle = ffi.new("restitute_material **")
        call(getattr(_library.core, f"restitute_material_{kind}"), *arguments,
             *(number(name, value) for name, value in constants.items()), handle)
        return cls(handle[0], **{"model": kind, **about})

    @classmethod
    def elastic(cls, modulus: float, poisson_ratio: float = 0.5, **about: Any) -> Material:
        """Elastic solid of shear modulus `modulus` (Pa).

        >>> from restitute import shear_modulus
        >>> Material.elastic(shear_modulus(youngs=210e9, poisson_ratio=0.3), 0.3).series.modulus
        array([], dtype=float64)
        """
        return cls._made("elastic", about, modulus=modulus, poisson_ratio=poisson_ratio)

    @classmethod
    def standard_solid(cls, modulus1: float, modulus2: float, viscosity: float,
                       poisson_ratio: float = 0.5, **about: Any) -> Material:
        """Spring G1 parallel to a spring G2 and a dashpot eta in series (Pa, Pa, Pa s).

        >>> Material.standard_solid(1e6, 2e6, 50.0).series.relaxation_time
        array([2.5e-05])
        """
        return cls._made("standard_solid", about, modulus1=modulus1, modulus2=modulus2,
                         viscosity=viscosity, poisson_ratio=poisson_ratio)

    @classmethod
    def kelvin_voigt(cls, modulus1: float, viscosity: float, poisson_ratio: float = 0.5,
                     **about: Any) -> Material:
        """Spring G1 (Pa) parallel to a dashpot eta (Pa s).

        >>> Material.kelvin_voigt(1e6, 50.0).series.parallel_viscosity
        50.0
        """
        return cls._made("kelvin_voigt", about, modulus1=modulus1, viscosity=viscosity,
                         poisson_ratio=poisson_ratio)

    @classmethod
    def maxwell(cls, modulus: float, viscosity: float, poisson_ratio: float = 0.5,
                **about: Any) -> Material:
        """Spring G (Pa) in series with a dashpot eta (Pa s). It may never rebound.

        >>> Material.maxwell(1e6, 50.0).series.equilibrium_modulus
        0.0
        """
        return cls._made("maxwell", about, modulus=modulus, viscosity=viscosity,
                         poisson_ratio=poisson_ratio)

    @classmethod
    def prony(cls, relaxation_time: Any, modulus: Any, equilibrium_modulus: float = 0.0,
              parallel_viscosity: float = 0.0, poisson_ratio: float = 0.5,
              **about: Any) -> Material:
        """Prony series; every other solid is a case of it.

        Parameters
        ----------
        relaxation_time, modulus : array_like, shape (n,)
            tau_k (s), no two alike; G_k (Pa).
        equilibrium_modulus, parallel_viscosity : float
            G_inf (Pa), eta_inf (Pa s).

        Examples
        --------
        >>> Material.prony([1e-4, 1e-2], [5e6, 1e6], 1e6).relaxation_modulus([1e-3]).round(-4)
        array([1910000.])
        """
        tau, g = (np.array(numbers(name, values), ndmin=1) for name, values in (
            ("relaxation_time", relaxation_time), ("modulus", modulus)))
        if tau.shape != g.shape or tau.ndim != 1:
            raise errors.DomainError(f"relaxation_time, modulus: have the shapes {tau.shape} and "
                                     f"{g.shape}, must have one dimension and the same length")
        return cls._made("prony", about, number("equilibrium_modulus", equilibrium_modulus),
                         number("parallel_viscosity", parallel_viscosity), len(tau),
                         _library.pointer(tau), _library.pointer(g), poisson_ratio=poisson_ratio)

    @classmethod
    def effective(cls, material1: Material, material2: Material, **about: Any) -> Material:
        """Two bodies of unlike materials as one: compliances add (docs/theory.md, 10).

        >>> pair = Material.effective(Material.elastic(80e9, 0.3), Material.elastic(30e9, 0.3))
        >>> round(pair.dundurs, 3)
        -0.13
        """
        parts = as_material("material1", material1), as_material("material2", material2)
        about = {"name": " on ".join(m.name or m.model for m in parts), "parts": parts,
                 "density": parts[0].density, **about}
        return cls._made("effective", about, *(part._handle for part in parts))

    @classmethod
    def read(cls, path: str | os.PathLike) -> Material:
        """A material from a .json or .csv file of the form in include/restitute/files.h.

        Raises
        ------
        FileError, FormatError, DomainError
            The text names the file, the place, the value and its range.
        """
        info = _library.struct("material_info", "files")
        handle = ffi.new("restitute_material **")
        call(_library.files.restitute_material_read, _library.string(path), handle, info)
        wlf = (info.wlf_c1, info.wlf_c2, info.wlf_reference)
        return cls(handle[0], name=_library.text(info.name), source=_library.text(info.source),
                   model=_library.text(info.model), density=info.density,
                   temperature=info.temperature, wlf=None if math.isnan(info.wlf_c1) else wlf,
                   wlf_range=(info.wlf_range[0], info.wlf_range[1]))

    def save(self, path: str | os.PathLike) -> None:
        """Write the file, path.json, that `restitute.material`, the command, C and the adapters
        read: the series with all its digits, Poisson's ratio and, where known, density, window,
        temperature and its shift.

        >>> import os, tempfile
        >>> rubber = Material.standard_solid(1e6, 3e6, 300.0, density=1100, window=(1e-5, 1))
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     rubber.save(os.path.join(folder, "rubber.json"))
        ...     material(os.path.join(folder, "rubber.json")) == rubber
        True
        """
        write_file(path, document(self))

    @property
    def poisson_ratio(self) -> float:
        """Poisson's ratio nu."""
        return _library.core.restitute_material_poisson_ratio(self._handle)

    @property
    def dundurs(self) -> float:
        """Dundurs' beta of an effective solid, in [-1/2, 1/2]; 0 for a material by itself."""
        return _library.core.restitute_material_dundurs(self._handle)

    @property
    def window(self) -> tuple[float, float]:
        """The contact times (s) for which the material was measured; (0.0, inf) if none are
        given. An impact whose contact time is outside of it is warned of. Data at angular
        frequencies omega are of contact times pi/omega.

        >>> Material.elastic(1e6, window=(1e-5, 1)).window
        (1e-05, 1.0)
        """
        ends = ffi.new("double[2]")
        call(_library.core.restitute_material_window, self._handle, ends, ends + 1)
        return ends[0], ends[1]

    @property
    def series(self) -> Series:
        """The Prony series."""
        count = _library.core.restitute_material_terms(self._handle)
        tau, g, rest = np.empty(count), np.empty(count), ffi.new("double[2]")
        call(_library.core.restitute_material_series, self._handle, rest, rest + 1,
             _library.pointer(tau), _library.pointer(g))
        return Series(tau, g, rest[0], rest[1])

    def relaxation_modulus(self, time: Any) -> Any:
        """G(t) in Pa at times t > 0 (s) after a unit shear step, in their shape."""
        s, t = self.series, numbers("time", time)
        refuse("time", t, ~(t > 0), "must be > 0")
        with np.errstate(under="ignore"):
            decay = np.exp(-t[..., None] / s.relaxation_time)
        return (s.equilibrium_modulus + decay @ s.modulus)[()]

    def _sine_cosine(self, frequency: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """omega, and sine and cosine of arctan(omega tau): no square overflows."""
        omega = numbers("frequency", frequency)
        refuse("frequency", omega, ~((omega >= 0) & (omega < np.inf)), "must be finite and >= 0")
        with np.errstate(over="ignore"):
            x = np.minimum(omega[..., None] * self.series.relaxation_time, 1e150)
        cosine = 1 / np.hypot(1, x)
        return omega, x * cosine, cosine

    def storage_modulus(self, frequency: Any) -> Any:
        """G'(omega) in Pa at angular frequencies >= 0 (rad/s), in their shape.

        >>> Material.maxwell(1e6, 1e3).storage_modulus([1e3]).round(3)
        array([500000.])
        """
        sine = self._sine_cosine(frequency)[1]
        return (self.series.equilibrium_modulus + sine**2 @ self.series.modulus)[()]

    def loss_modulus(self, frequency: Any) -> Any:
        """G''(omega) in Pa at angular frequencies >= 0 (rad/s), in their shape.

        >>> Material.kelvin_voigt(1e6, 50.0).loss_modulus([0, 1e3])
        array([    0., 50000.])
        """
        omega, sine, cosine = self._sine_cosine(frequency)
        viscous = self.series.parallel_viscosity * omega
        return ((sine * cosine) @ self.series.modulus + viscous)[()]

    def shifted(self, time_shift: float) -> Material:
        """The same solid with all relaxation times, viscosities and the window times `time_shift`,
        the a_T of a temperature. `temperature` and `wlf` are unknown then.

        >>> Material.maxwell(1e6, 50.0).shifted(10).series.relaxation_time
        array([0.0005])
        """
        if number("time_shift", time_shift) == 1:
            return self
        about: dict = {**self._about(), "temperature": math.nan, "wlf": None}
        if self.parts:
            one, other = self.parts
            about.update(self._own_window(time_shift))
            return Material.effective(one.shifted(time_shift), other.shifted(time_shift), **about)
        made = ffi.new("restitute_material **")
        call(_library.core.restitute_material_shifted, self._handle, time_shift, made)
        return Material(made[0], **about)

    def at_temperature(self, temperature: float) -> Material:
        """The same solid at another temperature (degrees Celsius), by `wlf`.

        >>> material("polyisobutylene").at_temperature(40).temperature
        40.0

        Raises
        ------
        DomainError
            There are no constants of the shift, or not for this temperature.
        """
        temperature = number("temperature", temperature)
        if self.wlf is None:
            raise errors.DomainError(
                f"temperature = {temperature:g}: no shift of times with temperature is known for "
                f"{self.name or 'the material'}; take Material.shifted(a_T)")
        info, made = _library.struct("material_info", "files"), ffi.new("restitute_material **")
        info.temperature = self.temperature
        info.wlf_c1, info.wlf_c2, info.wlf_reference = self.wlf
        info.wlf_range, info.name = self.wlf_range, self.name.encode()[:127]
        call(_library.files.restitute_material_at_temperature, self._handle, info, temperature,
             made)
        about: dict = {**self._about(), "temperature": temperature}
        return Material(made[0], **about)

    def _about(self) -> dict[str, Any]:
        names = ("name", "source", "model", "density", "temperature", "wlf",
                 "wlf_range")
        return {name: getattr(self, name) for name in names}

    def _own_window(self, factor: float = 1) -> dict[str, Any]:
        """The window of two bodies times `factor`, if it is not just the time that theirs share."""
        starts, ends = zip(*(part.window for part in self.parts or ()))
        if self.window == (max(starts), min(ends)):
            return {}
        return {"window": tuple(factor * end for end in self.window)}

    def _key(self) -> tuple:
        s = self.series
        return (s.relaxation_time.tobytes(), s.modulus.tobytes(), *s[2:], self.poisson_ratio,
                self.dundurs, np.float64(self.density).tobytes(), self.window)

    def __eq__(self, other):
        return self._key() == other._key() if isinstance(other, Material) else NotImplemented

    def __hash__(self):
        return hash(self._key())

    def __reduce__(self):
        if self.parts:
            make = partial(Material.effective, **self._about(), **self._own_window())
            return make, self.parts
        make = partial(Material.prony, window=self.window, **self._about())
        return make, (*self.series, self.poisson_ratio)

    def __repr__(self):
        s = self.series
        stiffest = s.equilibrium_modulus + s.modulus.sum()
        about = f"{self.name!r}, " if self.name else ""
        return (f"<restitute.Material {about}{self.model}, G(t) from {stiffest:.3g} to "
                f"{s.equilibrium_modulus:.3g} Pa, nu = {self.poisson_ratio:.3g}>")


def document(material: Material, constants: dict | None = None) -> dict[str, Any]:
    """The content of a material file: of these constants of its model, or of its series."""
    if material.parts:
        raise errors.DomainError("two materials as one have no file: save each")
    series = material.series
    content: dict[str, Any] = {"name": _short(material.name or material.model, 127),
                               "source": _short(material.source or "unknown", 511),
                               "poisson_ratio": material.poisson_ratio, "model": "prony"}
    if material.density > 0:
        content["density_kg_m3"] = material.density
    if material.temperature > -274:
        content["temperature_c"] = material.temperature
    if material.wlf:
        content.update(zip(("wlf_c1", "wlf_c2_k", "wlf_reference_c"), material.wlf))
        if material.wlf_range[1] < math.inf:
            content["wlf_range_c"] = material.wlf_range
    if material.window[1] < math.inf:
        content["window_s"] = material.window
    if constants:
        content.update(model=material.model, **constants)
    elif len(series.modulus):
        terms = zip(series.relaxation_time.tolist(), series.modulus.tolist())
        content.update(equilibrium_modulus_pa=series.equilibrium_modulus,
                       parallel_viscosity_pa_s=series.parallel_viscosity,
                       terms=[{"tau_s": tau, "modulus_pa": modulus} for tau, modulus in terms])
    elif series.parallel_viscosity > 0:
        content.update(model="kelvin_voigt", modulus1_pa=series.equilibrium_modulus,
                       viscosity_pa_s=series.parallel_viscosity)
    else:
        content.update(model="elastic", modulus_pa=series.equilibrium_modulus)
    return content


def _short(text: str, most: int) -> str:
    """As many letters as a material file takes."""
    return text.encode(errors="replace")[:most].decode(errors="ignore")


def write_file(path: str | os.PathLike, content: dict[str, Any]) -> None:
    """Write a material file."""
    if not os.fspath(path).endswith(".json"):
        raise errors.DomainError(f"path = {os.fspath(path)!r}: must end in .json")
    text = json.dumps(content, indent=2, ensure_ascii=False) + "\n"
    try:
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    except OSError as why:
        raise errors.FileError(f"{os.fspath(path)}: cannot be written: {why.strerror}") from None


def _folder() -> str:
    """Where the files are: as for restitute_material_by_name in C."""
    return os.environ.get("RESTITUTE_MATERIALS") or _FOLDER


def as_material(name: str, value: Any) -> Material:
    """The material that is given for the keyword `name`: itself, by name or as a file."""
    if isinstance(value, Material):
        return value
    if isinstance(value, (str, os.PathLike)):
        return material(value)
    inner = isinstance(getattr(value, "material", None), Material)
    raise errors.DomainError(f"{name} = {errors.shown(value)}: must be a Material, its name or a "
                             f"file{'; did you mean fit.material?' if inner else ''}")


def material_names() -> list[str]:
    """Names that `material` knows: files of the package, or of the folder that the environment
    variable RESTITUTE_MATERIALS names.

    >>> "polyisobutylene" in material_names()
    True
    """
    try:
        return sorted(name[:-5] for name in os.listdir(_folder()) if name.endswith(".json"))
    except OSError as why:
        raise errors.FileError(f"{_folder()}: the folder of materials cannot be read: "
                               f"{why.strerror} (RESTITUTE_MATERIALS names another)") from None


def material(name: str | os.PathLike, temperature: float | None = None) -> Material:
    """A material by its name, or from a file.

    Parameters
    ----------
    name : str or path
        One of `material_names()`, or a .json or .csv file.
    temperature : float, optional
        Degrees Celsius; by default the one that the constants hold for. Relaxation times are
        shifted by the equation of Williams, Landel and Ferry, where the file has its constants.

    Raises
    ------
    DomainError
        The name is unknown, or there are no constants for a temperature.
    FileError, FormatError
        As `Material.read`.

    Examples
    --------
    >>> material("polyisobutylene", temperature=40).density
    920.0
    """
    if not isinstance(name, (str, os.PathLike)):
        raise errors.DomainError(f"material = {errors.shown(name)}: must be a name or a file")
    word = os.fspath(name)
    if word.endswith((".json", ".csv")):
        found = Material.read(word)
    elif word in material_names():
        found = Material.read(os.path.join(_folder(), f"{word}.json"))
    else:
        raise errors.DomainError(f"material = {word!r}: is no .json or .csv file and no name"
                                 f"{errors.suggestion(word, material_names())}")
    return found if temperature is None else found.at_temperature(temperature)
