#!/usr/bin/env python3
"""Instances against backends: what each answers, against the known optimum.

    reference_table.py PROGRAM INSTANCES CLASS[,CLASS] BACKEND[,BACKEND]
                       [--time-limit S] [--gap G] [--only TEXT[,TEXT]] [--csv OUT]

INSTANCES is a folder with reference.csv (class, instance, optimum) and a folder for each class.
A line says what the backend answered, how far its objective is from the reference, and whether the
bound that was proven supports it. Answers that the check did not support are listed by name at the
end, and so are those that it supports and the reference contradicts: the exit code counts these.
"""

import argparse
import csv
import json
import subprocess
import sys
from pathlib import Path

AGREEMENT = 1e-6
ANSWERED = ("optimal", "infeasible", "unbounded")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("instances", type=Path)
    parser.add_argument("classes")
    parser.add_argument("backends")
    parser.add_argument("--time-limit", default="60")
    parser.add_argument("--gap", default="1e-4")
    parser.add_argument("--only", default="")
    parser.add_argument("--csv", type=Path)
    return parser.parse_args()


def solve(options, path, backend):
    """The result/1 of one solve."""
    done = subprocess.run(
        [options.program, "solve", path, "--solver", backend, "--quiet", "--json", "-", "--gap",
         options.gap, "--time-limit", options.time_limit], capture_output=True, text=True)
    try:
        return json.loads(done.stdout)
    except json.JSONDecodeError:
        return {"termination": "backend_failed", "message": done.stderr.strip()}


def error_against(reference, result):
    """|objective - reference| relative, None where one of the two is not a number."""
    try:
        optimum = float(reference)
        return abs(float(result["objective"]) - optimum) / max(1.0, abs(optimum))
    except (KeyError, TypeError, ValueError):
        return None


def verdict(reference, result, tolerance):
    """"agrees", "contradicts", "unsupported" or "no reference"."""
    if result["termination"] not in ANSWERED:
        return "unsupported"
    if reference in ("", "NA"):
        return "no reference"
    if reference in ("infeasible", "unbounded"):
        return "agrees" if result["termination"] == reference else "contradicts"
    error = error_against(reference, result)
    return "agrees" if error is not None and error <= tolerance else "contradicts"


def rows(options):
    wanted = options.classes.split(",")
    only = [text for text in options.only.split(",") if text]
    with open(options.instances / "reference.csv", newline="") as file:
        for row in csv.DictReader(file):
            path = options.instances / row["class"] / (row["instance"] + ".gz")
            if row["class"] in wanted and path.exists() and (
                    not only or any(text in row["instance"] for text in only)):
                yield row["class"], row["instance"], row["optimum"], path


def show(value, form):
    return format(value, form) if isinstance(value, (int, float)) else "-"


def main():
    options = arguments()
    lists = {"unsupported": [], "contradicts": []}
    table = []
    for kind, name, reference, path in rows(options):
        for backend in options.backends.split(","):
            result = solve(options, path, backend)
            tolerance = max(AGREEMENT, float(options.gap)) if "mi" in kind else AGREEMENT
            said = verdict(reference, result, tolerance)
            seconds = result.get("seconds", {})
            line = [name, backend, result["termination"], result.get("dual", "-"),
                    show(result.get("objective"), ".10g"), reference or "-",
                    show(error_against(reference, result), ".1e"),
                    show(result.get("gap"), ".1e"), show(seconds.get("total"), ".2f"), said]
            table.append(line)
            print("{:<30} {:<9} {:<18} {:<16} {:>18} {:>20} {:>8} {:>8} {:>7}  {}".format(*line),
                  flush=True)
            if said in lists:
                words = "; ".join(result.get("notes", [])[-1:]) or result.get("message", "")
                lists[said].append(f"{name} by {backend}: {result['termination']}: {words}")
    if options.csv:
        with open(options.csv, "w", newline="") as out:
            csv.writer(out).writerows(table)
    print("\nnot supported by the check, or not answered:")
    print("\n".join("  " + line for line in lists["unsupported"]) or "  none")
    print("answered and supported, but not the reference:")
    print("\n".join("  " + line for line in lists["contradicts"]) or "  none")
    return min(len(lists["contradicts"]), 100)


if __name__ == "__main__":
    sys.exit(main())
