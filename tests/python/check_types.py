#!/usr/bin/env python3
"""mypy --strict has nothing to say of the package, nor stubtest of its extension's stub, and mypy sees a
mistake that a user makes: check_types.py FOLDER WORK"""

import os
import pathlib
import shutil
import subprocess
import sys

USER = """\
import gene_clocks
clock = gene_clocks.GeneClock(7)
mark = clock.mint()
reveal_type(mark)
clock.observe("5")
"""


def run(*command, folder):
    environment = os.environ | {"MYPYPATH": str(folder), "PYTHONPATH": str(folder)}
    done = subprocess.run([sys.executable, "-B", "-m", *command], text=True, env=environment, cwd=folder,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    return done.returncode, done.stdout


def main():
    source, work = map(pathlib.Path, sys.argv[1:])
    if subprocess.run([sys.executable, "-c", "import mypy"], capture_output=True, check=False).returncode:
        print(f"Skipped: {sys.executable} has no mypy")
        return
    shutil.rmtree(work, ignore_errors=True)
    shutil.copytree(source / "gene_clocks", work / "gene_clocks")
    cache = ("--cache-dir", str(work / "cache"))
    status, text = run("mypy", "--strict", *cache, "gene_clocks", folder=work)
    print(text)
    stub_status, stub_text = run("mypy.stubtest", "gene_clocks._core", folder=work)
    print(stub_text)
    (work / "user.py").write_text(USER)
    _, seen = run("mypy", "--strict", *cache, "user.py", folder=work)
    print(seen)
    sees = ("fallback=gene_clocks._marks.InnovationNumber], None]" in seen
            and 'Argument 1 to "observe" of "GeneClock" has incompatible type "str"' in seen)
    sys.exit(1 if status or stub_status or not sees else 0)


if __name__ == "__main__":
    main()
