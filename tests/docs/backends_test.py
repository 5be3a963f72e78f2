#!/usr/bin/env python3
"""Compares the table of backends in README.md with what the built plugins declare.

    backends_test.py SOURCE PROGRAM
"""

import json
import subprocess
import sys
from pathlib import Path

SHOWN = ("seconds", "iterations", "nodes", "cutoff", "target", "cancel")


def said(program, *arguments):
    return subprocess.run([program, "plugins", *arguments], text=True, capture_output=True,
                          check=True).stdout


def declared(program, solver):
    """The row of the table for a backend, from what it says of itself."""
    lines = dict(line.split(None, 1) for line in said(program, "describe", solver["id"])
                 .split("options\n")[0].splitlines() if " " in line.strip())
    gives = lines["gives"].split(", ")
    limits = [limit for limit in lines["keeps"].split(", ") if limit in SHOWN]
    return [solver["name"], solver["id"], solver["classes"], ", ".join(limits),
            "yes" if "duals" in gives else "no", "yes" if "certificates" in gives else "no",
            solver["license"]]


def main():
    text = (Path(sys.argv[1]) / "README.md").read_text()
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines()
            if line.startswith("| ")]
    table = {row[0]: row for row in rows if len(row) == 7}
    wrong = 0
    for solver in json.loads(said(sys.argv[2], "list", "--json"))["solvers"]:
        row = declared(sys.argv[2], solver)
        if table.get(row[0]) != row:
            wrong += 1
            print(f"README.md: the row of {row[0]} should be\n| {' | '.join(row)} |")
    print(f"{wrong} rows are wrong" if wrong else "the table is what the backends say")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
