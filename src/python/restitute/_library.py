# SPDX-License-Identifier: BSD-3-Clause
"""The shared libraries: loading, calls whose failures are exceptions, structs.

    from restitute import _library
    scene = _library.struct("scene", radius1=0.005)
    _library.call(_library.core.restitute_scene_numbers, scene, numbers)

A component is loaded when it is first named: `cvode`, `table`, `table_files`, `bem`, `files`,
`contact`, `fit`.
"""
import os
import queue
import re
import sys
import threading
import warnings

from restitute import errors
from restitute._binding import ffi
from restitute._places import LIBRARIES

__all__ = ["array_type", "call", "ffi", "string", "struct", "text"]
_COMPONENTS = ("cvode", "table", "table_files", "bem", "files", "contact", "fit")


def __getattr__(name):
    if name not in _COMPONENTS:
        raise AttributeError(f"module 'restitute._library' has no attribute '{name}'")
    globals()[name] = library = _load(name)
    return library


def _load(component):
    if not available(component):
        raise errors.MissingComponent(f"the component {component} is not installed with this "
                                      "package")
    # Materials and threads of OpenMP may outlive the library at the interpreter's end: it stays.
    return ffi.dlopen(_path(component), ffi.RTLD_NOW | ffi.RTLD_NODELETE)


def _path(component):
    return os.path.join(os.path.dirname(__file__), LIBRARIES[component])


def available(component):
    """Whether a component is installed with this package. Debian packages bring some apart."""
    return component in LIBRARIES and os.path.exists(_path(component))


core = _load("core")  # first, so that components find it loaded


def text(chars):
    """A string of C."""
    return ffi.string(chars).decode("utf-8", "replace")


# What C calls otherwise than the keywords of this package do.
_KEYWORDS = ((r"deformable = 2: must be 1 with a material from \w+",
              "partner = 'same': must be 'rigid' with an effective material"),
             (r"options\.relaxation_time\b", "terms"), (r"\boptions\.wlf_c1, wlf_c2\b", "wlf"),
             (r"\b(?:options|scene|motion|rates|contact)\.(?=\w)", ""),
             (r"\b(radius|mass|inertia|spin)1\b", r"\1"), (r"\bn_terms = 0\b", "no terms"),
             (r"\bshear_(?=modulus \(Pa\) = )", ""), (r"^speed(?= \(m/s\) = \S+ to )", "speeds"),
             (r"\b(normal|sliding)_speeds\b", r"\1_speed"),
             (r"; (use )?restitute_contact_(turn|rates_set)[a-z ]*", ""),
             (r"\brestitute_contact_(?=time_step_limit)", "ContactLaw."))


def message_of(error):
    """The words of a restitute_error, with the names of keywords, and with numbers as short as they
    can be: 0.6 for 0.59999999999999998."""
    words = text(error.message)
    for ours, keyword in _KEYWORDS:
        words = re.sub(ours, keyword, words)
    long_number = r"(?<=[ \[(-])\d+\.\d{14,}(e[-+]\d+)?(?=[]:,;) ]|$)"
    return re.sub(long_number, lambda match: repr(float(match[0])), words)


def string(value):
    """A string for C, e.g. a path."""
    return ffi.new("char[]", os.fsencode(value))


def exception(status, message):
    """The exception for a failed call."""
    kinds = {core.RESTITUTE_ERROR_DOMAIN: errors.DomainError,
             core.RESTITUTE_ERROR_FORMAT: errors.FormatError,
             core.RESTITUTE_ERROR_FILE: errors.FileError}
    if status == core.RESTITUTE_ERROR_MEMORY:
        return MemoryError(message)
    if status == core.RESTITUTE_ERROR_INTERRUPTED:
        return KeyboardInterrupt(message)
    error = kinds.get(status, errors.SolverError)(message)
    error.status = status
    return error


def call(function, *arguments):
    """Call a function whose last argument is an error.

    Returns
    -------
    status : int
        0 or a positive remark.
    message : str
        The remarks, or an empty text.
    """
    error = ffi.new("restitute_error *")
    status = function(*arguments, error)
    message = message_of(error)
    if status < 0:
        raise exception(status, message or text(core.restitute_status_text(status)))
    return status, message


def struct(name, component="core", **members):
    """A new struct restitute_NAME with its defaults, and these members set."""
    value = ffi.new(f"restitute_{name} *")
    library = globals().get(component) or __getattr__(component)
    getattr(library, f"restitute_{name}_init_sized")(value, ffi.sizeof(value[0]))
    fields = dict(ffi.typeof(value[0]).fields)
    del fields["struct_size"]
    for member, content in members.items():
        if member not in fields:
            raise TypeError(f"'{member}' is no keyword here{errors.suggestion(member, fields)}")
        real = fields[member].type.cname == "double"
        try:
            if real and isinstance(content, bool):
                raise TypeError
            setattr(value, member, content)
        except (TypeError, OverflowError):
            raise errors.DomainError(f"{member} = {errors.shown(content)}: must be a "
                                     f"{'number' if real else 'whole number'}") from None
    return value


def array_type(name):
    """The NumPy dtype of restitute_NAME: fields at the offsets that C gives them."""
    import numpy as np

    kind = ffi.typeof(f"restitute_{name}")
    names, formats, offsets = [], [], []
    for member, field in kind.fields:
        names.append(member)
        offsets.append(field.offset)
        formats.append(_format(field.type))
    return np.dtype({"names": names, "formats": formats, "offsets": offsets,
                     "itemsize": ffi.sizeof(kind)})


def _format(kind):
    """What a member is in NumPy; pointers are integers of their size."""
    if kind.kind == "array":
        return (_format(kind.item), (kind.length,))
    if kind.kind == "pointer":
        return "u8" if ffi.sizeof(kind) == 8 else "u4"
    if kind.cname == "char":
        return "S1"
    unsigned = kind.cname.startswith(("u", "size_t"))
    letter = "f" if kind.cname in ("double", "float") else "u" if unsigned else "i"
    return f"{letter}{ffi.sizeof(kind)}"


def structs(name, count, component="core"):
    """`count` structs restitute_NAME with their defaults, as a NumPy array of records, whose memory
    C can be given by `pointer`."""
    import numpy as np

    first = struct(name, component)
    record = np.frombuffer(ffi.buffer(first), array_type(name))
    return np.repeat(record, count)


def pointer(array, kind=None):
    """The memory of a contiguous array for C; `kind` as in "restitute_scene[]", by default that of
    its numbers."""
    kind = kind or {"f8": "double[]", "i4": "int[]", "i8": "int64_t[]"}[array.dtype.str[1:]]
    return ffi.from_buffer(kind, array)


def members(value):
    """The members of a struct as a dict: numbers, tuples of them, texts. Pointers are left out."""
    found = {}
    for name, field in ffi.typeof(value[0]).fields:
        member, kind = getattr(value, name), field.type
        if kind.kind == "array":
            found[name] = text(member) if kind.item.cname == "char" else tuple(member)
        elif kind.kind == "primitive" and name != "struct_size":
            found[name] = member
    return found


def interruptible(function, *arguments, keep=None, options=None):
    """`call` in a thread of its own, so that Ctrl-C ends the wait at once.

    The call itself ends where it asks `options.interrupted`, or goes on to its end without
    `options`. Until then `keep` lives, what its pointers lead to.
    """
    outcome: queue.SimpleQueue = queue.SimpleQueue()
    ended = threading.Event()
    if options is not None:
        options.interrupted = ask = ffi.callback("int(void *)", lambda _: int(ended.is_set()))
        keep = keep, options, ask

    def run(keep):
        try:
            outcome.put(call(function, *arguments))
        except BaseException as problem:  # handed over to the caller's thread
            outcome.put(problem)

    threading.Thread(target=run, args=(keep,), daemon=True).start()
    try:
        found = outcome.get()
    finally:
        ended.set()
    if isinstance(found, BaseException):
        raise found
    return found


def warn(message, category):
    """A warning that points at the caller of the package."""
    frame, level = sys._getframe(1), 2
    while frame.f_back and frame.f_globals.get("__name__", "").partition(".")[0] == "restitute":
        frame, level = frame.f_back, level + 1
    warnings.warn(message, category, stacklevel=level)
