"""What was measured: a line an answer, and for each family how many were solved, and how fast."""

import math

SHIFT = 10.0  # seconds, of the geometric means
FAMILIES = {  # by the beginning of the name, or its end after a *
    "classical": ("classical",), "robust": ("robust",), "shortfall": ("shortfall",),
    "estein": ("estein",), "sssd": ("sssd",), "clay": ("clay",), "uflquad": ("uflquad",),
    "ck": ("ck_",), "pp": ("pp-",), "stolpe": ("achtziger_stolpe", "stolpe07", "b1bigflowc"),
    "tls": ("tls",), "x_0_5_w": ("*_0_5_w",)}
LINE = "{:<28} {:<16} {:<19} {:>16} {:>16} {:>9} {:>9} {:>8}  {}"
HEAD = LINE.format("instance", "solver", "status", "objective", "bound", "gap", "nodes", "s", "")


def family_of(kind, name):
    for family, marks in FAMILIES.items():
        if any(name.endswith(mark[1:]) if mark[0] == "*" else name.startswith(mark)
               for mark in marks):
            return family
    return kind


def _shown(number, form):
    return "-" if number is None else format(number, form)


def line(instance, answer):
    words = [*("WRONG: " + wrong for wrong in answer["wrong"]), *answer["notes"]]
    return LINE.format(
        instance, answer["name"], answer["end"] if answer["end"] == "failed" else
        answer["status"][:19], _shown(answer.get("objective"), ".9g"),
        _shown(answer.get("bound"), ".9g"), _shown(answer["gap"], ".1e"),
        _shown(answer.get("nodes"), ".0f"), _shown(answer.get("seconds"), ".2f"),
        "; ".join(words)).rstrip()


def shifted_mean(seconds):
    return math.exp(sum(math.log(s + SHIFT) for s in seconds) / len(seconds)) - SHIFT


def counted(answer, limit):
    """Its seconds, the limit where it did not solve."""
    return min(answer["seconds"], limit) if answer["solved"] else limit


def family_lines(rows, limit):
    """`rows`: (family, answers) of each instance."""
    names = list(dict.fromkeys(one["name"] for _, answers in rows for one in answers))
    form = "{:<11} {:>9}" + " {:>24}" * len(names)
    yield form.format("family", "instances", *names)
    families = [*FAMILIES, *sorted({family for family, _ in rows} - set(FAMILIES))]
    for family in [*families, "all"]:
        some = [answers for name, answers in rows if family in (name, "all")]
        if not some:
            continue
        cells = []
        for name in names:
            mine = [one for answers in some for one in answers if one["name"] == name]
            wrong = sum(bool(one["wrong"]) for one in mine)
            cell = "{} solved{}, {:.2f} s".format(
                sum(one["solved"] for one in mine), f", {wrong} wrong" if wrong else "",
                shifted_mean([counted(one, limit) for one in mine])) if mine else "-"
            cells.append(cell if len(mine) in (0, len(some)) else f"of {len(mine)}: {cell}")
        yield form.format(family, len(some), *cells)
