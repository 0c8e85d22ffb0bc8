# SPDX-License-Identifier: BSD-3-Clause
"""What faults leave behind. Each run of RUNS is disturbed in these ways:

killed   as by kill -9, before each call that changes a file, and at random times
stopped  before each such call; meanwhile a second process makes the same files
refused  each such call fails for lack of room, or by an error of the disk, or the place is
         read-only; writes take only a part
disks    of every size that is too small, and one that cannot be written (needs root)

Afterwards every file under a final name is whole, the one before or the new one; what else is there
is a temporary or a partial file. The same command, with --resume where there is one, then ends with
the files of an undisturbed run and nothing beside them. Also every allocation of our libraries
beneath the Python package fails (memory.py).
"""
import collections
import errno
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

RESTITUTE, PRELOAD = os.environ["RESTITUTE"], os.environ["PRELOAD"]
PLACE = Path("place")
BALL = "--material polyisobutylene --radius 0.005 --density 7800 --friction 0.3"
BUILD = """
import sys; sys.path.insert(0, sys.argv[1])
import restitute
rubber = restitute.Material.standard_solid(1e6, 3e6, 300.0)
restitute.Table.build(rubber, radius=0.001, density=1200, friction=0.3, speeds=(0.01, 0.1),
                      tolerance=1e-3).save("t.h5")
"""
RUNS = {
    "table": f"table build {BALL} --speed 0.1:1 --tolerance 1e-3 --output t.h5",
    "table by Python": None,
    "batch": "pair --input ../cases.csv --delta1 1 --gamma 1 --threads 1 --output out.csv --resume",
    "fit": "fit --input ../drops.csv --radius 0.01 --density 7800 --output fit.json",
    "figure": "pair --grid psi=0:1:12 --gamma 1 --delta1 1 --output grid.csv --figure grid.svg "
              "--resume",
    "batch as HDF5": "pair --input ../cases.csv --delta1 1 --gamma 1 --output out.h5 --resume",
    "history": "history --method cvode --psi 0.7 --delta1 1 --gamma 1 --samples 5 "
               "--events e.csv --output h.csv --figure h.png",
}
SHORT = ("table by Python", "batch", "fit", "batch as HDF5")
PARTIAL, TEMPORARY = r".*\.partial(\.json)?", r".*\.restitute-\d+\.tmp"
ALL = 10**9  # no call has this number
OLD = b"of an earlier run\n"


def files():
    """Bytes of each file, without its dates."""
    dates = rb"/(CreationDate|ModDate) \([^)]*\)|<dc:date>[^<]*"
    return {path.name: re.sub(dates, b"", path.read_bytes()) for path in sorted(PLACE.iterdir())}


class Run:
    """A run, and what it gives undisturbed: exit status, files, calls, seconds."""

    def __init__(self, words):
        self.command = [RESTITUTE, *words.split()] if words else \
            [sys.executable, "-c", BUILD, os.environ["PACKAGE"]]
        PLACE.mkdir(exist_ok=True)
        self.end(self.start())  # once before, for caches
        self.clear(old=False)
        since, log = time.monotonic(), Path("log").absolute()
        self.status, _ = self.end(self.start(FAULT_LOG=log))
        self.seconds, self.files = time.monotonic() - since, files()
        self.calls = log.read_text().splitlines()
        log.unlink()
        assert self.status in (0, 1) and self.files and self.calls, f"exit status {self.status}"

    def start(self, **fault):
        fault |= {"LD_PRELOAD": PRELOAD, "LC_ALL": "C.UTF-8", "FAULT_FOLDER": PLACE.absolute()}
        environment = os.environ | {name: str(value) for name, value in fault.items()}
        return subprocess.Popen(self.command, cwd=PLACE, env=environment, text=True,
                                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE)

    @staticmethod
    def end(process):
        said = process.communicate(timeout=300)[1]
        return process.returncode, said

    def clear(self, old):
        """Empty the place, or leave only files of an earlier run in it."""
        shutil.rmtree(PLACE)
        PLACE.mkdir()
        self.before = dict.fromkeys(self.files, OLD) if old else {}
        for name in self.before:
            (PLACE / name).write_bytes(OLD)

    def check(self, left=f"{PARTIAL}|{TEMPORARY}"):
        """Nothing is lost, nothing half done under a final name."""
        there = files()
        for name in there | self.before:
            if name in self.files:
                right = (self.files[name], self.before.get(name))
                assert there.get(name) in right, f"{name} is lost or half written"
            else:
                assert re.fullmatch(left, name), f"{name} is left"
        return there

    def check_again(self, **fault):
        """Another run mends all."""
        status, said = self.end(self.start(**fault))
        assert status == self.status, f"then exit status {status}: {said}"
        self.check_done()

    def check_done(self):
        there = files()
        differ = [name for name in there | self.files if there.get(name) != self.files.get(name)]
        assert not differ, f"then {differ} differ"

    # -------------------------------------------------------------------------------- the faults

    def killed(self, at, after=0):
        """At a call, or with 0 after so many seconds."""
        self.clear(random.random() < 0.5)
        process = self.start(FAULT=-signal.SIGKILL, FAULT_AT=at, FAULT_LAST=at)
        if after:
            time.sleep(after)
            process.kill()
        status, said = self.end(process)
        # The pieces of a batch depend on the time that rows take: there may be fewer calls.
        assert status in (-signal.SIGKILL, self.status), f"exit status {status}: {said}"
        self.check()
        self.check_again()

    def stopped(self, at):
        self.clear(random.random() < 0.5)
        first = self.start(FAULT=-signal.SIGSTOP, FAULT_AT=at, FAULT_LAST=at)
        os.waitid(os.P_PID, first.pid, os.WSTOPPED | os.WEXITED | os.WNOWAIT)
        second = self.end(self.start())
        self.check()
        first.send_signal(signal.SIGCONT)
        first = self.end(first)
        for status, said in (first, second):
            assert status == self.status or status == 2 and "another process" in said, \
                f"exit status {status}: {said}"
        assert self.status in (first[0], second[0]), f"neither is done: {first[1]} {second[1]}"
        self.check_done()

    def refused(self, at, last, number):
        self.clear(random.random() < 0.5)
        process = self.start(FAULT=number, FAULT_AT=at, FAULT_LAST=last)
        self.check_refusal(*self.end(process), number)

    def check_refusal(self, status, said, number):
        """Done, or the message says why not."""
        there = self.check(left=PARTIAL)
        if status == self.status:
            assert all(there.get(name) == self.files[name] for name in self.files), "is not done"
        else:
            by_command = self.command[0] == RESTITUTE
            assert status == (2 if by_command else 1) and os.strerror(number) in said and not (
                by_command and "Traceback" in said), f"exit status {status}: {said}"
        self.check_again()

    def short(self):
        self.clear(old=False)
        self.check_again(FAULT_SHORT="yes")

    def on_disk(self, options, number):
        """On a disk of its own that is too small, or read-only. Then there is room."""
        self.before = {}
        subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", PLACE], check=True)
        try:
            status, said = self.end(self.start())
            subprocess.run(["mount", "-o", "remount,rw,size=100m", PLACE], check=True)
            self.check_refusal(status, said, number)
        finally:
            subprocess.run(["umount", PLACE], check=True)
        assert status != self.status, "has room enough"


def faults_of(run, times, disks):
    """Each fault: its name, what to call, and with what."""
    for at, call in enumerate(run.calls, 1):
        yield f"killed at call {at}, {call}", run.killed, at
        yield f"stopped at call {at}, {call}", run.stopped, at
        yield f"full from call {at}, {call}", run.refused, at, ALL, errno.ENOSPC
        yield f"broken disk at call {at}, {call}", run.refused, at, at, errno.EIO
    yield "read-only", run.refused, 1, ALL, errno.EROFS
    yield "short writes", run.short
    for _ in range(times):
        after = random.uniform(0, 1.05 * run.seconds)
        yield f"killed after {after:.4f} s", run.killed, 0, after
    if disks:
        yield "read-only disk", run.on_disk, "ro", errno.EROFS
        largest = max(map(len, run.files.values()))  # any smaller disk has no room for it
        for size in range(4096, largest, max(4096, largest // 20 // 4096 * 4096)):
            yield f"disk of {size} bytes", run.on_disk, f"size={size}", errno.ENOSPC


def main(words):
    numbers = [int(word) for word in words if not word.startswith("--")]
    times, seed = (*numbers, *(100, 2017)[len(numbers):])
    failures = 0
    os.environ["MPLCONFIGDIR"] = os.path.abspath("cache")
    Path("cases.csv").write_text("psi\n" + "".join(f"{i / 500}\n" for i in range(1500)))
    Path("drops.csv").write_text("speed_m_s,ez\n0.1,0.9\n1,0.75\n5,0.6\n")
    for name in SHORT if "--short" in words else RUNS:
        random.seed(seed)
        run, done = Run(RUNS[name]), collections.Counter()
        faults = faults_of(run, times, "--disks" in words)
        if "--short" in words:  # one of each kind that is at a call, and killed at the last one
            each = [[fault for fault in faults_of(run, 0, False) if fault[0].startswith(kind)]
                    for kind in ("killed", "stopped", "full")]
            faults = [*map(random.choice, each), each[0][-1]]
        for what, disturb, *given in faults:
            done[what.split()[0]] += 1
            try:
                disturb(*given)
            except AssertionError as fault:
                failures += 1
                print(f"FAILED: {name}, {what}: {fault}", flush=True)
        print(f"{name}: {dict(done)}", flush=True)
    return failures


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as place:
        os.chdir(place)
        found = main(sys.argv[1:])
        os.chdir("/")
    sys.exit(min(found, 1))
