"""The extension module; all else is in pyproject.toml. To be built in a checkout, whose protocol/
has the headers."""

import pathlib

from pybind11.setup_helpers import Pybind11Extension
from setuptools import setup
from setuptools.config.pyprojecttoml import read_configuration

here = pathlib.Path(__file__).resolve().parent
version = read_configuration(here / "pyproject.toml", expand=False)["project"]["version"]

setup(
    ext_modules=[
        Pybind11Extension(
            "gene_clocks",
            ["gene_clocks.cpp"],
            include_dirs=[str(here.parent / "protocol" / "include")],
            define_macros=[("GENE_CLOCKS_VERSION", f'"{version}"')],
            cxx_std=20,
        )
    ],
)
