"""The layers as docs/architecture.md draws them, and what a file may include.

The drawing is the first code block of the section "Layers". Each line holds one floor of the house:
one folder, or several side by side, separated by `|`; after two spaces or more comes what a newcomer
should know. A folder on a higher line may include what lies on lower lines, never the other way, and
never what is beside it.
"""

import pathlib
import re
import subprocess

DRAWN_LINE = re.compile(r"^ *((?:[\w./-]+/)(?: +\| +[\w./-]+/)*)(?:  .*)?$")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
SOURCES = {".c", ".cpp", ".h", ".hpp"}
LAYERED = ("protocol/", "neat/", "sim/")  # what products are made of; all else may only use them

# Where a public header's path begins, by its layer: as users write it.
PUBLIC = {
    "gene_clocks/sim/": "sim/core/",
    "gene_clocks/neat/": "neat/",
    "gene_clocks/storage/": "protocol/storage/",
    "gene_clocks/authentication/": "protocol/authentication/",
    "gene_clocks/": "protocol/",
}


def drawn_floors(page):
    """The lines of the drawing, top floor first, each a list of folders that end in a slash."""
    section = page.split("\n## Layers\n", 1)[1]
    drawing = section.split("```", 2)[1]
    matches = (DRAWN_LINE.match(line) for line in drawing.splitlines())
    return [[folder.strip() for folder in match[1].split("|")] for match in matches if match]


def heights(floors):
    """By folder, its height: the lowest line has 0."""
    return {folder: len(floors) - 1 - line for line, folders in enumerate(floors) for folder in folders}


def home_of(path, layers):
    """The folder of the drawing that a file belongs to: the longest that its path begins with."""
    fitting = [folder for folder in layers if path.startswith(folder)]
    return max(fitting, key=len, default=None)


def included_path(bracket, target):
    """The path below the repository's root that an include leads to, or None for other people's."""
    if bracket == "<":
        for prefix, folder in PUBLIC.items():
            if target.startswith(prefix):
                return folder + target
        return None
    return target


def faults(path, text, layers):
    """What is wrong with a layered file's includes, a sentence each."""
    home = home_of(path, layers)
    for bracket, target in INCLUDE.findall(text):
        if bracket == '"' and target.startswith("gene_clocks/"):
            yield f'{path}: "{target}" is a public header; write <{target}>'
            continue
        reached = included_path(bracket, target)
        if reached is None:
            continue
        if "/" not in reached or reached.startswith("."):
            yield f'{path}: "{target}" does not begin at the repository\'s root'
            continue
        there = home_of(reached, layers)
        if there is None:
            yield f"{path}: {target} is in no layer of the drawing"
        elif there != home and layers[there] >= layers[home]:
            relation = "above" if layers[there] > layers[home] else "beside"
            yield f"{path}: includes {target}, but {there} is {relation} {home}"


def tracked_files(root):
    """The repository's files; those that are not yet tracked, too."""
    listing = subprocess.run(
        ["git", "-C", str(root), "ls-files", "--cached", "--others", "--exclude-standard"],
        capture_output=True, text=True, check=False)
    if listing.returncode == 0:
        return sorted(path for path in listing.stdout.splitlines() if (root / path).is_file())
    top_level = ("protocol", "neat", "sim")  # a source archive has no git, and no build folder there
    return sorted(str(file.relative_to(root)) for folder in top_level
                  for file in (root / folder).rglob("*") if file.is_file())


def layered_sources(root):
    return [path for path in tracked_files(root)
            if path.startswith(LAYERED) and pathlib.PurePath(path).suffix in SOURCES]


def source_folders(root):
    """Every folder below the layered ones that holds code or data. A library's own `src/` and
    `include/gene_clocks/...` are how it is laid out: they count as the library's folder."""
    own = re.compile(r"/(src|include/gene_clocks(/(neat|sim|storage|authentication))?)/$")
    return {own.sub("/", f"{pathlib.PurePath(path).parent}/")
            for path in tracked_files(root) if path.startswith(LAYERED)}
