#!/usr/bin/env python3
"""Shortest paths through graphs of convex sets, beside what is known of them.

    graph_table.py PROGRAM INSTANCES [BACKEND [NAME ...]]

INSTANCES is a folder with gcs_reference.csv and a folder gcs of gcs/1 files; BACKEND (clarabel)
serves underneath. Each instance is planned once with the defaults. A line ends with what is against
expectation: a bound or a relaxation above the best path known, a path below a proven bound, and,
where the best path is proven, a path more than half a percent above it.
"""

import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

SECONDS = 300
TOLERANCE = 1e-6  # relative to 1 + |cost|
LOOSE = 5e-3
COLUMNS = "{:<24} {:<16} {:>12} {:>12} {:>12} {:>12} {:>8} {:>8} {:>8}  {}"


def plan(program, path, backend):
    with tempfile.TemporaryDirectory() as folder:
        written = Path(folder) / "result.json"
        subprocess.run([program, "plan", path, "--solver", backend, "--quiet", "--time-limit",
                        str(SECONDS), "--json", written], capture_output=True, check=False)
        return json.loads(written.read_text()) if written.exists() else {}


def value(text):
    return float(text) if text else None


def against(result, best, proven):
    """What is not as it should be, a phrase each."""
    bound, cost = result.get("bound"), result.get("objective")
    relaxed = result.get("relaxation", {}).get("cost")
    if best is not None:
        allowed = TOLERANCE * (1 + abs(best))
        if bound is not None and bound > best + allowed:
            yield "bound above the best path"
        if relaxed is not None and relaxed > best + allowed:
            yield "relaxation above the best path"
        if cost is not None and proven and cost > best * (1 + LOOSE):
            yield "path more than 0.5 % above the best"
    if cost is not None and bound is not None and cost < bound - TOLERANCE * (1 + abs(cost)):
        yield "path below the bound"
    if cost is None:
        yield "no path"


def shown(number, form):
    return "-" if number is None else format(number, form)


def main():
    program, folder = sys.argv[1], Path(sys.argv[2])
    backend = sys.argv[3] if len(sys.argv) > 3 else "clarabel"
    names = sys.argv[4:]
    print(COLUMNS.format("instance", "answer", "relaxation", "bound", "cost", "best known", "above",
                         "gap", "seconds", ""))
    wrong = 0
    with open(folder / "gcs_reference.csv", newline="") as table:
        for row in csv.DictReader(table):
            name = row["instance"]
            if names and not any(name.startswith(one) for one in names):
                continue
            result = plan(program, folder / "gcs" / f"{name}.json.gz", backend)
            best = value(row["best_path_known"])
            cost = result.get("objective")
            above = None if best is None or cost is None else cost / best - 1
            faults = list(against(result, best, row["proven_1e-4"] == "yes"))
            wrong += len(faults)
            print(COLUMNS.format(
                name, result.get("termination", "nothing"),
                shown(result.get("relaxation", {}).get("cost"), ".6f"),
                shown(result.get("bound"), ".6f"), shown(cost, ".6f"), shown(best, ".6f"),
                shown(above, ".1e"), shown(result.get("gap"), ".1e"),
                shown(result.get("seconds", {}).get("total"), ".2f"), "; ".join(faults)),
                flush=True)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
