# SPDX-License-Identifier: BSD-3-Clause
"""Outputs: whole files, under their final name only.

    places = files.Places()                 # before the work: refuses what cannot be written
    places.read("--material", material)
    places.write("--output", path, ".meta.json")
    places.check()                          # and inputs that are outputs
    files.write((path, text), (files.beside(path, ".meta.json"), record))

The rule for every output: symbolic links are followed and stay. A regular file, or none yet, is
replaced as a whole: it is written beside as OUT.restitute-N.tmp, locked, flushed to the disk, then
renamed; it has the mode of the file that it replaces. A killed process leaves an unlocked temporary
file, which the next output to that place removes. A device, a pipe, and an open file that
/dev/stdout or /proc/self/fd/N names are written through. A folder, a socket and a block device are
refused. No path, or "-", is standard output.
"""
import errno
import fcntl
import io
import os
import stat
from contextlib import suppress
from typing import Any

from restitute.command.options import Refusal, emit, signals_wait, write_all


class Place:
    """Where a path leads: `target`, the name behind all symbolic links, and its `folder`; `status`
    of what is there, None if nothing is yet; whether it is written `through`; the `descriptor` of
    this process that it names, or None."""

    def __init__(self, path):
        self.target, self.through = path, False
        self.status: Any = None
        self.descriptor: Any = None
        self._follow_links()
        self.folder = os.path.dirname(self.target) or "."
        mode = self.status.st_mode if self.status else stat.S_IFREG
        if stat.S_ISCHR(mode) or stat.S_ISFIFO(mode):
            self.through = True
        elif not stat.S_ISREG(mode) and self.descriptor is None:
            raise _error(errno.EISDIR if stat.S_ISDIR(mode) else errno.ENOTSUP)

    def _follow_links(self):
        for _ in range(40):
            try:
                self.status = os.lstat(self.target)
            except FileNotFoundError:
                self.status = None
                return
            if not stat.S_ISLNK(self.status.st_mode):
                return
            folder = os.path.dirname(self.target)
            real = os.path.realpath(folder or ".")
            if real.startswith("/proc/"):  # an open file, no place: its name must not be replaced
                self.through, self.status = True, os.stat(self.target)
                if real == f"/proc/{os.getpid()}/fd":
                    self.descriptor = int(os.path.basename(self.target))
                return
            self.target = os.path.join(folder, os.readlink(self.target))
        raise _error(errno.ELOOP)

    def check(self):
        """Raises OSError if we may not write there. A read-only file is not replaced."""
        if self.descriptor is not None:
            if fcntl.fcntl(self.descriptor, fcntl.F_GETFL) & os.O_ACCMODE == os.O_RDONLY:
                raise _error(errno.EBADF)
            return
        if not self.through:
            os.stat(self.folder)
            if os.path.realpath(self.folder).startswith(("/proc", "/sys")):
                raise OSError(errno.EACCES, "no file can be made in this folder")
        if self.status and not os.access(self.target, os.W_OK) or \
                not self.through and not os.access(self.folder, os.W_OK | os.X_OK):
            read_only = os.statvfs(self.folder).f_flag & os.ST_RDONLY
            raise _error(errno.EROFS if read_only else errno.EACCES)

    def open_through(self):
        """A new descriptor of what is written through."""
        if self.descriptor is not None:
            return os.dup(self.descriptor)
        return os.open(self.target, os.O_WRONLY | os.O_APPEND | os.O_NOCTTY)

    def create(self, name):
        """A new file with the mode and owner of what is at this place. Returns its descriptor."""
        descriptor = os.open(name, os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW,
                             0o600 if self.status else 0o666)
        if self.status:
            mode = self.status.st_mode & 0o777
            try:
                os.fchown(descriptor, self.status.st_uid, self.status.st_gid)
            except OSError:
                try:
                    os.fchown(descriptor, -1, self.status.st_gid)
                except OSError:  # another group gets no more rights than others have
                    mode = mode & 0o707 | mode & (mode & 0o007) << 3
            os.fchmod(descriptor, mode)
        return descriptor


def _error(number):
    return OSError(number, os.strerror(number))


def is_standard(path):
    """Whether this output is standard output."""
    return path is None or path == "-"


def is_stream(path):
    """Whether an output is written through, so that nothing can lie beside it."""
    try:
        return is_standard(path) or Place(path).through
    except OSError:
        return False


def beside(path, suffix):
    """The name of what lies beside an output, behind all links."""
    try:
        return Place(path).target + suffix
    except OSError:
        return path + suffix


def not_written(path, problem):
    """The Refusal for an OSError."""
    what = "standard output" if is_standard(path) else f"{path}:"
    return Refusal(f"{what} cannot be written: {problem.strerror or problem}")


def check(path, option):
    """Refuses an output that cannot be written, before the work is done."""
    if is_standard(path):
        return
    if not path:
        raise Refusal(f"{option} is empty: must be a file name")
    try:
        Place(path).check()
    except OSError as problem:
        if problem.errno in (errno.EISDIR, errno.ENOTSUP):
            raise Refusal(f"{option} = {path}: is not a regular file, nor a device or pipe; - is "
                          "standard output") from None
        raise not_written(f"{option} = {path}", problem) from None


def lock(descriptor, name):
    """Lock an open file as long as it is open; or BlockingIOError, another process has locked it,
    or FileNotFoundError, it no longer has this name."""
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as problem:
        if isinstance(problem, BlockingIOError):
            raise
        return  # a file system without locks
    if not os.path.samestat(os.fstat(descriptor), os.lstat(name)):
        raise FileNotFoundError(errno.ESTALE, os.strerror(errno.ESTALE))


def rename(name, target):
    """Give a flushed file its final name, and flush that, if the file system can flush a folder."""
    os.replace(name, target)
    with suppress(OSError):
        descriptor = os.open(os.path.dirname(target) or ".", os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


class NewFile:
    """An output that is written, and has not got its name. What is written through is complete."""

    def __init__(self, path, content):
        self.path, self.temporary = path, None
        if is_standard(path):
            emit(content)
            return
        self.place = Place(path)
        self.place.check()
        self.descriptor = self.place.open_through() if self.place.through else self._create()
        try:
            write_all(self.descriptor, content)
            if self.temporary:
                os.fsync(self.descriptor)
        except BaseException:
            self.drop()
            raise
        if not self.temporary:
            os.close(self.descriptor)

    def _create(self):
        """The temporary file with the first free number. Until it is locked, another process may
        take it for one that a killed process left."""
        for i in range(1000):
            name = f"{self.place.target}.restitute-{i}.tmp"
            with suppress(OSError):
                descriptor = os.open(name, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
                with os.fdopen(descriptor):
                    lock(descriptor, name)
                    os.unlink(name)  # a killed process left it
            try:
                descriptor = self.place.create(name)
            except FileExistsError:
                continue
            try:
                lock(descriptor, name)
            except (BlockingIOError, FileNotFoundError):
                os.close(descriptor)
                continue
            self.temporary = name
            return descriptor
        raise _error(errno.EEXIST)

    def commit(self):
        """Give it its name."""
        if self.temporary:
            rename(self.temporary, self.place.target)
            self.temporary = None
            os.close(self.descriptor)

    def drop(self):
        """Remove it, if it has no name yet."""
        if self.temporary:
            with suppress(FileNotFoundError):
                os.unlink(self.temporary)
            self.temporary = None
            os.close(self.descriptor)


def write(*outputs, between=None):
    """Write outputs (path, str or bytes) that belong together: all of them get their names, or none
    and a Refusal says why. `between()` is called when all are written and none has its name."""
    done, path = [], None
    try:
        for path, content in outputs:
            done.append(NewFile(path, content))
        with signals_wait():
            if between:
                between()
            for file in done:
                path = file.path
                file.commit()
    except BrokenPipeError:
        raise
    except OSError as problem:
        raise not_written(path, problem) from None
    finally:
        for file in done:
            file.drop()


def image(axes, path):
    """The figure of these axes, as bytes of the format that the path ends in."""
    from restitute import plot

    content = io.BytesIO()
    plot.save(axes, content, os.path.splitext(path)[1][1:].lower())
    return content.getvalue()


def hdf5(datasets, units, group="/", **attributes):
    """The bytes of an HDF5 file: arrays with their units."""
    import h5py

    content = io.BytesIO()
    with h5py.File(content, "w") as file:
        file.attrs.update(attributes)
        for name, values in datasets.items():
            data = file.require_group(group).create_dataset(name, data=values)
            if name in units:
                data.attrs["unit"] = units[name]
    return content.getvalue()


class Places:
    """What a run reads and writes: no input is an output, no two outputs are one."""

    def __init__(self):
        self._items = []

    def read(self, name, path):
        """A file that the run reads; `name` is what gives it."""
        if path is not None:
            self._items.append(_Item(name, path, False))

    def write(self, name, path, *suffixes):
        """An output, None is standard output, and what is written beside it; refused if it cannot
        be written."""
        check(path, name)
        self._items.append(_Item(name, path, True))
        if not is_stream(path):
            self._items += [_Item(f"{name} ({suffix})", beside(path, suffix), True)
                            for suffix in suffixes]

    def check(self):
        """Refuses the first pair that is the same file."""
        for i, output in enumerate(self._items):
            for k, other in enumerate(self._items):
                if output.written and (k < i or not other.written) and output.same(other):
                    raise _clash(output, other)


def _clash(output, other):
    if not other.written:
        return Refusal(f"{output.name} = {output.path}: is an input of this run, {other.name} "
                       f"{other.path}, and would be overwritten")
    if output.descriptor == other.descriptor == 1:
        return Refusal(f"{output.name} and {other.name} are both standard output: at most one can "
                       "be")
    return Refusal(f"{output.name} and {other.name} are the same file, {output.path}")


class _Item:
    """A file of a run. What can be no file is like no other: whoever opens it says why."""

    def __init__(self, name, path, written):
        self.name, self.path, self.written = name, "-" if path is None else path, written
        self.descriptor: Any = None
        self._identity: Any = None
        with suppress(OSError):
            if self.path == "-":
                self.descriptor = int(written)
                self._identify(os.fstat(self.descriptor))
                return
            place = Place(self.path)
            self.descriptor = place.descriptor
            if place.status:
                self._identify(place.status)
            else:
                folder = os.stat(place.folder)
                self._identity = (folder.st_dev, folder.st_ino, os.path.basename(place.target))

    def _identify(self, status):
        if stat.S_ISREG(status.st_mode):
            self._identity = (status.st_dev, status.st_ino)

    def same(self, other):
        """Whether both are one file."""
        return self.descriptor is not None and self.descriptor == other.descriptor or \
            self._identity is not None and self._identity == other._identity
