#!/usr/bin/env python3
"""What the protocol takes of a microcontroller: code and RAM on a Cortex-M4, by arm-none-eabi-gcc -Os.

Usage: firmware_size.py [--check]

--check ends with status 1 where the aim is missed or anything but the few functions that every
compiler needs (memcpy and the like) would have to be linked.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent
HEADERS = HERE / "../../protocol/include"
COMMON = ["-mcpu=cortex-m4", "-mthumb", "-Os", "-ffreestanding", "-Wall", "-Wextra", "-Wconversion",
          "-Werror", "-Wno-psabi", f"-I{HEADERS}"]
LANGUAGES = {
    "C99": ("arm-none-eabi-gcc", ["-std=c99", "-pedantic"], HERE / "parts.c"),
    "C++20": ("arm-none-eabi-g++",
              ["-std=c++20", "-fno-exceptions", "-fno-rtti", "-DGENE_CLOCKS_SMALL"],
              HERE / "parts.cpp"),
}
# What a freestanding compiler may ask for on its own (GCC's manual, "Standards"), and the stop that
# a broken precondition ends in.
ALLOWED = {"memcpy", "memmove", "memset", "memcmp", "abort", "__aeabi_memcpy", "__aeabi_memset"}
AIM_CODE_BYTES = 4096  # clock, alignment and decoder together
AIM_RAM_BYTES = 64  # one clock


def compiler():
    return shutil.which("arm-none-eabi-gcc")


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def measure(language, parts):
    """Bytes of code with constants, and of RAM; what would have to be linked; stack, at most."""
    program, options, source = LANGUAGES[language]
    with tempfile.TemporaryDirectory() as folder:
        object_file = f"{folder}/parts.o"
        defines = [f"-DPART_{part}" for part in parts]
        subprocess.run([program, *COMMON, *options, *defines, "-fstack-usage", "-c", source, "-o",
                        object_file], check=True)
        text, data, bss = map(int, output_of("arm-none-eabi-size", object_file).splitlines()[1]
                              .split()[:3])
        wanted = set(output_of("arm-none-eabi-nm", "-u", object_file).replace(" U ", "").split())
        # No function calls itself, so that no more than all frames together are on the stack.
        frames = pathlib.Path(f"{folder}/parts.su").read_text().splitlines()
    dynamic = [line for line in frames if not re.search(r"\tstatic$", line)]
    assert not dynamic, dynamic
    stack = sum(int(line.split("\t")[1]) for line in frames)
    return text, data + bss, wanted - ALLOWED, stack


def table():
    """Rows of (what, figure), and what misses the aim."""
    rows, missed = [], []
    for language in LANGUAGES:
        parts = [["CLOCK"], ["ALIGNMENT"], ["DECODER"], ["CLOCK", "ALIGNMENT", "DECODER"]]
        if language == "C99":
            parts.append(["ENCODER"])
        else:
            parts.append(["FLASH"])
        for part in parts:
            code, ram, linked, stack = measure(language, part)
            name = f"{language}: {', '.join(part).lower()}"
            rows.append((name, f"{code} bytes of code, {ram} of static RAM, {stack} of stack at most"))
            if linked or ram:
                missed.append(f"{name} needs {sorted(linked)} and {ram} bytes of static RAM")
            if len(part) == 3 and code > AIM_CODE_BYTES:
                missed.append(f"{name}: {code} bytes of code, aim {AIM_CODE_BYTES}")
        _, ram, _, _ = measure(language, ["RAM"])
        rows.append((f"{language}: RAM of one clock", f"{ram} bytes"))
        if not 0 < ram <= AIM_RAM_BYTES:
            missed.append(f"{language}: {ram} bytes of RAM for a clock, aim {AIM_RAM_BYTES}")
    return rows, missed


def main():
    if not compiler():
        sys.exit("firmware_size.py: there is no arm-none-eabi-gcc")
    rows, missed = table()
    for row in rows:
        print(": ".join(row))
    if sys.argv[1:] == ["--check"] and missed:
        sys.exit("\n".join(missed))


if __name__ == "__main__":
    main()
