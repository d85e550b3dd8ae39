#!/usr/bin/env python3
"""Every relative link and picture of the project's pages leads to a file and heading that exist."""

import pathlib
import re
import sys

FENCE = re.compile(r"^(```|~~~).*?^\1", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)\s]+)\)|\bsrc=\"([^\"]+)\"")
HEADING = re.compile(r"^#+ +(.*?) *#*$", re.MULTILINE)


def anchors(page):
    """The anchors that a page's headings get: lower case, words joined by hyphens."""
    text = FENCE.sub("", page.read_text())
    for heading in HEADING.findall(text):
        yield re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def broken_links(page):
    text = FENCE.sub("", page.read_text())
    for target in (a or b for a, b in LINK.findall(text)):
        if re.match(r"[a-z]+:", target):
            continue  # the tests need no network
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        if not file.exists():
            yield target
        elif anchor and file.suffix == ".md" and anchor not in anchors(file):
            yield target


def main():
    pages = [
        page
        for page in pathlib.Path().rglob("*.md")
        if not {"build", "results", ".git"} & set(page.parts)
    ]
    broken = [f"{page}: {target}" for page in pages for target in broken_links(page)]
    print(f"{len(pages)} pages, {len(broken)} broken links", *broken, sep="\n")
    sys.exit(1 if broken or not pages else 0)


if __name__ == "__main__":
    main()
