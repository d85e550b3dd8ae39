#!/usr/bin/env python3
"""The decoder that was written from the document alone agrees with the test vectors, and these are what
make_vectors.py makes. Ends with status 1 where not."""

import json
import pathlib
import subprocess
import sys

import decoder

HERE = pathlib.Path(__file__).parent


def outcome(frame, limits):
    try:
        return {"value": decoder.decode(frame, limits)}
    except decoder.Refused as refused:
        return {"error": refused.error, "offset": refused.offset}


def main():
    text = (HERE / "vectors.json").read_text()
    made = subprocess.run([sys.executable, HERE / "make_vectors.py"], capture_output=True, text=True,
                          check=True).stdout
    wrong = [] if made == text else ["vectors.json is not what make_vectors.py makes"]
    document = json.loads(text)
    limits = decoder.Limits(**document["limits"])
    vectors = document["vectors"]
    for vector in vectors:
        expected = {key: vector[key] for key in ("value", "error", "offset") if key in vector}
        found = outcome(bytes.fromhex(vector["frame"]), limits)
        if found != expected:
            wrong.append(f"{vector['name']}: expected {expected}, found {found}")
    valid = sum("value" in vector for vector in vectors)
    print(f"{valid} valid frames, {len(vectors) - valid} refused", *wrong, sep="\n")
    sys.exit(1 if wrong or valid < 10 or len(vectors) < 40 else 0)


if __name__ == "__main__":
    main()
