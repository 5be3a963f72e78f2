"""Mixed-integer conic problems of the Conic Benchmark Format (CBF), and what their points cost.

Read are VER, OBJSENSE, VAR, INT, CON, OBJACOORD, OBJBCOORD, ACOORD and BCOORD with the cones F, L+,
L-, L=, Q and QR: what the second-order instances hold. Nothing here knows Switchyard: a point that
it answers is judged as any other.
"""

import gzip
import math
from dataclasses import dataclass, field
from pathlib import Path

LINEAR = ("F", "L+", "L-", "L=")
CONES = ("Q", "QR")


@dataclass
class ConicProblem:
    """min or max cost'x + offset such that x in var_cones, Ax + b in row_cones, x[integers] whole.

    Cones are (kind, dimension) and follow one another; `rows` are those of A, by column.
    """
    maximize: bool = False
    num_vars: int = 0
    var_cones: list = field(default_factory=list)
    integers: list = field(default_factory=list)
    cost: dict = field(default_factory=dict)
    offset: float = 0.0
    row_cones: list = field(default_factory=list)
    rows: list = field(default_factory=list)
    constants: list = field(default_factory=list)


def text_of(path):
    data = Path(path).read_bytes()
    return (gzip.decompress(data) if data[:2] == b"\x1f\x8b" else data).decode()


def _cones(next_line):
    """(rows in all, cones) of a VAR or CON section."""
    size, count = map(int, next_line().split())
    cones = []
    for _ in range(count):
        kind, dimension = next_line().split()
        if kind not in LINEAR + CONES:
            raise ValueError(f"cone: must be one of {', '.join(LINEAR + CONES)}, and is {kind}")
        cones.append((kind, int(dimension)))
    return size, cones


def read_conic(path):
    """Raises ValueError where the file has what is not read here."""
    lines = (line.strip() for line in text_of(path).splitlines())
    lines = iter([line for line in lines if line and not line.startswith("#")])
    problem = ConicProblem()

    def entries():
        return [next(lines).split() for _ in range(int(next(lines)))]

    for section in lines:
        if section == "VER":
            next(lines)
        elif section == "OBJSENSE":
            problem.maximize = next(lines) == "MAX"
        elif section == "VAR":
            problem.num_vars, problem.var_cones = _cones(lambda: next(lines))
        elif section == "CON":
            size, problem.row_cones = _cones(lambda: next(lines))
            problem.rows = [{} for _ in range(size)]
            problem.constants = [0.0] * size
        elif section == "INT":
            problem.integers = [int(j) for j, in entries()]
        elif section == "OBJACOORD":
            problem.cost = {int(j): float(value) for j, value in entries()}
        elif section == "OBJBCOORD":
            problem.offset = float(next(lines))
        elif section == "ACOORD":
            for i, j, value in entries():
                problem.rows[int(i)][int(j)] = float(value)
        elif section == "BCOORD":
            for i, value in entries():
                problem.constants[int(i)] = float(value)
        else:
            raise ValueError(f"section: must be one that is read here, and is {section}")
    return problem


def parts(cones):
    """(kind, first, behind the last) of each cone."""
    first = 0
    for kind, dimension in cones:
        yield kind, first, first + dimension
        first += dimension


def _outside(kind, s):
    """How far s is from a cone: of a second-order one, head less norm of the tail."""
    if kind == "QR":
        head, other = (s[0] + s[1]) / math.sqrt(2), (s[0] - s[1]) / math.sqrt(2)
        s = [head, other, *s[2:]]
    if kind in CONES:
        return math.hypot(*s[1:]) - s[0]
    return max(({"L+": -v, "L-": v, "L=": abs(v)}.get(kind, 0.0) for v in s), default=0.0)


def judge(problem, x):
    """(objective, violation) of x, from the file alone.

    The violation is the largest over cones and integrality, each relative to max(1, the largest
    term that meets in it).
    """
    objective = problem.offset + math.fsum(value * x[j] for j, value in problem.cost.items())
    worst = max((abs(x[j] - round(x[j])) for j in problem.integers), default=0.0)
    values, sizes = [], []
    for row, constant in zip(problem.rows, problem.constants):
        terms = [constant, *(value * x[j] for j, value in row.items())]
        values.append(math.fsum(terms))
        sizes.append(max(1.0, *map(abs, terms)))
    for cones, s, size in ((problem.var_cones, x, [max(1.0, abs(v)) for v in x]),
                           (problem.row_cones, values, sizes)):
        for kind, first, last in parts(cones):
            if kind in CONES:
                worst = max(worst, _outside(kind, s[first:last]) / max(size[first:last]))
            else:
                worst = max([worst, *(_outside(kind, [s[i]]) / size[i]
                                      for i in range(first, last))])
    return objective, worst
