"""A copy of the sources in which faults are made, built and tested, one at a time."""

import contextlib
import fcntl
import hashlib
import os
import pathlib
import re
import resource
import signal
import subprocess
import time
from dataclasses import dataclass

NOT_COPIED = {".git", "build", "results", "__pycache__"}
# Whatever a mutant does, it neither fills the memory nor the disk.
MEMORY_BYTES = 4 << 30
FILE_BYTES = 1 << 30


class Failed(Exception):
    """Something that must work does not."""


@dataclass(frozen=True)
class Step:
    """Some tests of one link, and what is built for them.

    Without `ctest`, a regular expression of names of tests, the targets are GoogleTest programs, of
    which `only` the test of that name counts, if one is given.
    """

    link: str
    targets: tuple
    ctest: str = ""
    only: str = ""
    is_meant: bool = False  # the fault that it is tried on is its own to notice


@dataclass(frozen=True)
class Verdict:
    outcome: str  # "killed", "survived", or "senseless": the compiler does not take it
    link: str = ""  # that killed it
    by: str = ""  # the test, or the line that did not compile
    is_meant: bool = False  # it was that test's own to notice


def sources(root):
    """All files below `root` that are no results, as paths relative to it."""
    for folder, folders, files in os.walk(root):
        folders[:] = sorted(set(folders) - NOT_COPIED)
        for name in sorted(files):
            yield pathlib.Path(folder, name).relative_to(root)


def digest(root):
    """Changes where any source does."""
    total = hashlib.sha256()
    for path in sources(root):
        content = (root / path).read_bytes()
        total.update(f"{path}\0{len(content)}\0".encode())
        total.update(content)
    return total.hexdigest()


class Workshop:
    """`folder` keeps the copy and its build, so that the next one is incremental."""

    def __init__(self, root, folder, options=(), jobs=None, shortest_limit_s=30.0):
        self.root = pathlib.Path(root)
        self.folder = pathlib.Path(folder)
        self.copy = self.folder / "source"
        self.build = self.folder / "build"
        self.log = self.folder / "last.log"
        self.options = list(options)
        self.jobs = str(jobs or os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or os.cpu_count())
        self.shortest_limit_s = shortest_limit_s
        self.limits_s = {}  # by step: a mutant that takes longer hangs

    @contextlib.contextmanager
    def locked(self):
        self.folder.mkdir(parents=True, exist_ok=True)
        with open(self.folder / "lock", "w") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                raise Failed(f"another run is at work in {self.folder}") from None
            yield

    def synchronise(self):
        """Makes the copy equal to the sources. What is equal keeps its time, and so its objects."""
        wanted = set(sources(self.root))
        if self.copy.exists():
            for path in set(sources(self.copy)) - wanted:
                (self.copy / path).unlink()
        for path in wanted:
            self.write(path, (self.root / path).read_bytes(), (self.root / path).stat().st_mode)

    def write(self, path, content, mode=None):
        target = self.copy / path
        if target.exists() and target.read_bytes() == content:
            return
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content)
        if mode is not None:
            target.chmod(mode)

    def configure(self):
        command = ["cmake", "-S", self.copy, "-B", self.build, "-G", "Ninja", *self.options]
        if self.run(command)[0] != 0:
            raise Failed(f"the copy cannot be configured:\n{self.log.read_text()}")

    def control(self, steps):
        """The copy without a fault must pass; how long it takes says when a mutant hangs."""
        targets = sorted({target for step in steps for target in step.targets})
        if self.compile(targets)[0] != 0:
            raise Failed(f"the sources do not build:\n{self.tail()}")
        for step in steps:
            started = time.monotonic()
            self.limits_s.pop(step, None)
            failure = self.test(step)
            if step.only and "Running 0 tests" in self.tail(1 << 20):
                raise Failed(f"{step.targets[0]} has no test {step.only}")
            if failure:
                raise Failed(f"without a fault, too, a test fails: {failure}\n{self.tail()}")
            self.limits_s[step] = max(self.shortest_limit_s, 20 * (time.monotonic() - started))

    def judge(self, fault, steps):
        """Makes the fault, and tries step after step until one notices it."""
        original = (self.copy / fault.file).read_bytes()
        self.write(fault.file, fault.mutant(self.copy))
        try:
            for step in steps:
                status, output = self.compile(step.targets)
                if status != 0:
                    return self.not_built(step, output)
                failure = self.test(step)
                if failure:
                    return Verdict("killed", step.link, failure, step.is_meant)
            return Verdict("survived")
        finally:
            self.write(fault.file, original)

    def not_built(self, step, output):
        """Why a mutant does not build: an assertion refuses it, or it is nonsense."""
        error = re.search(r"^(?:.*/)?([^/\n]+:\d+):.*error: (.*)$", output, re.MULTILINE)
        if error and "static assertion" in error[2]:
            return Verdict("killed", "compiler", f"{error[1]} {error[2]}", True)
        if "Error running test executable" in output:
            return Verdict("killed", step.link, "the program of the tests does not start", step.is_meant)
        if not error:
            raise Failed(f"the build of a mutant fails otherwise than by an error in it:\n{output[-4000:]}")
        return Verdict("senseless", by=f"{error[1]} {error[2]}")

    def compile(self, targets):
        if not targets:
            return 0, ""
        return self.run(["cmake", "--build", self.build, "--parallel", self.jobs, "--target", *targets])

    def test(self, step):
        """The name of a test that fails, or empty."""
        limit_s = self.limits_s.get(step)
        if step.ctest:
            status, output = self.run(
                ["ctest", "--test-dir", self.build, "--parallel", self.jobs, "--stop-on-failure",
                 "--no-tests=error", "--tests-regex", step.ctest],
                limit_s, hold_back,
            )
            if status == 0:
                return ""
            failed = re.search(r"^\s*\d+ - (\S+) \((.*)\)$", output, re.MULTILINE)
            return f"{failed[1]} ({failed[2]})" if failed else how_it_ended(status)
        only = [f"--gtest_filter=*.{step.only}:*.{step.only}/*"] if step.only else []
        for program in step.targets:
            status, output = self.run([self.build / program, "--gtest_fail_fast", *only], limit_s, hold_back)
            if status != 0:
                started = re.findall(r"^\[ RUN      \] (\S+)", output, re.MULTILINE)
                failed = re.findall(r"^\[  FAILED  \] (\S+?),? ", output, re.MULTILINE)
                if failed:
                    return failed[0]
                return f"{started[-1] if started else program} ({how_it_ended(status)})"
        return ""

    def run(self, command, limit_s=None, prepare=None):
        """Status (None where it took too long) and output of a command and all that it starts."""
        # A fixed seed: a mutant that is killed today is killed tomorrow.
        environment = {**os.environ, "RC_PARAMS": "seed=1", "CTEST_OUTPUT_ON_FAILURE": "1", "LC_ALL": "C"}
        with open(self.log, "wb") as log:
            process = subprocess.Popen(
                [str(word) for word in command], stdin=subprocess.DEVNULL, stdout=log,
                stderr=subprocess.STDOUT, env=environment, start_new_session=True, preexec_fn=prepare,
            )
            try:
                status = process.wait(limit_s)
            except subprocess.TimeoutExpired:
                status = None
            finally:
                with contextlib.suppress(ProcessLookupError):
                    os.killpg(process.pid, signal.SIGKILL)
                process.wait()
        return status, self.tail(1 << 20)

    def tail(self, bytes_at_most=4000):
        with open(self.log, "rb") as log:
            log.seek(max(0, self.log.stat().st_size - bytes_at_most))
            return log.read().decode(errors="replace")


def hold_back():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
    resource.setrlimit(resource.RLIMIT_FSIZE, (FILE_BYTES, FILE_BYTES))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def how_it_ended(status):
    if status is None:
        return "hangs"
    if status < 0:
        return signal.Signals(-status).name
    return f"status {status}"
