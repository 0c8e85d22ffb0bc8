# SPDX-License-Identifier: BSD-3-Clause
"""`restitute materials`: what is known by name, and what a material is."""
from restitute.command import options, problem
from restitute.command.options import Refusal, emit, number_text, shown

_EPILOG = """Examples:
  restitute materials
  restitute materials polyisobutylene --figure polyisobutylene.svg
  restitute pair --material polyisobutylene --radius 0.005 --friction 0.3 --speed 0.1
At another temperature, and the material file of it:
  restitute pair --material polyisobutylene --temperature 40 --radius 0.005 --friction 0.3 \\
      --speed 0.1
  restitute materials polyisobutylene --temperature 40 --format json >pib40.json

The moduli are shear moduli: at once, and after infinite time. The window is that of the contact
times for which the material was measured: an impact that takes longer or shorter is flagged.
Temperatures are those of the constants, and between which they can be shifted.
"""
_COLUMNS = "{:16} {:14} {:>6} {:>5} {:>9} {:>9}  {:19} {:15}  {}"


def add(subparsers):
    """The parser of `restitute materials`."""
    parser = subparsers.add_parser("materials", epilog=_EPILOG,
                                   usage="restitute materials [list | [show] NAME|FILE]")
    parser.add_argument("what", nargs="?", default="list", metavar="list|show|NAME",
                        help="list: all names (default); show or a name: one material, with its "
                        "Prony terms")
    parser.add_argument("material", nargs="?", metavar="NAME|FILE", help="of show")
    options.add(parser, "temperature", "CELSIUS", "of one material: with the relaxation times of "
                "this temperature, where their shift is known", options.bounded(-273.15, 1e4))
    options.add(parser, "format", "text|json", "of one material: json is a material file; default "
                "text", options.one_of("text", "json"))
    options.add_figure(parser, "of one material: relaxation modulus, storage and loss modulus, "
                       "with the window shaded")


def run(arguments):
    """List the materials, or show one."""
    import restitute
    from restitute.command import files, provenance
    from restitute.materials import document

    word, name = arguments.what, arguments.material
    if name is not None and word != "show":
        raise Refusal(f'unexpected argument "{name[:100]}"; see --help')
    if word == "show" and name is None:
        raise Refusal("materials show: the name of a material is missing; see --help")
    if word == "list":
        given = {"temperature", "figure"} & arguments.given.keys()
        if given:
            raise Refusal(f"--{min(given)}: needs the name of a material")
        emit(_list())
        return 0
    word = problem.read_material(name or word, "material")
    if arguments.figure:
        provenance.check_places(arguments, {"material": word}, ("--figure", arguments.figure))
        options.need("matplotlib", "--figure")
    material = restitute.material(word, temperature=arguments.temperature)
    if arguments.temperature is not None:
        material.name = f"{material.name or material.model}, shifted to {arguments.temperature:g} C"
        material.source += f"; relaxation times at {arguments.temperature:g} C"
    text = (provenance.text(document(material)) if arguments.format == "json" else
            _page(material))
    if arguments.figure:
        files.write((arguments.figure, files.image(_figure(material), arguments.figure)),
                    (None, text))
    else:
        emit(text)
    return 0


def _list():
    """A line a material."""
    import textwrap

    lines = [_COLUMNS.format("name", "model", "kg/m^3", "nu", "G(0), Pa", "G(inf)", "window, s",
                             "C", "source")]
    for word in problem.names():
        material = problem.material_of(word)
        stiff, soft = _moduli(material.series)
        density = f"{material.density:g}" if material.density > 0 else "-"
        lines.append(_COLUMNS.format(
            word, material.model, density, f"{material.poisson_ratio:g}", f"{stiff:.3g}",
            f"{soft:.3g}", _window(material), _temperature(material, ">"),
            textwrap.shorten(shown(material.source), 60, placeholder=" ..")))
    return "\n".join([*lines, ""])


def _window(material):
    """"1e-05 to 1", or "-" where none is given."""
    low, high = material.window
    return f"{low:.2g} to {high:.2g}" if high < float("inf") else "-"


def _temperature(material, word):
    """"25 (>-175)", "25", or "-"."""
    if not material.temperature > -274:
        return "-"
    if not material.wlf:
        return f"{material.temperature:g}"
    low, high = material.wlf_range
    if high < float("inf"):
        return f"{material.temperature:g} ({low:g} to {high:g})"
    _, c2, reference = material.wlf
    return f"{material.temperature:g} ({word}{reference - c2:.0f})"


def _given(text, unit):
    return "not given" if text == "-" else f"{text} {unit}"


def _figure(material):
    """G(t), G'(omega) and G''(omega) with the window, a contact of time t being at pi/t."""
    import numpy as np

    from restitute import plot
    from restitute.plot.sheet import legend

    low, high = material.window
    tau = material.series.relaxation_time
    ends = [*tau, *((low, high) if high < np.inf else ())] or [1e-6, 1.0]
    time = np.geomspace(min(ends) / 10, max(ends) * 10, 400)
    ax = plot.sheet(2, title=material.name or material.model, note=material.source)
    plot.relaxation(material, time, ax=ax[0])
    plot.moduli(material, 1 / time, ax=ax[1])
    if high < np.inf:
        ax[0].axvspan(low / np.pi, high / np.pi, color="#dfe8f0", zorder=0, label="measured")
        ax[1].axvspan(np.pi / high, np.pi / low, color="#dfe8f0", zorder=0, label="measured")
    ax[0].get_legend().remove()
    soft = material.relaxation_modulus(time[-1])
    ax[0].set_ylim(bottom=max(soft, 1e-5 * material.relaxation_modulus(time[0])) / 2)
    legend(ax[1])
    return ax


def _moduli(series):
    """Instantaneous and equilibrium modulus."""
    stiff = series.equilibrium_modulus + series.modulus.sum()
    return float("inf") if series.parallel_viscosity > 0 else stiff, series.equilibrium_modulus


def _page(material):
    series = material.series
    stiff, soft = _moduli(series)
    lines = [shown(material.name or material.model)]
    for label, value in (("source", shown(material.source)), ("model", material.model),
                         ("density", f"{material.density:g} kg/m^3" if material.density > 0
                          else "not given"),
                         ("Poisson's ratio", f"{material.poisson_ratio:g}"),
                         ("shear modulus", f"{stiff:.6g} Pa at once, {soft:.6g} Pa in the end"),
                         ("parallel dashpot", f"{series.parallel_viscosity:g} Pa s"),
                         ("window", _given(_window(material), "s")),
                         ("temperature", _given(_temperature(material, "shifts above "), "C"))):
        lines.append(f"  {label:17} {value}")
    terms = [f"{number_text(tau)},{number_text(modulus)}" for tau, modulus in
             zip(series.relaxation_time.tolist(), series.modulus.tolist())]
    return "\n".join([*lines, *(["", "tau_s,G_Pa"] if terms else []), *terms, ""])
