# SPDX-License-Identifier: BSD-3-Clause
"""The command line: options that are read strictly, refusals that name value, place and range.

    parser = subparsers.add_parser("pair", usage="restitute pair [OPTION...]", epilog=EXAMPLES)
    group = parser.add_argument_group("How it is solved")
    add(group, "tolerance", "ERROR", "absolute error of ez and ex", bounded(1e-8, 0.1))
    arguments = parser.parse(words)      # arguments.tolerance is None if it is not given
"""
import argparse
import errno
import os
import re
import signal
from contextlib import contextmanager

_DECIMAL = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
NUMBER = re.compile(_DECIMAL, re.A)
_INFINITE = re.compile(r"[+-]?inf", re.I)
_UNIT = re.compile(rf"({_DECIMAL}) ?((?:[kMGcmunµ]?(?:m|s|g|N|Pa|rad|Hz)|deg|°|%|rpm|K|°?C)"
                   r"(?:\^?-?[1-3])?(?:[/*·].*)?)", re.A)
_PI = re.compile(rf"({_DECIMAL})?\*?(?:pi|π)(?:/({_DECIMAL}))?", re.A | re.I)
# What other programs and papers call an option.
_SYNONYMS = {"mu": "friction", "diameter": "radius, half of it", "nu": "poisson-ratio",
             "rho": "density", "omega": "spin", "eta": "viscosity", "e": "youngs-modulus",
             "young": "youngs-modulus", "hardness": "shore-a", "shore": "shore-a", "v": "speed",
             "r": "radius", "m": "mass", "g": "modulus1", "shear-modulus": "modulus1",
             "wall": "partner", "celsius": "temperature", "file": "input", "plot": "figure",
             "theta": "angle"}


class Refusal(Exception):
    """What the user asks for cannot be done. The text names the value, the place and the range."""


def shown(text):
    """The text with control characters and bytes that are no UTF-8 as \\xNN, for a terminal."""
    def character(one):
        code = ord(one)
        if 0xDC80 <= code <= 0xDCFF:  # a byte that the system's encoding does not know
            return f"\\x{code - 0xDC00:02x}"
        if code < 0x20 or 0x7F <= code < 0xA0:
            return "".join(f"\\x{byte:02x}" for byte in one.encode())
        return one
    return "".join(map(character, text))


def say(text):
    """A message on standard error; lost if that is closed."""
    try:
        write_all(2, f"restitute: {shown(text)}\n")
    except OSError:
        pass


def write_all(descriptor, text, name=None):
    """Write text or bytes to an open descriptor; with a name, failures are Refusals."""
    rest = memoryview(text if isinstance(text, bytes) else text.encode("utf-8", "surrogateescape"))
    try:
        while rest:
            rest = rest[os.write(descriptor, rest):]
    except OSError as problem:
        if name is None or isinstance(problem, BrokenPipeError):
            raise
        why = os.strerror(problem.errno or errno.EIO)
        raise Refusal(f"{name} cannot be written: {why}") from None


def emit(text):
    """Text or bytes to standard output."""
    write_all(1, text, "standard output")


def number_text(value):
    """A number with as many digits as it needs to be read back exactly."""
    for digits in (15, 16, 17):
        text = f"{value:.{digits}g}"
        if value != value or float(text) == value:
            break
    return text


def number(text):
    """A decimal number, "inf", or a fraction such as 7/6; or a ValueError that says what it is
    instead, e.g. "is not a number (a decimal comma; write 1.5)"."""
    if _INFINITE.fullmatch(text):
        return float(text)
    above, slash, below = text.partition("/")
    if not NUMBER.fullmatch(above) or slash and not NUMBER.fullmatch(below):
        raise ValueError(f"is not a number{_misreading(text)}")
    if slash and float(below) == 0:
        raise ValueError("is not a number (a division by zero)")
    value = float(above) / float(below or 1)
    if abs(value) == float("inf") or value == 0 and re.search("[1-9]", re.split("[eE]", above)[0]):
        raise ValueError("is too large or too small for a double")
    return value


def _misreading(text):
    """What a text is that somebody took for a number, in parentheses; empty if not known."""
    unit, pi = _UNIT.fullmatch(text), _PI.fullmatch(text)
    if re.fullmatch(r"[+-]?\d+,\d+(?:[eE][+-]?\d+)?", text, re.A):
        return f" (a decimal comma; write {text.replace(',', '.')})"
    if unit:
        return f' (with the unit "{unit[2]}"; give the number alone, in the unit asked for)'
    if pi and float(pi[2] or 1) != 0:
        value = float(pi[1] or 1) * 3.141592653589793 / float(pi[2] or 1)
        return f" (pi is not known here; write {value:.15g})"
    return " (there are blanks around it)" if text != text.strip() else ""


def read_number(text, place, allowed, fits, quote=""):
    """A number for which fits(number) holds. A message calls it `place`, e.g. "row 3: psi", and its
    range `allowed`, e.g. "must be >= 0"."""
    try:
        value = number(text)
    except ValueError as why:
        raise Refusal(f'{place} = "{text[:64]}" {why}: {allowed}') from None
    if not fits(value):
        raise Refusal(f"{place} = {quote}{text[:64]}{quote}: {allowed}")
    return value


def bounded(low, high, whole=False):
    """A reader of numbers in [low, high]."""
    def read(text, place):
        top = f"{high:g}" if float(f"{high:g}") == high else number_text(high)
        allowed = f"must be {'a whole number' if whole else 'a number'} in [{low:g}, {top}]"
        value = read_number(text, place, allowed, quote='"',
                            fits=lambda x: low <= x <= high and not (whole and x % 1))
        return int(value) if whole else value
    return read


def one_of(*words):
    """A reader of one of these words."""
    def read(text, place):
        if text not in words:
            raise Refusal(f'{place} = "{text[:64]}": must be {listed(words)}'
                          f"{did_you_mean(text, words)}")
        return text
    return read


def ending(*endings, stream=""):
    """A reader of file names with one of these endings, in capitals or not; `stream` allows -."""
    def read(text, place):
        if text.lower().endswith(endings) or stream and text == "-":
            return text
        raise Refusal(f'{place} = "{text[:64]}": must end in {listed(endings)}{stream}')
    return read


def listed(words, last="or"):
    """The words as in a sentence: a, b or c."""
    words = list(words)
    return f"{', '.join(words[:-1])} {last} {words[-1]}" if len(words) > 1 else "".join(words)


def did_you_mean(word, known):
    """"; did you mean ...?" if one of the known words resembles this one, else nothing."""
    from difflib import get_close_matches

    folded = {name.casefold(): name for name in known}
    close = get_close_matches(word.casefold(), folded, 1)
    return f"; did you mean {folded[close[0]]}?" if close else ""


def need(module, place):
    """A module that not every installation has."""
    from importlib import import_module

    try:
        return import_module(module)
    except ImportError:
        name = module.partition(".")[0]
        raise Refusal(f"{place}: needs {name}, which this Python does not have (Debian: "
                      f"python3-{name}; pip install {name})") from None


class Once(argparse.Action):
    """An option that may be given once. `read(text, place)` makes its value."""

    def __init__(self, option_strings, dest, read=None, **rest):
        super().__init__(option_strings, dest, **rest)
        self.read = read

    def __call__(self, parser, namespace, value, option_string=None):
        if self.dest in namespace.given:
            raise Refusal(f"{option_string} is given twice")
        namespace.given[self.dest] = option_string
        if self.nargs == 0:
            value = True
        setattr(namespace, self.dest, self.read(value, option_string) if self.read else value)


def add(group, name, metavar, help, read=None, also=()):
    """An option with an argument. `also` are names of equal standing."""
    group.add_argument(*[f"--{word}" for word in (name, *also)], dest=name.replace("-", "_"),
                       metavar=metavar, help=help.replace("%", "%%"), read=read, action=Once)


def add_flag(group, name, help):
    """An option without an argument."""
    group.add_argument(f"--{name}", dest=name.replace("-", "_"), nargs=0, help=help, action=Once,
                       default=False)


def add_figure(group, help):
    """The option --figure."""
    add(group, "figure", "FILE", f"{help}, .svg, .png or .pdf; needs matplotlib",
        ending(".svg", ".png", ".pdf"))


@contextmanager
def signals_are(handler):
    """Signals that end a process have this handler, where they are not ignored."""
    before = {number: signal.getsignal(number)
              for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}
    for number, old in before.items():
        if old != signal.SIG_IGN:
            signal.signal(number, handler)
    try:
        yield
    finally:
        for number, old in before.items():
            signal.signal(number, old)


@contextmanager
def signals_wait():
    """Signals that come meanwhile take effect at the end."""
    late = []
    try:
        with signals_are(lambda number, frame: late.append(number)):
            yield
    finally:
        for number in late:
            signal.raise_signal(number)


class _Formatter(argparse.RawDescriptionHelpFormatter):
    """Help of 100 columns at most, with the argument of an option behind its last name."""

    def __init__(self, prog):
        try:
            width = os.get_terminal_size(1).columns
        except OSError:
            width = 100
        super().__init__(prog, max_help_position=26, width=max(60, min(width, 100)))

    def _format_action_invocation(self, action):
        if not action.option_strings:
            return super()._format_action_invocation(action)
        return " ".join(filter(None, (", ".join(action.option_strings), action.metavar)))


class Parser(argparse.ArgumentParser):
    """argparse, strict: no abbreviations, what follows an option is its value, every mistake is a
    Refusal."""

    def __init__(self, **settings):
        settings.setdefault("formatter_class", _Formatter)
        super().__init__(allow_abbrev=False, add_help=False, **settings)
        self.add_argument("-h", "--help", action="help", help="show this and stop")
        self._actions_of_first_word = None

    def add_actions(self, **settings):
        """Subparsers for the first word, in `arguments.action`."""
        self._actions_of_first_word = self.add_subparsers(dest="action", **settings)
        return self._actions_of_first_word

    def parse(self, words):
        """The namespace of these words. Its `given` has the options given, by which names."""
        namespace = argparse.Namespace(given={})
        if self._actions_of_first_word and words and not words[0].startswith("-"):
            action, choices = words[0], self._actions_of_first_word.choices
            if action not in choices:
                raise Refusal(f'{self.prog}: unknown action "{action[:64]}": must be '
                              f"{listed(choices)}{did_you_mean(action, choices)}")
            namespace = choices[action].parse(words[1:])
            namespace.action = action
            return namespace
        namespace, more = self.parse_known_args(self._joined(words), namespace)
        for word in more:
            if word != "--":
                raise Refusal(f'unexpected argument "{word[:100]}"; see --help')
        return namespace

    def _joined(self, words):
        """`--name value` as `--name=value`, so that the value may begin with a dash."""
        joined, rest = [], iter(words)
        for word in rest:
            name, equals, _ = word.partition("=")
            if word[:1] != "-" or word == "-":
                joined.append(word)
                continue
            action = self._option_string_actions.get(name)
            if action is None:
                raise Refusal(f"{name[:100]}: unknown option{self._meant(name)}; see --help")
            if action.nargs == 0 and equals:
                raise Refusal(f"{name}: takes no value; see --help")
            if action.nargs != 0 and not equals:
                value = next(rest, None)
                if value is None:
                    raise Refusal(f"{name}: missing argument; see --help")
                word = f"{name}={value}"
            joined.append(word)
        return joined

    def _meant(self, name):
        known = self._option_string_actions
        synonym = _SYNONYMS.get(name.strip("-").casefold())
        if synonym and f"--{synonym.partition(',')[0]}" in known:
            return f"; did you mean --{synonym}?"
        return did_you_mean(name, [option for option in known if option.startswith("--")])

    def error(self, message):
        raise Refusal(f"{message}; see --help")

    def _print_message(self, message, file=None):
        emit(message)
