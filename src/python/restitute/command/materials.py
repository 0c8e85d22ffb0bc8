# SPDX-License-Identifier: BSD-3-Clause
"""`restitute materials`: what is known by name, and what a material is."""
from restitute.command import options, problem
from restitute.command.options import Refusal, emit, number_text, shown

_EPILOG = """Examples:
  restitute materials
  restitute materials show polyisobutylene
  restitute pair --material polyisobutylene --radius 0.005 --friction 0.3 --speed 0.1
At another temperature, by way of a material file:
  restitute materials show polyisobutylene --temperature 40 --format json >pib40.json
  restitute pair --material pib40.json --radius 0.005 --friction 0.3 --speed 0.1

The moduli are shear moduli: at once, and after infinite time.
"""


def add(subparsers):
    """The parser of `restitute materials`."""
    parser = subparsers.add_parser("materials", epilog=_EPILOG,
                                   usage="restitute materials [list | show NAME|FILE]")
    parser.add_argument("what", nargs="?", default="list", metavar="list|show",
                        help="list: all names (default); show: one material, with its Prony terms")
    parser.add_argument("material", nargs="?", metavar="NAME|FILE", help="of show")
    options.add(parser, "temperature", "CELSIUS", "of show: with the relaxation times of this "
                "temperature, where their shift is known", options.bounded(-273.15, 1e4))
    options.add(parser, "format", "text|json", "of show: json is a material file; default text",
                options.one_of("text", "json"))


def run(arguments):
    """List the materials, or show one."""
    import restitute

    name = arguments.material
    if options.one_of("list", "show")(arguments.what, "materials: action") == "show":
        if name is None:
            raise Refusal("materials show: the name of a material is missing; see --help")
        word = problem.read_material(name, "material")
        material = restitute.material(word, temperature=arguments.temperature)
        if arguments.temperature is not None:
            material.source += f"; relaxation times at {arguments.temperature:g} C"
        emit(_file(material) if arguments.format == "json" else _page(material))
        return 0
    if name is not None:
        raise Refusal(f'unexpected argument "{name[:100]}"; see --help')
    lines = [f"{'name':18} {'kg/m^3':>8} {'G(0), Pa':>10} {'G(inf), Pa':>10}  {'nu':5}  full name"]
    for word in problem.names():
        material = problem.material_of(word)
        stiff, soft = _moduli(material.series)
        lines.append(f"{word:18} {material.density:8g} {stiff:10.3g} {soft:10.3g}  "
                     f"{material.poisson_ratio:<5.3g}  {shown(material.name)}")
    emit("\n".join([*lines, ""]))
    return 0


def _moduli(series):
    """Instantaneous and equilibrium modulus."""
    stiff = series.equilibrium_modulus + series.modulus.sum()
    return float("inf") if series.parallel_viscosity > 0 else stiff, series.equilibrium_modulus


def _file(material):
    """A material file."""
    import json

    series = material.series
    content = {"name": material.name or material.model, "source": material.source or "unknown",
               "poisson_ratio": material.poisson_ratio, "model": "prony"}
    if material.density > 0:
        content["density_kg_m3"] = material.density
    if len(series.modulus):
        terms = zip(series.relaxation_time.tolist(), series.modulus.tolist())
        content.update(equilibrium_modulus_pa=series.equilibrium_modulus,
                       parallel_viscosity_pa_s=series.parallel_viscosity,
                       terms=[{"tau_s": tau, "modulus_pa": modulus} for tau, modulus in terms])
    elif series.parallel_viscosity > 0:
        content.update(model="kelvin_voigt", modulus1_pa=series.equilibrium_modulus,
                       viscosity_pa_s=series.parallel_viscosity)
    else:
        content.update(model="elastic", modulus_pa=series.equilibrium_modulus)
    return json.dumps(content, indent=2, ensure_ascii=False) + "\n"


def _page(material):
    series = material.series
    stiff, soft = _moduli(series)
    lines = [shown(material.name or material.model)]
    for label, value in (("source", shown(material.source)), ("model", material.model),
                         ("density", f"{material.density:g} kg/m^3"),
                         ("Poisson's ratio", f"{material.poisson_ratio:g}"),
                         ("shear modulus", f"{stiff:.6g} Pa at once, {soft:.6g} Pa in the end"),
                         ("parallel dashpot", f"{series.parallel_viscosity:g} Pa s")):
        lines.append(f"  {label:17} {value}")
    terms = [f"{number_text(tau)},{number_text(modulus)}" for tau, modulus in
             zip(series.relaxation_time.tolist(), series.modulus.tolist())]
    return "\n".join([*lines, *(["", "tau_s,G_Pa"] if terms else []), *terms, ""])
