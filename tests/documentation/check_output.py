#!/usr/bin/env python3
"""Every line that a program prints stands in a page: check_output.py PAGE PROGRAM"""

import pathlib
import subprocess
import sys


def main():
    page, program = sys.argv[1:]
    lines = pathlib.Path(page).read_text().splitlines()
    printed = subprocess.run([program], capture_output=True, text=True, check=True).stdout.splitlines()
    missing = [line for line in printed if line not in lines]
    print(f"{len(printed)} lines, {len(missing)} not in {page}", *missing, sep="\n")
    sys.exit(1 if missing or not printed else 0)


if __name__ == "__main__":
    main()
