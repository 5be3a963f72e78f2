"""Solves a CBF or MPS file with SCIP; writes the answer as JSON.

    solve_with_scip.py FILE SECONDS GAP THREADS

Affine entries of cones that are more than one variable get a variable of their own; a cone is then
one quadratic constraint, with its head at least 0, as SCIP recognizes it. SCIP runs on one thread.
"""

import json
import sys
import time

from conic_file import CONES, parts, read_conic
from pyscipopt import Model, quicksum

ENDS = {"optimal": "optimal", "gaplimit": "optimal", "infeasible": "infeasible",
        "unbounded": "unbounded"}


SIDES = {"F": (None, None), "L+": (0, None), "L-": (None, 0), "L=": (0, 0)}
HEADS = {"Q": 1, "QR": 2}


def _add_cone(model, kind, s):
    tail = quicksum(v * v for v in s[HEADS[kind]:])
    model.addCons(tail <= (s[0] * s[0] if kind == "Q" else 2 * (s[0] * s[1])))


def _variables(model, problem):
    x = []
    integers = set(problem.integers)
    for kind, first, last in parts(problem.var_cones):
        for j in range(first, last):
            lower, upper = SIDES.get(kind, SIDES["F"])
            if kind in CONES and j < first + HEADS[kind]:
                lower = 0
            x.append(model.addVar(f"x({j})", "I" if j in integers else "C", lower, upper))
        if kind in CONES:
            _add_cone(model, kind, x[first:last])
    return x


def _entry(model, x, row, constant, is_head):
    """Of a cone: the one variable that it is, or a new one."""
    if constant == 0 and len(row) == 1:
        (j, value), = row.items()
        if value == 1:
            if is_head:
                model.addCons(x[j] >= 0)
            return x[j]
    s = model.addVar("", "C", 0 if is_head else None, None)
    model.addCons(quicksum(value * x[j] for j, value in row.items()) + constant == s)
    return s


def model_of(problem):
    model = Model()
    x = _variables(model, problem)
    for kind, first, last in parts(problem.row_cones):
        some = range(first, last)
        if kind in CONES:
            _add_cone(model, kind, [_entry(model, x, problem.rows[i], problem.constants[i],
                                           i < first + HEADS[kind]) for i in some])
            continue
        for i in some:
            if kind == "F":
                continue
            value = quicksum(a * x[j] for j, a in problem.rows[i].items())
            side = -problem.constants[i]
            model.addCons({"L+": value >= side, "L-": value <= side, "L=": value == side}[kind])
    cost = quicksum(a * x[j] for j, a in problem.cost.items()) + problem.offset
    model.setObjective(cost, "maximize" if problem.maximize else "minimize")
    return model, x


def main():
    file, seconds, gap = sys.argv[1], float(sys.argv[2]), float(sys.argv[3])
    if file.endswith(".cbf"):
        model, x = model_of(read_conic(file))
    else:
        model = Model()
        model.hideOutput()
        model.readProblem(file)
        x = model.getVars()
    model.hideOutput()
    model.setParams({"limits/gap": gap, "limits/time": seconds, "lp/threads": 1,
                     "parallel/maxnthreads": 1})
    start = time.perf_counter()
    model.optimize()
    answer = {"seconds": time.perf_counter() - start, "status": model.getStatus(),
              "end": ENDS.get(model.getStatus(), "limit"), "nodes": model.getNTotalNodes(),
              "version": f"SCIP {model.version()}.{model.getTechVersion()}"}
    if not model.isInfinity(abs(model.getDualbound())):
        answer["bound"] = model.getDualbound()
    if model.getNSols() > 0:
        best = model.getBestSol()
        answer["objective"] = model.getSolObjVal(best)
        answer["x"] = {v.name: model.getSolVal(best, v) for v in x}
    print(json.dumps(answer))


if __name__ == "__main__":
    main()
