# SPDX-License-Identifier: BSD-3-Clause
"""The record of how a result was made, OUT.meta.json beside OUT.

    settings = provenance.settings(arguments, {"input": None})
    record = provenance.record(arguments, settings, {"ez": "1"}, rows=10)
    files.write(*provenance.with_record(path, content, record))
"""
import hashlib
import json
import math
import os

from restitute.command import files, problem
from restitute.command.options import Refusal
from restitute.errors import Error


def of_number(value):
    """A number for JSON, which has neither nan (null here) nor inf (a text here)."""
    if not isinstance(value, float) or math.isfinite(value):
        return value
    return None if math.isnan(value) else f"{value:g}"


def text(document):
    """A JSON document as it is written."""
    lines = json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False,
                       default=lambda scalar: scalar.item())
    return lines.encode("utf-8", "backslashreplace") + b"\n"


def fingerprint(*contents):
    """SHA-256 of some bytes; for one file what `sha256sum FILE` prints."""
    return f"sha256:{hashlib.sha256(b''.join(contents)).hexdigest()}"


def series_of(path):
    """The file with the Prony terms that a material file names; None if there is none."""
    try:
        with open(path, "rb") as file:
            return os.path.join(os.path.dirname(path), json.load(file)["prony_csv"])
    except (OSError, ValueError, TypeError, KeyError):
        return None


def check_places(arguments, materials, *outputs, table=None):
    """Refuse an output, (option, path, suffixes of what is beside it), that cannot be written or is
    an input of this run or another output; a figure that is not asked for is none.

    `materials` are the values of the options material and partner, or all cells of such columns.
    """
    places = files.Places()
    for name, path in (("the table", table), ("--input", getattr(arguments, "input", None)),
                       ("--dma", getattr(arguments, "dma", None))):
        places.read(name, path)
    _read_materials(places, materials)
    for name, path, *suffixes in outputs:
        if path is not None or name == "--output":
            places.write(name, path, *suffixes)
    places.check()


def _read_materials(places, values):
    for name in ("material", "partner"):
        given = values.get(name, ())
        for text in [given] if isinstance(given, str) else given:
            if text not in ("rigid", "same"):
                places.read(f"--{name}" if text is given else name, text)
                places.read("prony_csv", series_of(text))


def of_material(name):
    """A material, by file or by name: what it says of itself, and a fingerprint of its files."""
    contents = []
    try:
        material = problem.material_of(name)
        for path in (name, series_of(name)) if name.endswith((".json", ".csv")) else ():
            if path:
                with open(path, "rb") as file:
                    contents.append(file.read())
    except (Refusal, Error, OSError) as refused:  # a row that names it fails with these words
        return {"file": name, "refused": str(refused)}
    about = {"name": material.name, "source": material.source, "model": material.model,
             "density_kg_m3": of_number(material.density)}
    return {**about, "fingerprint": fingerprint(*contents)} if contents else about


def settings(arguments, inputs, **defaults):
    """What determines the numbers of a result: `inputs` are "input" and what else belongs to it,
    with "material" and "partner" instead of the options' own; `defaults` those of the subcommand
    for how impacts are solved."""
    import restitute

    given = problem.values_of(arguments)
    usual = {"method": "euler", "tolerance": 1e-3, "elements": "chosen", "time_step": "chosen",
             "max_work": 10.0, "time_limit": "default"}
    solution = problem.solution(arguments, **{**usual, **defaults})
    record = {"version": restitute.version(),
              **{name: of_number(value) for name, value in solution.items()},
              "values": {problem.FIELDS[name].key if name in problem.FIELDS else name:
                         of_number(value) for name, value in given.items()}}
    for name in ("material", "partner"):
        word = given.get(name)
        record[name] = of_material(word) if word not in (None, "rigid", "same") else None
    return {**record, **inputs}


def record(arguments, settings, units, **members):
    """The record of a result: program, version, command line, settings, units, and more."""
    import restitute

    return {"program": "restitute", "version": restitute.version(),
            "command": arguments.command_line, "settings": settings, "units": units, **members}


def with_record(path, content, record):
    """A result, and its record beside it unless that is a stream, for `files.write`."""
    beside = [] if files.is_stream(path) else [(files.beside(path, ".meta.json"), text(record))]
    return [*beside, (path, content)]
