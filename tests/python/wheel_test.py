#!/usr/bin/env python3
"""The source distribution and the wheel, as people would build and install them, without a network:
wheel_test.py SOURCE WORK TEST...

1. A source distribution and a wheel are built in the checkout, which is then as it was before.
2. The wheel is built again, from the source distribution alone.
3. Both are installed in a clean virtual environment each, and the tests run there.

Debian's Python, which has the packages that a wheel is built with; where these are missing, it says
"Skipped".
"""

import os
import pathlib
import shutil
import subprocess
import sys
import sysconfig
import zipfile

PYTHON = "/usr/bin/python3"
# Quick to compile; nothing here looks at speed.
ENVIRONMENT = os.environ | {"CFLAGS": "-O0", "PIP_NO_INDEX": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1"}


def run(*command, **options):
    done = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          env=ENVIRONMENT, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}")
    return done.stdout


def listing(folder):
    return sorted(str(path) for path in folder.rglob("*"))


def build_wheel(source, target):
    run(PYTHON, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "-w", target, source)
    (wheel,) = target.glob("gene_clocks-*.whl")
    return wheel


def check_contents(wheel, version):
    tag = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    expected = f"gene_clocks-{version}-{tag}-{tag}-{platform}.whl"
    if wheel.name != expected:
        sys.exit(f"the wheel is called {wheel.name}, not {expected}")
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        metadata = next(name for name in names if name.endswith("METADATA"))
        text = archive.read(metadata).decode()
    for name in ("gene_clocks/py.typed", "gene_clocks/_core.pyi", "gene_clocks/__init__.py",
                 "gene_clocks/adapters/neat_python.py", "gene_clocks/islands.py"):
        if name not in names:
            sys.exit(f"the wheel has no {name}")
    for line in (f"Version: {version}", "Name: gene-clocks", "License: Apache-2.0", "Requires-Python: >=3.9",
                 "Description-Content-Type: text/markdown"):
        if line not in text.splitlines():
            sys.exit(f"the wheel's metadata lack: {line}")


def try_in_venv(wheel, venv, tests):
    run(PYTHON, "-m", "venv", venv)
    python = venv / "bin/python"
    run(python, "-m", "pip", "install", "--no-deps", wheel)
    inside = run(python, "-c", "import gene_clocks, importlib.metadata as m\n"
                 "assert m.version('gene-clocks') == gene_clocks.__version__\n"
                 "print(gene_clocks.__file__, gene_clocks.__version__)", cwd=venv)
    if not inside.startswith(str(venv)):
        sys.exit(f"not what was installed: {inside}")
    for test in tests:
        run(python, "-B", test, cwd=venv)
    return inside.split()[1]


def main():
    missing = subprocess.run([PYTHON, "-c", "import setuptools, wheel, pip, venv, ensurepip\n"
                              "import pybind11.setup_helpers"], capture_output=True, check=False)
    if missing.returncode != 0:
        print("Skipped: there is no /usr/bin/python3 with pip, venv, setuptools, wheel and pybind11")
        return
    source, work, *tests = map(pathlib.Path, sys.argv[1:])
    os.environ.pop("PYTHONPATH", None)
    ENVIRONMENT.pop("PYTHONPATH", None)
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    before = listing(source / "python")
    run(PYTHON, "-B", "-c", "import sys; from setuptools import build_meta\n"
        f"build_meta.build_sdist({str(work / 'sdist')!r})", cwd=source / "python")
    from_checkout = build_wheel(source / "python", work / "from_checkout")
    after = listing(source / "python")
    if before != after:
        sys.exit(f"left in the checkout: {sorted(set(after) ^ set(before))}")
    (sdist,) = (work / "sdist").glob("gene[-_]clocks-*.tar.gz")
    from_sdist = build_wheel(sdist, work / "from_sdist")
    version = try_in_venv(from_sdist, work / "venv", tests)
    check_contents(from_sdist, version)
    check_contents(from_checkout, version)
    with zipfile.ZipFile(from_checkout) as one, zipfile.ZipFile(from_sdist) as other:
        if one.namelist() != other.namelist():
            sys.exit("the wheels of the checkout and of the source distribution have other files")
    print(f"{sdist.name}, {from_sdist.name}: built twice, installed, {len(tests)} tests")


if __name__ == "__main__":
    main()
