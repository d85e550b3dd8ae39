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


def sealed_outcome(sealed, key, limits):
    try:
        number, frame = decoder.unseal(sealed, key, limits)
        return {"number": number, "frame": frame.hex()}
    except decoder.Refused as refused:
        return {"refusal": refused.error}


def damaged(frame):
    """The frame cut short at every byte, and with every single bit flipped."""
    for size in range(len(frame)):
        yield frame[:size]
    for bit in range(8 * len(frame)):
        flipped = bytearray(frame)
        flipped[bit // 8] ^= 1 << bit % 8
        yield bytes(flipped)


def main():
    text = (HERE / "vectors.json").read_text()
    made = subprocess.run([sys.executable, HERE / "make_vectors.py"], capture_output=True, text=True,
                          check=True).stdout
    wrong = [] if made == text else ["vectors.json is not what make_vectors.py makes"]
    document = json.loads(text)
    limits, key = document["limits"], bytes.fromhex(document["key"])
    vectors, sealed = document["vectors"], document["sealed"]
    found = [outcome(bytes.fromhex(vector["frame"]), limits) for vector in vectors]
    found += [sealed_outcome(bytes.fromhex(vector["sealed"]), key, limits) for vector in sealed]
    for vector, result in zip(vectors + sealed, found, strict=True):
        expected = {field: vector[field] for field in vector if field in result}
        if result != expected:
            wrong.append(f"{vector['name']}: expected {vector}, found {result}")
    for vector in (vector for vector in vectors if "value" in vector):
        if any("value" in outcome(frame, limits) for frame in damaged(bytes.fromhex(vector["frame"]))):
            wrong.append(f"{vector['name']}: a damaged frame is not refused")
    valid, opened = sum("value" in v for v in vectors), sum("number" in v for v in sealed)
    print(f"{valid} valid frames, {len(vectors) - valid} refused; "
          f"{opened} valid sealed frames, {len(sealed) - opened} refused", *wrong, sep="\n")
    sys.exit(1 if wrong or valid < 10 or len(vectors) < 40 or opened < 3 or len(sealed) < 10 else 0)


if __name__ == "__main__":
    main()
