#!/usr/bin/env python3
"""Writes the problems of this folder: transport.mps, depots.mps, ball.cbf and hs71.json.

The numbers are small integers made by formulas, so the files are the same on every machine.
"""

import json
from pathlib import Path

FOLDER = Path(__file__).resolve().parent

PLANTS = {"NORTH": (350, (2, 9)), "HARBOUR": (400, (0, 0)), "VALLEY": (300, (9, 3))}
MARKETS = {"ALDER": (180, (1, 4)), "BIRCH": (230, (4, 8)), "CEDAR": (150, (6, 1)),
           "ELM": (210, (8, 7)), "FIR": (120, (3, 2))}

DEPOTS = {"WEST": (90, 120, (0, 5)), "EAST": (80, 110, (10, 5)), "SOUTH": (100, 150, (5, 0)),
          "MIDDLE": (130, 160, (5, 5))}  # cost of opening, capacity, place
TOWNS = {"T1": (30, (1, 1)), "T2": (45, (2, 8)), "T3": (25, (4, 3)), "T4": (50, (6, 9)),
         "T5": (35, (7, 4)), "T6": (40, (9, 2)), "T7": (20, (9, 8))}

POINTS = [(0, 0, 0), (6, 1, 2), (1, 7, 3), (5, 5, 8), (2, 3, 9), (8, 4, 4), (3, 9, 6), (7, 7, 1),
          (4, 0, 7), (9, 6, 7)]


def streets(a, b):
    """The distance from a to b along a grid of streets."""
    return abs(a[0] - b[0]) + abs(a[1] - b[1])


def write_mps(name, title, rows, columns, bounds=()):
    """rows: {name: (type, right-hand side)}; columns: [(name, integer, {row: value})]."""
    lines = [f"* {line}" for line in title] + [f"NAME          {name.upper()}", "ROWS"]
    lines += [f" {kind}  {row}" for row, (kind, _) in rows.items()]
    lines.append("COLUMNS")
    marked = False
    for column, integer, entries in columns:
        if integer != marked:
            marked = integer
            lines.append(f"    MARKER    'MARKER'    '{'INTORG' if integer else 'INTEND'}'")
        lines += [f"    {column:14}  {row:10}  {value}" for row, value in entries.items()]
    if marked:
        lines.append("    MARKER    'MARKER'    'INTEND'")
    lines.append("RHS")
    lines += [f"    RHS  {row:10}  {rhs}" for row, (_, rhs) in rows.items() if rhs]
    if bounds:
        lines += ["BOUNDS"] + [f" {kind} BND  {column}  {value}" for kind, column, value in bounds]
    lines.append("ENDATA")
    (FOLDER / f"{name}.mps").write_text("\n".join(lines) + "\n")


def transport():
    rows = {"COST": ("N", 0)}
    rows |= {plant: ("L", capacity) for plant, (capacity, _) in PLANTS.items()}
    rows |= {market: ("G", demand) for market, (demand, _) in MARKETS.items()}
    columns = [(f"{plant}_{market}", False, {"COST": streets(here, there), plant: 1, market: 1})
               for plant, (_, here) in PLANTS.items() for market, (_, there) in MARKETS.items()]
    write_mps("transport", [
        "A linear program: ship goods from three plants to five markets at least cost.",
        "NORTH_ALDER is what goes from NORTH to ALDER; a unit costs the length of the way.",
        "A plant sends no more than it makes, a market gets no less than it needs.",
        "The least cost is 4110."], rows, columns)


def depots():
    rows = {"COST": ("N", 0)}
    rows |= {f"SERVE_{town}": ("E", 1) for town in TOWNS}
    rows |= {f"ROOM_{depot}": ("L", 0) for depot in DEPOTS}
    columns = [(f"OPEN_{depot}", True, {"COST": cost, f"ROOM_{depot}": -capacity})
               for depot, (cost, capacity, _) in DEPOTS.items()]
    columns += [(f"{depot}_{town}", True, {"COST": demand * streets(here, there) // 5,
                                           f"SERVE_{town}": 1, f"ROOM_{depot}": demand})
                for depot, (_, _, here) in DEPOTS.items()
                for town, (demand, there) in TOWNS.items()]
    write_mps("depots", [
        "A mixed-integer program: which depots to open, and which one serves each town.",
        "OPEN_WEST is 1 where the depot WEST is opened, WEST_T1 where it serves the town T1.",
        "Every town has one depot; a depot serves no more than it has room for.",
        "The least cost is 453."],
        rows, columns, [("UP", column, 1) for column, _, _ in columns])


def ball():
    """minimize r such that |p - c| <= r for each point p: a second-order cone each."""
    rows = 4 * len(POINTS)
    lines = ["# A second-order cone program: the smallest ball around ten points of space.",
             "# Variables: the radius r, then the centre c. Cone i: (r, c - p_i), so |c - p_i| <= r.",
             "# Three of the points hold it: the least radius is sqrt(26726 / 643).",
             "VER", "1", "", "OBJSENSE", "MIN", "", "VAR", "4 2", "L+ 1", "F 3", "",
             "CON", f"{rows} {len(POINTS)}"] + ["Q 4"] * len(POINTS)
    lines += ["", "OBJACOORD", "1", "0 1", "", "ACOORD", str(rows)]
    lines += [f"{4 * i + k} {k} 1" for i in range(len(POINTS)) for k in range(4)]
    constants = [(4 * i + k + 1, -value) for i, point in enumerate(POINTS)
                 for k, value in enumerate(point) if value]
    lines += ["", "BCOORD", str(len(constants))]
    lines += [f"{row} {value}" for row, value in constants]
    (FOLDER / "ball.cbf").write_text("\n".join(lines) + "\n")


def by_entries(value):
    """A value of the top level as JSON, each entry of a table or list on a line of its own."""
    if isinstance(value, dict):
        entries = [f"{json.dumps(name)}: {json.dumps(entry)}" for name, entry in value.items()]
        return "{\n    " + ",\n    ".join(entries) + "\n  }"
    if isinstance(value, list):
        return "[\n    " + ",\n    ".join(map(json.dumps, value)) + "\n  ]"
    return json.dumps(value)


def hs71():
    """A nonlinear program that is not convex: problem 71 of W. Hock and K. Schittkowski, Test Examples
    for Nonlinear Programming Codes (1981). The least cost is 17.0140173, at (1, 4.743, 3.8211, 1.3794).
    """
    square = {"rows": 4, "cols": 4, "entries": [[i, i, 2] for i in range(4)]}
    everything = list(range(4))
    program = {
        "format": "program/1",
        "name": "problem 71 of Hock and Schittkowski (1981)",
        "sense": "minimize",
        "variables": [{"name": f"x{i + 1}", "guess": guess}
                      for i, guess in enumerate((1, 5, 5, 1))],
        "functions": {"cost": {"type": "function", "arguments": 4,
                               "expressions": ["x[0]*x[3]*(x[0] + x[1] + x[2]) + x[2]"]}},
        "constraints": {
            "box": {"type": "bounding_box", "lb": [1] * 4, "ub": [5] * 4},
            "product": {"type": "function", "arguments": 4, "row_names": ["product"],
                        "expressions": ["x[0]*x[1]*x[2]*x[3]"], "lb": [25], "ub": ["inf"]},
            "sphere": {"type": "quadratic", "row_names": ["sphere"], "Q": square, "b": [0] * 4,
                       "lb": [40], "ub": [40]}},
        "costs": [{"function": "cost", "variables": everything}],
        "subject_to": [{"constraint": name, "variables": everything}
                       for name in ("box", "product", "sphere")]}
    lines = [f"  {json.dumps(name)}: {by_entries(value)}" for name, value in program.items()]
    (FOLDER / "hs71.json").write_text("{\n" + ",\n".join(lines) + "\n}\n")


if __name__ == "__main__":
    transport()
    depots()
    ball()
    hs71()
