#!/usr/bin/env python3
"""The C++ of a page is what a program has: each block stands in one of the sources, line for line.

Usage: check_snippets.py PAGE SOURCE...
"""

import pathlib
import re
import sys

BLOCK = re.compile(r"^```cpp\n(.*?)^```", re.MULTILINE | re.DOTALL)


def main():
    page, *sources = map(pathlib.Path, sys.argv[1:])
    blocks = BLOCK.findall(page.read_text())
    texts = ["\n" + source.read_text() for source in sources]
    missing = [block for block in blocks if not any("\n" + block in text for text in texts)]
    print(f"{len(blocks)} blocks, {len(missing)} of them in no source", *missing, sep="\n")
    sys.exit(1 if missing or not blocks else 0)


if __name__ == "__main__":
    main()
