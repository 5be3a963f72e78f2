"""What was measured, as a table, a CSV and means over families of instances.

A row is one instance in one mode, "relaxation" or "rounding", flat: `instance`, `family`, `mode`,
`drake_s`, `preprocessed_s` (Drake with its preprocessing), `switchyard_s`, `whole_s` (Switchyard
with reading and loading of its plugins), `ratio` (the faster of Drake's two over Switchyard),
`plain_ratio` (Drake without preprocessing), `whole_ratio` (the faster over `whole_s`), costs,
violations and words on what is not as it should be. What is not known is None.
"""

import csv
import math

FIELDS = ("instance", "family", "mode", "turns", "drake_s", "preprocessed_s", "switchyard_s",
          "whole_s", "ratio", "plain_ratio", "whole_ratio", "drake_cost", "switchyard_cost",
          "bound", "drake_violation", "switchyard_violation", "above", "as_good", "drake_status",
          "preprocessed_status", "switchyard_status", "notes")
LINE = "{:<22} {:>10} {:>9} {:>7} {:>10} {:>9} {:>7} {:>12} {:>12} {:>12} {:>12} {:>9}  {}"
HEAD = LINE.format("", "relaxation", "", "", "rounding", "", "", "relaxation", "", "path", "", "",
                   "")
NAMES = LINE.format("instance", "Drake s", "ours s", "ratio", "Drake s", "ours s", "ratio", "Drake",
                    "ours", "Drake", "ours", "above", "")
FAMILY = "{:<12} {:>9} {:>6} {:>5} {:>10} {:>11} {:>9} {:>9} {:>9} {:>9}"


def shown(number, form):
    return "-" if number is None else format(number, form)


def drake_seconds(row):
    """The faster of Drake's two, with a p where that is with its preprocessing."""
    times = [(row[name], mark) for name, mark in (("drake_s", " "), ("preprocessed_s", "p"))
             if row[name] is not None]
    if not times:
        return "- "
    seconds, mark = min(times)
    return f"{seconds:.4f}{mark}"


def line(relaxation, rounding):
    """One instance, of its two rows."""
    notes = "; ".join(row["mode"] + ": " + row["notes"] for row in (relaxation, rounding)
                      if row["notes"])
    verdict = {True: "", False: "worse", None: ""}[rounding["as_good"]]
    cells = []
    for row in (relaxation, rounding):
        cells += [drake_seconds(row), shown(row["switchyard_s"], ".4f"), shown(row["ratio"], ".1f")]
    for row in (relaxation, rounding):
        cells += [shown(row["drake_cost"], ".6f"), shown(row["switchyard_cost"], ".6f")]
    words = "; ".join(word for word in (verdict, notes) if word)
    above = shown(rounding["above"], ".1e")
    return LINE.format(rounding["instance"], *cells, above, words).rstrip()


def geometric_mean(numbers):
    known = [number for number in numbers if number is not None]
    return math.exp(sum(map(math.log, known)) / len(known)) if known else None


def family_lines(rows):
    """Means over the instances of each family that both answered, and over all of them."""
    yield FAMILY.format("family", "instances", "Drake", "ours", "as good", "relaxation", "rounding",
                        "smallest", "plain", "whole")
    families = sorted({row["family"] for row in rows})
    for family in [*families, "all"]:
        some = [row for row in rows if family in (row["family"], "all")]
        relaxed = [row for row in some if row["mode"] == "relaxation"]
        rounded = [row for row in some if row["mode"] == "rounding"]
        judged = [row["as_good"] for row in rounded if row["as_good"] is not None]
        ratios = [row["ratio"] for row in rounded if row["ratio"] is not None]
        yield FAMILY.format(
            family, len(rounded), sum(row["drake_cost"] is not None for row in rounded),
            sum(row["switchyard_cost"] is not None for row in rounded),
            f"{sum(judged)} of {len(judged)}",
            shown(geometric_mean(row["ratio"] for row in relaxed), ".2f"),
            shown(geometric_mean(ratios), ".2f"), shown(min(ratios, default=None), ".2f"),
            shown(geometric_mean(row["plain_ratio"] for row in rounded), ".2f"),
            shown(geometric_mean(row["whole_ratio"] for row in rounded), ".2f"))


def write_csv(rows, path):
    with open(path, "w", newline="") as out:
        writer = csv.DictWriter(out, FIELDS, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
