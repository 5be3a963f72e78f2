#!/usr/bin/env python3
"""Checks sizes and offsets of the ABI's records against the pinned ones in layout.txt.

    check_layout.py LAYOUT INCLUDE_FOLDER COMPILER [FLAG ...]
    check_layout.py --print INCLUDE_FOLDER COMPILER [FLAG ...]

The first compiles and runs a program that prints what the compiler makes of every field, and says
one sentence for each difference; exits 1 where there is one. The second prints the table as the
headers are now: what is appended to layout.txt when a record grows.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

HEADERS = ["abi.h", "hints.h", "dynamics.h"]
# Values: no `size`, and they never change. Everything else is a record.
VALUES = {"sy_error", "sy_csc", "sy_cone", "sy_hint", "sy_value"}


def declarations(body):
    """The declarations of a struct's body, split at the semicolons outside of braces."""
    depth, start = 0, 0
    for at, char in enumerate(body):
        depth += (char == "{") - (char == "}")
        if char == ";" and depth == 0:
            yield body[start:at]
            start = at + 1


def field_of(declaration):
    pointer = re.search(r"\(\s*\*\s*(\w+)\s*\)\s*\(", declaration)
    if pointer:
        return pointer[1]
    return re.search(r"(\w+)\s*(\[\w+\])?\s*$", declaration)[1]


def records_of(text):
    """{record: [field, ...]} of a C header."""
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.S)
    found = {}
    for head in re.finditer(r"\bstruct\s+(sy_\w+)\s*\{", text):
        depth, end = 1, head.end()
        while depth:
            depth += (text[end] == "{") - (text[end] == "}")
            end += 1
        found[head[1]] = [field_of(d) for d in declarations(text[head.end():end - 1])]
    return found


def program(records):
    lines = ["#include <stdio.h>", *(f'#include "switchyard/{h}"' for h in HEADERS),
             "int main(void) {"]
    for record, fields in records.items():
        lines.append(f'  printf("{record} %zu\\n", sizeof({record}));')
        for field in fields:
            lines.append(f'  printf("  {field} %zu %zu\\n", offsetof({record}, {field}), '
                         f"sizeof((({record}*)0)->{field}));")
    return "\n".join([*lines, "  return 0;", "}", ""])


def measure(records, include, command):
    """The table as text, as the compiler lays the records out."""
    with tempfile.TemporaryDirectory() as folder:
        source, binary = Path(folder) / "layout.c", Path(folder) / "layout"
        source.write_text(program(records))
        compiled = subprocess.run([*command, f"-I{include}", str(source), "-o", str(binary)],
                                  capture_output=True, text=True)
        if compiled.returncode != 0:
            sys.exit("the program that prints the layout does not compile:\n" + compiled.stderr)
        return subprocess.run([str(binary)], capture_output=True, text=True, check=True).stdout


def parse(text):
    """{record: (size, {field: (offset, size)})} of a table."""
    table = {}
    for line in text.splitlines():
        words = line.split("#")[0].split()
        if not words:
            continue
        if line[0] != " ":
            fields = {}
            table[words[0]] = (int(words[1]), fields)
        else:
            fields[words[0]] = (int(words[1]), int(words[2]))
    return table


def differences(pinned, now):
    for record, (size, fields) in pinned.items():
        if record not in now:
            yield f"record {record} is gone"
            continue
        for field, (offset, width) in fields.items():
            if field not in now[record][1]:
                yield f"field {field} of record {record} is gone"
                continue
            to, wide = now[record][1][field]
            if to != offset:
                yield f"field {field} of record {record} moved from {offset} to {to}"
            if wide != width:
                yield f"field {field} of record {record} grew from {width} to {wide} bytes"
        if now[record][0] != size:
            yield f"{record} grew from {size} to {now[record][0]} bytes"
    for record, (_, fields) in now.items():
        for field in fields.keys() - pinned.get(record, (0, {}))[1].keys():
            yield f"field {field} of record {record} is not pinned: append it to layout.txt"


def broken_rules(table):
    """What rule 1 of abi.h asks of every record."""
    for record, (size, fields) in table.items():
        if sum(width for _, width in fields.values()) != size:
            yield f"{record} has hidden padding"
        if record in VALUES:
            continue
        if size % 8 != 0:
            yield f"the size of record {record} is {size}, not a multiple of 8"
        if fields.get("size") != (0, 4):
            yield f"record {record} does not start with a size of 4 bytes"


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    pinned_path, include, command = sys.argv[1], Path(sys.argv[2]), sys.argv[3:]
    records = {}
    for header in HEADERS:
        records.update(records_of((include / "switchyard" / header).read_text()))
    text = measure(records, include, command)
    if pinned_path == "--print":
        print(text, end="")
        return
    now = parse(text)
    found = [*differences(parse(Path(pinned_path).read_text()), now), *broken_rules(now)]
    for sentence in found:
        print(sentence)
    print(f"layout: {len(now)} records, {sum(len(f) for _, f in now.values())} fields, "
          f"{len(found)} differences")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
