"""The extension module and the source distribution; all else is in pyproject.toml.

Frames under a key are in it where pkg-config finds libsodium. In a checkout, headers and sources of the
protocol are beside this folder; a source distribution has a copy of them. Nothing is written into either:
what a build leaves behind goes to a temporary folder.
"""

import atexit
import pathlib
import shutil
import subprocess
import tempfile

from pybind11.setup_helpers import Pybind11Extension
from setuptools import setup
from setuptools.command.sdist import sdist
from setuptools.config.pyprojecttoml import read_configuration

HERE = pathlib.Path(__file__).resolve().parent
IS_DISTRIBUTION = (HERE / "protocol").is_dir()
PROTOCOL = HERE / "protocol" if IS_DISTRIBUTION else HERE.parent / "protocol"
VERSION = read_configuration(HERE / "pyproject.toml", expand=False)["project"]["version"]
if not (PROTOCOL / "include/gene_clocks").is_dir():
    raise SystemExit(f"{PROTOCOL} has no headers: build in a checkout, or from a source distribution")

WORK = tempfile.mkdtemp(prefix="gene-clocks-build-")
atexit.register(shutil.rmtree, WORK, ignore_errors=True)


def has_sodium():
    try:
        return subprocess.run(["pkg-config", "--exists", "libsodium"], check=False).returncode == 0
    except FileNotFoundError:
        return False


class Sdist(sdist):
    """With what lies outside of this folder."""

    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        for part in ("include", "storage/include", "storage/src", "authentication/include",
                     "authentication/src"):
            shutil.copytree(PROTOCOL / part, pathlib.Path(base_dir) / "protocol" / part,
                            dirs_exist_ok=True)


sources = sorted(str(path.relative_to(HERE)) for path in (HERE / "native").glob("*.cpp"))
includes = [PROTOCOL.parent, PROTOCOL / "include", PROTOCOL / "storage/include"]
macros, libraries = [("GENE_CLOCKS_VERSION", f'"{VERSION}"')], []
if has_sodium():
    includes.append(PROTOCOL / "authentication/include")
    libraries.append("sodium")
    macros.append(("GENE_CLOCKS_AUTHENTICATION", None))
else:
    sources.remove("native/authentication.cpp")

setup(
    cmdclass={"sdist": Sdist},
    ext_modules=[
        Pybind11Extension(
            "gene_clocks._core",
            sources,
            include_dirs=[str(folder) for folder in includes],
            libraries=libraries,
            define_macros=macros,
            # A fused multiply-add rounds once where two operations round twice.
            extra_compile_args=["-ffp-contract=off"],
            cxx_std=20,
        )
    ],
    options={"build": {"build_base": f"{WORK}/build"}, "egg_info": {"egg_base": WORK}},
)
