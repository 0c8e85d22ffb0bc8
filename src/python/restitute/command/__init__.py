# SPDX-License-Identifier: BSD-3-Clause
"""The command `restitute`. A subcommand is a module with add(subparsers), which makes its parser,
and run(arguments), which returns the exit status."""
import os
import signal
import sys
import warnings
from importlib import import_module

from restitute.command.options import (
    Parser,
    Refusal,
    did_you_mean,
    emit,
    listed,
    say,
    signals_are,
)
from restitute.errors import Error, UnitWarning

DONE, FAILED, USAGE, INTERRUPTED, BROKEN_PIPE = 0, 1, 2, 130, 141
# Subcommand, its module, what it does.
COMMANDS = {
    "pair": ("single", "the restitution pair (ez, ex) of one impact or of many"),
    "history": ("history", "forces, radii and velocities during one impact"),
    "table": ("table", "build tables of pairs, look up in them"),
    "fit": ("fit", "material constants from measured impacts or a DMA curve"),
    "materials": ("materials", "the materials that are known by name"),
    "paper": ("paper", "the figures of the paper and more, remade and checked"),
    "cite": ("cite", "what to cite: the paper, this software, the sources of materials"),
}
OLD_NAMES = {"sweep": "paper"}
_said: set = set()  # remarks
_LICENCES = {"bem": ("FFTW", 2, "method"), "fit": ("GSL", 3, "command")}


def main(words=None):
    """Run the command.

    Parameters
    ----------
    words : list of str, optional
        What follows `restitute`; by default the command line of this process, whose signals and
        standard descriptors are then made ready.

    Returns
    -------
    int
        Exit status: 0 done, 1 some rows failed, 2 bad usage or input, 130 interrupted.
    """
    if words is None:
        _prepare_process()
        words = sys.argv[1:]
    _said.clear()
    with warnings.catch_warnings():
        warnings.simplefilter("always", UnitWarning)
        warnings.showwarning = _remark
        try:
            return _run(list(words))
        except Refusal as refusal:
            say(str(refusal))
        except KeyboardInterrupt:
            return INTERRUPTED
        except BrokenPipeError:
            return BROKEN_PIPE
        except MemoryError:
            say("out of memory")
        except (Error, OSError) as problem:
            say(str(problem))
    return USAGE


def parser_of(name):
    """The parser of a subcommand, and its module."""
    module = import_module(f"restitute.command.{COMMANDS[name][0]}")
    subparsers = Parser(prog="restitute").add_subparsers()
    module.add(subparsers)
    return subparsers.choices[name], module


def _run(words):
    word = words[0] if words else ""
    if word in ("--help", "-h"):
        emit(_usage())
    elif word == "--version":
        emit(_version())
    elif word in COMMANDS or word in OLD_NAMES:
        name = OLD_NAMES.get(word, word)
        if word == "sweep" and any(other.partition("=")[0] in ("--grid", "--input")
                                   for other in words):
            name = "pair"
        parser, module = parser_of(name)
        try:
            arguments = parser.parse(words[1:])
        except SystemExit:  # help was printed
            return DONE
        arguments.command_line = ["restitute", *words]
        with signals_are(_leave):
            import_module("numpy")
        return module.run(arguments)
    else:
        wrong = f'unknown command "{word[:64]}": must be' if word else "a command is missing:"
        meant = did_you_mean(word, COMMANDS)
        raise Refusal(f"{wrong} {listed(COMMANDS)}{meant}; see restitute --help")
    return DONE


def _usage():
    lines = [f"  restitute {name:10} {about}" for name, (_, about) in COMMANDS.items()]
    return "\n".join([
        "Usage: restitute COMMAND [OPTION...]", "", *lines, "",
        "restitute COMMAND --help shows its options, restitute --version the version.",
        "Oblique impact of linear-viscoelastic spheres with friction. Manual: restitute(1).", ""])


def _version():
    import restitute
    from restitute._library import available

    text = f"restitute {restitute.version()}\nLicence: BSD-3-Clause."
    for component, (library, number, kind) in _LICENCES.items():
        if available(component):
            text += (f"\nThis build links {library}, which is under the GNU General Public "
                     f"License, version {number} or\nlater, for the {kind} {component}: it can be "
                     "passed on under that licence only.")
    return text + "\n"


def _prepare_process():
    """Closed descriptors and signals.

    A standard descriptor that is closed would become an output file, and messages would land in it.
    Opened in the wrong direction it still cannot be used, so that a result that could not be
    printed is an error.
    """
    for descriptor in range(3):
        try:
            os.fstat(descriptor)
        except OSError:
            os.open(os.devnull, os.O_RDONLY if descriptor else os.O_WRONLY)
    for number in (signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) == signal.SIG_DFL:  # what is ignored, as with nohup, stays so
            signal.signal(number, _interrupt)


def _interrupt(number, frame):
    raise KeyboardInterrupt


def _leave(number, frame):
    """Where nothing is open yet: NumPy would print an exception that comes while it is imported."""
    os._exit(INTERRUPTED)


def _remark(message, category, filename, lineno, file=None, line=None):
    """Warnings of the package as remarks, each once; those of others, for programmers, are not
    shown."""
    if category.__module__.partition(".")[0] == "restitute" and str(message) not in _said:
        _said.add(str(message))
        say(f"remark: {message}")
