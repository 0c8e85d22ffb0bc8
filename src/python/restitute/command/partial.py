# SPDX-License-Identifier: BSD-3-Clause
"""A run that can be continued: its rows lie in OUT.partial, its settings in OUT.partial.json.

Both belong to one process at a time. OUT.partial gets the name OUT when all rows are there.
"""
import json
import os
import stat
from contextlib import suppress

from restitute.command import files, provenance
from restitute.command.options import Refusal, write_all


class Partial:
    """The file of an unfinished run, `path`, locked. It is `empty` if nothing is done yet."""

    def __init__(self, output, resume):
        place = files.Place(output)
        self.target, self.path = place.target, place.target + ".partial"
        self.settings_path = place.target + ".partial.json"
        self.descriptor: int = -1
        while self.descriptor < 0:
            self._open(place, resume)
        self.empty: bool = os.fstat(self.descriptor).st_size == 0

    def _open(self, place, resume):
        """Open and lock it; in vain if the name has gone to another file meanwhile."""
        found = False
        try:
            try:
                descriptor = place.create(self.path)
            except FileExistsError:
                found = True
                descriptor = os.open(self.path, os.O_RDWR | os.O_NOFOLLOW | os.O_NONBLOCK)
        except OSError as problem:
            raise files.not_written(self.path, problem) from None
        try:
            if not stat.S_ISREG(os.fstat(descriptor).st_mode):
                raise Refusal(f"{self.path} is not a regular file: remove it")
            files.lock(descriptor, self.path)
            if found and not resume:
                raise Refusal(f"{self.path} is left from an interrupted run: continue it with "
                              "--resume, or remove it")
            self.descriptor = descriptor
        except FileNotFoundError:
            pass
        except BlockingIOError:
            raise Refusal(f"{self.path} is being written by another process") from None
        finally:
            if self.descriptor < 0:
                os.close(descriptor)

    def begin(self, settings, header):
        """Settings and header of a file in which nothing is done."""
        files.write((self.settings_path, provenance.text(settings)))
        write_all(self.descriptor, header, f"{self.path}:")

    def check_settings(self, settings):
        """Refuses to go on with other settings."""
        try:
            with open(self.settings_path, "rb") as file:
                before = json.load(file)
        except (OSError, ValueError) as why:
            raise Refusal(f"{self.settings_path}: cannot be read: {why}") from None
        for key, value in json.loads(provenance.text(settings)).items():
            if key not in before or before[key] != value:
                raise Refusal(f"--resume: {key} of this run differs from that of "
                              f"{self.settings_path}")

    def cut(self):
        """Remove a last line that was not written to its end."""
        _, length = self._scan()
        os.ftruncate(self.descriptor, length)
        os.lseek(self.descriptor, length, os.SEEK_SET)
        self.empty = length == 0

    def rows(self):
        """How many rows are complete."""
        return self._scan()[0] - 1

    def _scan(self):
        """Complete lines, and where the last of them ends; not within quotes."""
        with open(self.path, "rb") as file:
            content = file.read()
        if b'"' not in content:
            return content.count(b"\n"), content.rfind(b"\n") + 1
        lines = length = at = quotes = 0
        for line in content.split(b"\n")[:-1]:
            at += len(line) + 1
            quotes += line.count(b'"')
            if quotes % 2 == 0:
                lines, length = lines + 1, at
        return lines, length

    def commit(self, rows):
        """Give it the final name, if it has as many rows and a header."""
        found = self._scan()[0]
        if found != rows + 1:
            raise Refusal(f"{self.path} has {found} lines, not {rows + 1}: something else wrote to "
                          "it")
        try:
            os.fsync(self.descriptor)
            files.rename(self.path, self.target)
        except OSError as problem:
            raise files.not_written(self.target, problem) from None
        with suppress(FileNotFoundError):
            os.unlink(self.settings_path)
        self.leave()

    def remove(self):
        """Leave nothing of it. It is emptied first: a run that is killed meanwhile leaves no rows
        without settings."""
        with suppress(OSError):
            os.ftruncate(self.descriptor, 0)
        for name in (self.settings_path, self.path):
            with suppress(FileNotFoundError):
                os.unlink(name)
        self.leave()

    def leave(self):
        """Close it, which ends the lock."""
        if self.descriptor >= 0:
            os.close(self.descriptor)
            self.descriptor = -1
