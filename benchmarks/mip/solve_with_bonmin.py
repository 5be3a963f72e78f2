"""Solves a CBF file with Bonmin, as CasADi brings it; writes the answer as JSON.

    solve_with_bonmin.py FILE SECONDS GAP THREADS

Bonmin takes smooth functions: a cone is |(tail, e)| - e <= head with e = 1e-6, a rotated one turned
into one. So its apex stays in it, and what is let in is at most e outside. Bonmin runs as branch
and bound on nonlinear relaxations, on one thread: its outer approximations call feasible problems
of this form infeasible. It tells bound and nodes in its log alone, which is read for them.
"""

import contextlib
import json
import math
import os
import re
import sys
import tempfile
import time

import casadi
from conic_file import CONES, parts, read_conic

SMOOTHING = 1e-6
NO_POINT = 1e49  # an objective as large as this is of none
ENDS = {"SUCCESS": "optimal", "INFEASIBLE": "infeasible", "CONTINUOUS_UNBOUNDED": "unbounded"}
SIDES = {"F": (-math.inf, math.inf), "L+": (0, math.inf), "L-": (-math.inf, 0), "L=": (0, 0)}


def _outside(kind, s):
    """|(tail, smoothing)| - smoothing - head."""
    if kind == "QR":
        turned = casadi.vertcat(s[0] + s[1], s[0] - s[1]) / math.sqrt(2)
        s = casadi.vertcat(turned, s[2:])
    return casadi.sqrt(casadi.sumsqr(s[1:]) + SMOOTHING ** 2) - SMOOTHING - s[0]


def program_of(problem):
    """What nlpsol takes: the program, its bounds and the bounds of its constraints."""
    x = casadi.SX.sym("x", problem.num_vars)
    values = casadi.vertcat(*[
        constant + sum((a * x[j] for j, a in row.items()), casadi.SX(0))
        for row, constant in zip(problem.rows, problem.constants)])
    lower, upper = [], []
    constraints, below, above = [], [], []
    for cones, s, is_row in ((problem.var_cones, x, False), (problem.row_cones, values, True)):
        for kind, first, last in parts(cones):
            if kind in CONES:
                constraints.append(_outside(kind, s[first:last]))
                below, above = [*below, -math.inf], [*above, 0]
            sides = [SIDES.get(kind, SIDES["F"])] * (last - first)
            if not is_row:
                lower += [side[0] for side in sides]
                upper += [side[1] for side in sides]
            elif kind not in CONES and kind != "F":
                constraints.append(s[first:last])
                below += [side[0] for side in sides]
                above += [side[1] for side in sides]
    cost = sum((a * x[j] for j, a in problem.cost.items()), casadi.SX(problem.offset))
    program = {"x": x, "f": -cost if problem.maximize else cost, "g": casadi.vertcat(*constraints)}
    return program, {"lbx": lower, "ubx": upper, "lbg": below, "ubg": above}


@contextlib.contextmanager
def logged():
    """Standard output of the whole process, C++ too, into a file that is lent."""
    sys.stdout.flush()
    kept = os.dup(1)
    with tempfile.TemporaryFile("w+") as log:
        os.dup2(log.fileno(), 1)
        try:
            yield log
        finally:
            sys.stdout.flush()
            os.dup2(kept, 1)
            os.close(kept)


def _last(pattern, text):
    found = re.findall(pattern, text)
    return float(found[-1]) if found else None


def main():
    file, seconds, gap = sys.argv[1], float(sys.argv[2]), float(sys.argv[3])
    problem = read_conic(file)
    program, bounds = program_of(problem)
    integer = set(problem.integers)
    options = {"discrete": [j in integer for j in range(problem.num_vars)], "print_time": False,
               "bonmin.time_limit": seconds, "bonmin.allowable_fraction_gap": gap,
               "bonmin.algorithm": "B-BB"}
    solver = casadi.nlpsol("bonmin", "bonmin", program, options)
    with logged() as log:
        start = time.perf_counter()
        found = solver(x0=0, **bounds)
        taken = time.perf_counter() - start
        log.seek(0)
        words = log.read()
    status = solver.stats()["return_status"]
    answer = {"seconds": taken, "status": status, "end": ENDS.get(status, "limit"),
              "nodes": _last(r"and (\d+) nodes", words), "version": f"CasADi {casadi.__version__}"}
    sign = -1 if problem.maximize else 1
    bound = _last(r"best possible ([-+.\deE]+)", words)
    objective = float(found["f"])
    if abs(objective) < NO_POINT and status in ("SUCCESS", "LIMIT_EXCEEDED"):
        answer["objective"] = sign * objective
        answer["x"] = {f"x({j})": v for j, v in enumerate(found["x"].full().ravel().tolist())}
    if bound is not None and answer["end"] != "optimal":
        answer["bound"] = sign * bound
    print(json.dumps(answer))


if __name__ == "__main__":
    main()
