#!/usr/bin/env python3
"""Runs every benchmark program of a build; see README.md beside this file.

Usage: run_all.py PROGRAMS RESULTS [ARGUMENTS ...]

PROGRAMS is the folder with the built programs (`*_bench`), RESULTS the folder that gets one JSON
file for each and `table.md`. ARGUMENTS go to every program.
"""

import datetime
import json
import os
import pathlib
import platform
import shutil
import subprocess
import sys

# Fields of Google Benchmark's JSON that are not a benchmark's own counters.
FIXED_FIELDS = {
    "name", "family_index", "per_family_instance_index", "run_name", "run_type", "repetitions",
    "repetition_index", "threads", "iterations", "real_time", "cpu_time", "time_unit",
    "aggregate_name", "aggregate_unit", "label", "error_occurred", "error_message",
}


def processor_name():
    try:
        for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()


def revision():
    if not shutil.which("git"):
        return "unknown"
    described = subprocess.run(
        ["git", "-C", os.path.dirname(__file__), "describe", "--always", "--dirty"],
        capture_output=True, text=True, check=False,
    )
    return described.stdout.strip() or "unknown"


def run(program, results, arguments):
    """Runs one program; returns what it measured, or None where it failed."""
    output = results / f"{program.name}.json"
    output.unlink(missing_ok=True)
    command = [str(program), f"--benchmark_out={output}", "--benchmark_out_format=json", *arguments]
    if subprocess.run(command, check=False).returncode != 0:
        return None
    if not output.exists() or output.stat().st_size == 0:
        return []  # no benchmark of this program matches the filter
    measured = json.loads(output.read_text())["benchmarks"]
    return None if any(entry.get("error_occurred") for entry in measured) else measured


def rows(program, measured):
    for entry in measured:
        if "cpu_time" not in entry:
            continue
        counters = ", ".join(
            f"{name} {value:.4g}"
            for name, value in entry.items()
            if name not in FIXED_FIELDS and isinstance(value, (int, float))
        )
        time = f"{entry['cpu_time']:.4g} {entry['time_unit']}"
        yield f"| {program.name} | {entry['name']} | {time} | {counters} |"


def firmware():
    """A table of what the protocol takes of a microcontroller, where its compiler is at hand."""
    script = pathlib.Path(__file__).parent / "firmware" / "firmware_size.py"
    if not shutil.which("arm-none-eabi-gcc"):
        return ["Firmware was not measured: there is no arm-none-eabi-gcc."]
    measured = subprocess.run([sys.executable, "-B", script], capture_output=True, text=True,
                              check=True).stdout
    return ["Cortex-M4, arm-none-eabi-gcc -Os:", "", *(f"- {line}" for line in measured.splitlines())]


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    programs = sorted(pathlib.Path(sys.argv[1]).glob("*_bench"))
    results = pathlib.Path(sys.argv[2])
    if not programs:
        sys.exit(f"run_all.py: no benchmark program in {sys.argv[1]}")
    results.mkdir(parents=True, exist_ok=True)

    load = os.getloadavg()[0]
    table, failed = [], []
    for program in programs:
        measured = run(program, results, sys.argv[3:])
        if measured is None:
            failed.append(program.name)
        else:
            table.extend(rows(program, measured))

    lines = [
        f"Revision {revision()}, {datetime.date.today()}, {processor_name()}, "
        f"{os.cpu_count()} processors, load {load:.1f} before the start.",
        "",
        "| program | benchmark | CPU time per iteration | counters |",
        "| --- | --- | --- | --- |",
        *table,
        "",
        *firmware(),
    ]
    text = "\n".join(lines) + "\n"
    (results / "table.md").write_text(text)
    print("\n" + text)
    if failed:
        sys.exit(f"run_all.py: failed: {', '.join(failed)}")


if __name__ == "__main__":
    main()
