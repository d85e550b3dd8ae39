#!/usr/bin/env python3
"""The decoder of general genomes that was written from the document alone agrees with the test vectors,
these are what make_general_vectors.py makes, and the document's example is the vector of that name. Ends
with status 1 where not."""

import json
import pathlib
import re
import subprocess
import sys

import general_decoder
from decoder import Refused
from make_general_vectors import encode

HERE = pathlib.Path(__file__).parent
PAGE = HERE / "../../../docs/wire-format.md"


def outcome(payload, vector, document, schemas):
    try:
        return {"value": general_decoder.decode(
            payload, vector.get("stamp", document["stamp"]),
            bytes.fromhex(schemas[vector["schema"]]["bytes"]), document["genes_max"])}
    except Refused as refused:
        return {"error": refused.error, "offset": refused.offset}


def damage_faults(vector, document, schemas):
    payload = bytes.fromhex(vector["payload"])
    for size in range(len(payload)):
        if outcome(payload[:size], vector, document, schemas).get("error") != "truncated":
            yield f"cut to {size} bytes it is not truncated"
    for bit in range(8 * len(payload)):
        flipped = bytearray(payload)
        flipped[bit // 8] ^= 1 << bit % 8
        found = outcome(bytes(flipped), vector, document, schemas)
        if found == {"value": vector["value"]}:
            yield f"bit {bit} changes nothing"
        if "value" in found and encode(schemas[vector["schema"]]["value"], found["value"]) != flipped:
            yield f"bit {bit} gives a second encoding"


def example_bytes(title):
    """The bytes in the first column of the document's table."""
    table = PAGE.read_text().split(f"| bytes of the {title} | field |\n")[1].split("\n\n")[0]
    cells = [line.split("|")[1] for line in table.splitlines()[1:]]
    return "".join(re.sub(r"[` ]", "", cell) for cell in cells)


def main():
    text = (HERE / "general_vectors.json").read_text()
    made = subprocess.run([sys.executable, HERE / "make_general_vectors.py"], capture_output=True,
                          text=True, check=True).stdout
    wrong = [] if made == text else ["general_vectors.json is not what make_general_vectors.py makes"]
    document = json.loads(text)
    schemas = {schema["name"]: schema for schema in document["schemas"]}
    for schema in document["schemas"]:
        data = bytes.fromhex(schema["bytes"])
        if (general_decoder.SchemaReader(data).read() != schema["value"]
                or general_decoder.crc32c(data) != schema["fingerprint"]):
            wrong.append(f"schema {schema['name']}: other bytes or fingerprint")
    vectors = document["vectors"]
    for vector in vectors:
        found = outcome(bytes.fromhex(vector["payload"]), vector, document, schemas)
        if any(vector.get(field) != found[field] for field in found):
            wrong.append(f"{vector['name']}: expected {vector}, found {found}")
        if "value" in vector:
            wrong += [f"{vector['name']}: {fault}" for fault in damage_faults(vector, document, schemas)]
    if example_bytes("schema") != schemas["as in the document"]["bytes"]:
        wrong.append("the document's example of a schema has other bytes")
    if example_bytes("payload") != vectors[0]["payload"]:
        wrong.append("the document's example of a payload has other bytes")
    valid = sum("value" in vector for vector in vectors)
    errors = len({vector["error"] for vector in vectors if "error" in vector})
    print(f"{len(schemas)} schemas, {valid} valid payloads, {len(vectors) - valid} refused for {errors} "
          "reasons", *wrong, sep="\n")
    sys.exit(1 if wrong or valid < 20 or len(vectors) < 80 or errors < 13 else 0)


if __name__ == "__main__":
    main()
