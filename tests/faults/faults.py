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
import errno
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

RESTITUTE, PRELOAD = os.environ["RESTITUTE"], os.environ["PRELOAD"]
HERE = os.path.dirname(os.path.abspath(__file__))
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
SHORT = ("table by Python", "batch", "fit")
LEFT = re.compile(r".*(\.restitute-\d+\.tmp|\.partial|\.partial\.json)")
OLD = b"of an earlier run\n"


class Fault(Exception):
    """What is wrong after one."""


def need(condition, text):
    if not condition:
        raise Fault(text)


def content(path):
    """Bytes of a file, without its dates."""
    with open(path, "rb") as file:
        return re.sub(rb"/(CreationDate|ModDate) \([^)]*\)|<dc:date>[^<]*", b"", file.read())


def files(folder="."):
    return {name: content(os.path.join(folder, name)) for name in sorted(os.listdir(folder))}


class Run:
    """A run, and what it gives undisturbed: exit status, files, calls, seconds."""

    def __init__(self, name, words):
        self.name = name
        self.command = [RESTITUTE, *words.split()] if words else \
            [sys.executable, "-c", BUILD, os.environ["PACKAGE"]]
        os.makedirs("place", exist_ok=True)
        self.end(self.start())  # once before, for caches
        self.clear(old=False)
        since = time.monotonic()
        self.status, _ = self.end(self.start(FAULT_LOG=os.path.abspath("log")))
        self.seconds = time.monotonic() - since
        need(self.status in (0, 1), f"exit status {self.status}")
        with open("log", encoding="utf-8") as file:
            self.calls = file.read().splitlines()
        os.remove("log")
        self.files = files("place")
        need(self.files and self.calls, "no files or no calls")

    def start(self, **fault):
        environment = {**os.environ, "LD_PRELOAD": PRELOAD, "LC_ALL": "C.UTF-8",
                       "FAULT_FOLDER": os.path.abspath("place"), **fault}
        return subprocess.Popen(self.command, cwd="place", env=environment,
                                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True)

    @staticmethod
    def end(process):
        said = process.communicate(timeout=300)[1]
        return process.returncode, said

    def clear(self, old):
        """Empty the place, or leave only files of an earlier run in it."""
        for name in os.listdir("place"):
            os.remove(os.path.join("place", name))
        self.before = dict.fromkeys(self.files, OLD) if old else {}
        for name in self.before:
            with open(os.path.join("place", name), "wb") as file:
                file.write(OLD)

    def check(self, allowed=LEFT):
        """Nothing is lost, nothing half done under a final name."""
        there = files("place")
        for name, old in self.before.items():
            need(there.get(name) in (old, self.files[name]), f"{name} is lost or half written")
        for name, bytes_ in there.items():
            if name in self.files:
                need(bytes_ in (self.files[name], self.before.get(name)), f"{name} is half written")
            else:
                need(allowed.fullmatch(name), f"{name} is left")
        return there

    def check_again(self):
        """Another run mends all."""
        status, said = self.end(self.start())
        need(status == self.status, f"then exit status {status}: {said}")
        self.check_done()

    def check_done(self):
        there = files("place")
        need(list(there) == list(self.files), f"then {list(there)}")
        for name, bytes_ in there.items():
            need(bytes_ == self.files[name], f"then {name} differs")

    # -------------------------------------------------------------------------------- the faults

    def killed(self, at):
        self.clear(old=at % 2)
        status, said = self.end(self.start(FAULT="kill", FAULT_AT=str(at)))
        # The pieces of a batch depend on the time that rows take: there may be fewer calls.
        need(status in (-signal.SIGKILL, self.status), f"exit status {status}: {said}")
        self.check()
        self.check_again()

    def killed_after(self, seconds, old):
        self.clear(old)
        process = self.start()
        time.sleep(seconds)
        process.kill()
        self.end(process)
        self.check()
        self.check_again()

    def stopped(self, at):
        self.clear(old=at % 2)
        first = self.start(FAULT="stop", FAULT_AT=str(at))
        os.waitid(os.P_PID, first.pid, os.WSTOPPED | os.WEXITED | os.WNOWAIT)
        second = self.end(self.start())
        self.check()
        first.send_signal(signal.SIGCONT)
        first = self.end(first)
        for status, said in (first, second):
            need(status == self.status or status == 2 and "another process" in said,
                 f"exit status {status}: {said}")
        need(self.status in (first[0], second[0]), f"neither is done: {first[1]} {second[1]}")
        self.check_done()

    def refused(self, at, number, on):
        self.clear(old=at % 2)
        fault = {"FAULT": str(number), "FAULT_AT": str(at), **({"FAULT_ON": "yes"} if on else {})}
        self.check_refusal(*self.end(self.start(**fault)), number)

    def check_refusal(self, status, said, number):
        """Done, or the message says why not."""
        there = self.check(re.compile(r".*(\.partial|\.partial\.json)"))
        if status == self.status:
            need(all(there.get(name) == self.files[name] for name in self.files), "is not done")
        else:
            by_command = self.command[0] == RESTITUTE
            need(status == (2 if by_command else 1) and os.strerror(number) in said and
                 not (by_command and "Traceback" in said), f"exit status {status}: {said}")
        self.check_again()

    def short(self):
        self.clear(old=False)
        status, said = self.end(self.start(FAULT_SHORT="yes"))
        need(status == self.status, f"exit status {status}: {said}")
        self.check_done()

    def on_disk(self, options, number):
        """On a disk of its own; whether it is too small. Then there is room."""
        self.before = {}
        subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", "place"], check=True)
        try:
            status, said = self.end(self.start())
            subprocess.run(["mount", "-o", "remount,rw,size=100m", "place"], check=True)
            self.check_refusal(status, said, number)
        finally:
            subprocess.run(["umount", "place"], check=True)
        return status != self.status


def faults_of(run, times, disks, short):
    """Each fault: its name and what to call. The short form has one call for each kind."""
    calls = range(1, len(run.calls) + 1)
    if short:
        for kind in (run.killed, run.stopped, lambda at: run.refused(at, errno.ENOSPC, True)):
            at = random.choice(calls)
            yield f"call {at}", lambda kind=kind, at=at: kind(at)
        return
    for at in calls:
        call = f"call {at}, {run.calls[at - 1]}"
        yield f"killed at {call}", lambda at=at: run.killed(at)
        yield f"stopped at {call}", lambda at=at: run.stopped(at)
        yield f"full from {call}", lambda at=at: run.refused(at, errno.ENOSPC, True)
        yield f"broken disk at {call}", lambda at=at: run.refused(at, errno.EIO, False)
    yield "read-only", lambda: run.refused(1, errno.EROFS, True)
    yield "short writes", run.short
    for i in range(times):
        after = random.uniform(0, 1.05 * run.seconds)
        yield f"killed after {after:.4f} s", lambda i=i, after=after: run.killed_after(after, i % 2)
    if disks:
        yield "read-only disk", lambda: run.on_disk("ro", errno.EROFS)
        largest = max(map(len, run.files.values()))  # any smaller disk has no room for it
        for size in range(4096, largest, max(4096, largest // 20 // 4096 * 4096)):
            yield f"disk of {size} bytes", lambda size=size: need(
                run.on_disk(f"size={size}", errno.ENOSPC), "has room enough")


def prepare():
    random.seed(0)
    with open("cases.csv", "w", encoding="utf-8") as file:
        file.write("psi\n")
        file.writelines(f"{i / 500}\n" for i in range(1500))
    with open("drops.csv", "w", encoding="utf-8") as file:
        file.write("speed_m_s,ez\n0.1,0.9\n1,0.75\n5,0.6\n")


def main(words):
    short, disks = "--short" in words, "--disks" in words
    numbers = [int(word) for word in words if not word.startswith("--")]
    times, seed = (*numbers, *(100, 2017)[len(numbers):])
    failures = 0
    os.environ["MPLCONFIGDIR"] = os.path.abspath("cache")
    prepare()
    for name in SHORT if short else RUNS:
        random.seed(seed)
        done, run = {}, Run(name, RUNS[name])
        for what, disturb in faults_of(run, times, disks, short):
            kind = what.split()[0]
            done[kind] = done.get(kind, 0) + 1
            try:
                disturb()
            except Fault as fault:
                failures += 1
                print(f"FAILED: {name}, {what}: {fault}", flush=True)
                shutil.rmtree("place")
                os.mkdir("place")
        print(f"{name}: {json.dumps(done)}", flush=True)
    return failures


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as place:
        os.chdir(place)
        found = main(sys.argv[1:])
        os.chdir("/")
    sys.exit(min(found, 1))
