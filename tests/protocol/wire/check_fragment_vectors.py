#!/usr/bin/env python3
"""The vectors of fragments are what make_fragment_vectors.py makes, and the exchanges that try every rule
of the document have the outcomes that stand here. Ends with status 1 where not."""

import json
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).parent
BY_HAND = [
    ["malformed", "completes", "too_long", "malformed", "malformed", "malformed", "malformed", "malformed",
     "kept", "kept", "repeated", "completes", "repeated", "repeated", "kept", "late", "late", "kept",
     "late", "kept"],
    ["kept", "too_long", "kept", "completes", "kept", "kept", "too_long", "kept", "kept", "kept"],
    ["kept", "kept", "completes", "kept", "completes", "completes", "kept", "repeated", "kept"],
]


def main():
    text = (HERE / "fragment_vectors.json").read_text()
    made = subprocess.run([sys.executable, HERE / "make_fragment_vectors.py"], capture_output=True,
                          text=True, check=True).stdout
    wrong = [] if made == text else ["fragment_vectors.json is not what make_fragment_vectors.py makes"]
    document = json.loads(text)
    for expected, exchange in zip(BY_HAND, document["exchanges"], strict=False):
        found = [step[1] for step in exchange["steps"]]
        if found != expected:
            wrong.append(f"expected {expected}, found {found}")
    steps = [step[1] for exchange in document["exchanges"] for step in exchange["steps"]]
    counts = {outcome: steps.count(outcome) for outcome in sorted(set(steps))}
    print(counts, *wrong, sep="\n")
    sys.exit(1 if wrong or min(counts.values()) < 5 or len(counts) != 6 else 0)


if __name__ == "__main__":
    main()
