#!/usr/bin/env python3
"""The recipes as far as they can be checked without their package managers: they parse, have the
project's version, and set no CMake option that the project does not have.

Usage: check_recipes.py SOURCE VERSION
"""

import ast
import json
import pathlib
import re
import sys


def main():
    source, version = pathlib.Path(sys.argv[1]), sys.argv[2]
    wrong = []

    def require(condition, message):
        if not condition:
            wrong.append(message)

    conan = (source / "packaging/conan/conanfile.py").read_text()
    recipe = next(node for node in ast.parse(conan).body if isinstance(node, ast.ClassDef))
    fields = {node.targets[0].id: ast.literal_eval(node.value) for node in recipe.body
              if isinstance(node, ast.Assign)}
    require(fields["name"] == "gene-clocks", "Conan's name")
    require(fields["version"] == version, f"Conan's version is {fields['version']}")
    for pattern in re.search(r"for pattern in \((.*?)\)", conan).group(1).split(","):
        path = ast.literal_eval(pattern.strip()).removesuffix("/*")
        require((source / path).exists(), f"Conan exports {path}, which is not there")

    port = source / "packaging/vcpkg/gene-clocks"
    manifest = json.loads((port / "vcpkg.json").read_text())
    require(manifest["name"] == port.name, "a port's folder and name differ")
    require(manifest["version"] == version, f"vcpkg's version is {manifest['version']}")

    known = set(re.findall(r"option\((GENE_CLOCKS_\w+)", (source / "CMakeLists.txt").read_text()))
    for text in (conan, (port / "portfile.cmake").read_text()):
        used = set(re.findall(r"GENE_CLOCKS_\w+", text))
        require(used and used <= known, f"no such options: {sorted(used - known)}")
        require("GENE_CLOCKS_BUILD_SIM" in used, "the simulator would be built")

    print(f"{len(known)} options, {len(wrong)} faults in the recipes", *wrong, sep="\n")
    sys.exit(1 if wrong or not known else 0)


if __name__ == "__main__":
    main()
