"""The extension module; all else is in pyproject.toml. To be built in a checkout, whose protocol/
has the headers. Frames under a key are in it where pkg-config finds libsodium."""

import pathlib
import subprocess

from pybind11.setup_helpers import Pybind11Extension
from setuptools import setup
from setuptools.config.pyprojecttoml import read_configuration

here = pathlib.Path(__file__).resolve().parent
protocol = here.parent / "protocol"
version = read_configuration(here / "pyproject.toml", expand=False)["project"]["version"]


def has_sodium():
    try:
        return subprocess.run(["pkg-config", "--exists", "libsodium"], check=False).returncode == 0
    except FileNotFoundError:
        return False


sources, includes, libraries = ["gene_clocks.cpp"], [protocol / "include"], []
macros = [("GENE_CLOCKS_VERSION", f'"{version}"')]
if has_sodium():
    sources += ["authentication.cpp", "../protocol/authentication/src/sealed_frames.cpp"]
    includes.append(protocol / "authentication/include")
    libraries.append("sodium")
    macros.append(("GENE_CLOCKS_AUTHENTICATION", None))

setup(
    ext_modules=[
        Pybind11Extension(
            "gene_clocks",
            sources,
            include_dirs=[str(folder) for folder in includes],
            libraries=libraries,
            define_macros=macros,
            cxx_std=20,
        )
    ],
)
