# SPDX-License-Identifier: BSD-3-Clause
"""`restitute history`: one impact over time, its events, and fields of pressure and traction."""
from restitute.command import options, problem, single
from restitute.command.options import Refusal, number_text

# Of the columns: unit in SI, what their name ends in for a dimensionless impact, and what that is.
_COLUMNS = {
    "time": ("s", "T", "T"), "event": ("", "", ""), "position": ("m", "a_el", "a_el"),
    "indentation": ("m", "d0", "d0"), "contact_radius": ("m", "a_el", "a_el"),
    "stick_radius": ("m", "a_el", "a_el"), "normal_force": ("N", "F0", "F0 = m v_z0^2/d0"),
    "tangential_force": ("N", "mu_F0", "friction F0"),
    "normal_velocity": ("m/s", "v0", "v0 = v_z0"),
    "tangential_velocity": ("m/s", "V0", "V0 = friction v_z0 (2-nu)/(2-2nu)"),
    "elements": ("1", "", "1")}
_HISTORY = ("time", "indentation", "contact_radius", "stick_radius", "normal_force",
            "tangential_force", "normal_velocity", "tangential_velocity")
_EVENTS = ("time", "event", "position", "indentation", "normal_velocity", "tangential_velocity",
           "elements")
_FIELDS = {"time": "T", "spacing": "a_el", "pressure": "G_r d0/a_el",
           "traction": "G_r d0/a_el times friction", "stick": "1 sticks, 0 does not"}
_EPILOG = """Example:
  restitute history --material polyisobutylene --radius 0.005 --density 7800 --friction 0.3 \\
      --speed 0.05 --angle 30 --output impact.csv --figure impact.svg

The CSV has the columns time_s, indentation_m, contact_radius_m, stick_radius_m, normal_force_N,
tangential_force_N, normal_velocity_m_s, tangential_velocity_m_s; for a dimensionless impact their
names end in the scales instead: _T, _d0, _a_el, _F0, _mu_F0, _v0 and _V0 (see the manual page).
Exit status: 0 done, 2 failed.
"""


def add(subparsers):
    """The parser of `restitute history`."""
    parser = subparsers.add_parser("history", usage="restitute history [OPTION...]", epilog=_EPILOG)
    problem.add_impact(parser)
    problem.add_solution(parser)
    group = parser.add_argument_group("Input and output")
    options.add(group, "samples", "N", "largest number of rows, equally spaced in time, 2 to "
                "1000000; default 500", options.bounded(2, 1e6, whole=True))
    options.add(group, "output", "FILE", "write the CSV here and not to standard output")
    options.add(group, "events", "FILE", "write the log of events here, as CSV (.csv, or - for "
                "standard output) or HDF5 (.h5, .hdf5); takes the method cvode",
                options.ending(".csv", ".h5", ".hdf5", stream="; - is standard output"))
    options.add(group, "fields", "FILE", "with --method bem: pressure, traction and stick map at "
                "nine times, as HDF5 (.h5, .hdf5)", options.ending(".h5", ".hdf5"))
    options.add_figure(group, "a figure of it")


def run(arguments):
    """Solve one impact and write what happened in it."""
    import restitute
    from restitute.command import files, provenance

    paths = {name: getattr(arguments, name) for name in ("events", "fields", "figure")
             if name in arguments.given}
    method = arguments.method or ("cvode" if "events" in paths else "euler")
    _check(arguments.output, paths, method)
    done = single.solve(
        arguments, {"output": arguments.output, **paths}, restitute.history, method=method,
        samples=arguments.samples or 500, events="events" in paths, fields=9 * ("fields" in paths))
    si = done.result.impacts.kind == "scene"
    settings = provenance.settings(arguments, {"input": None}, method=method)

    def with_record(path, columns, names, as_file=_csv):
        units = {_name(name, si): _COLUMNS[name][0 if si else 2] for name in names}
        record = provenance.record(arguments, settings, units, status=single.remark(done.result))
        return provenance.with_record(path, as_file(columns, names, si), record)

    outputs = with_record(arguments.output, done, _HISTORY)
    if "events" in paths:
        as_file = _csv if paths["events"].lower().endswith(("csv", "-")) else _events_as_hdf5
        outputs += with_record(paths["events"], done.events, _EVENTS, as_file)
    if "fields" in paths:
        outputs.append((paths["fields"], _hdf5(_FIELDS, done.fields._asdict())))
    if "figure" in paths:
        outputs.append((paths["figure"], files.image(_figure(done), paths["figure"])))
    files.write(*outputs)
    return 0


def _check(output, paths, method):
    from restitute import _library

    if "events" in paths and not _library.available("cvode"):
        raise Refusal("--events needs the component cvode, which is not in this build (SUNDIALS; "
                      "Debian: libsundials-dev)")
    for name, path in {"output": output, **paths}.items():
        if name == "figure" or path and path.lower().endswith(("h5", "hdf5")):
            options.need("matplotlib" if name == "figure" else "h5py", f"--{name} = {path}")


def _name(column, si):
    """A column with its unit or its scale, e.g. time_s and time_T."""
    unit, scale, _ = _COLUMNS[column]
    ending = unit.replace("/", "_") if si else scale
    return f"{column}_{ending}" if scale else column


def _csv(columns, names, si):
    texts = [getattr(columns, "word" if name == "event" else name).tolist() for name in names]
    rows = (",".join(cell if isinstance(cell, str) else number_text(cell) for cell in row)
            for row in zip(*texts))
    return "\n".join([",".join(_name(name, si) for name in names), *rows, ""])


def _events_as_hdf5(events, names, si):
    values = {_name(name, si): events.word.tolist() if name == "event" else getattr(events, name)
              for name in names}
    return _hdf5({_name(name, si): _COLUMNS[name][0 if si else 2] for name in names}, values,
                 "events")


def _hdf5(units, values, group="/"):
    """An HDF5 file of arrays with their units, of fixed length."""
    import numpy as np

    import restitute
    from restitute.command import files

    return files.hdf5({name: values[name] for name in units},
                      {name: np.bytes_(unit) for name, unit in units.items()}, group,
                      restitute_version=restitute.version())


def _figure(done):
    import restitute
    from restitute import plot

    impacts = done.result.impacts
    beyond = "".join(f"; beyond a limit of the model: {text}" for *_, text in done.result.limits())
    axes = plot.sheet(3, "One impact", note=impacts.describe() + beyond,
                      origin=f"restitute {restitute.version()}, {done.result.method}")
    return plot.history(done, dimensionless=impacts.kind == "impact", ax=axes)
