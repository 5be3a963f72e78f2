"""Solves an MPS file with HiGHS; writes the answer as JSON.

    solve_with_highs.py FILE SECONDS GAP THREADS
"""

import json
import math
import sys
import time

import highspy

ENDS = {highspy.HighsModelStatus.kOptimal: "optimal",
        highspy.HighsModelStatus.kInfeasible: "infeasible",
        highspy.HighsModelStatus.kUnbounded: "unbounded"}


def main():
    file, seconds, gap, threads = sys.argv[1], *map(float, sys.argv[2:4]), int(sys.argv[4])
    model = highspy.Highs()
    model.setOptionValue("output_flag", False)
    for name, value in (("time_limit", seconds), ("mip_rel_gap", gap), ("threads", threads)):
        model.setOptionValue(name, value)
    if model.readModel(file) == highspy.HighsStatus.kError:
        raise SystemExit(f"HiGHS does not read {file}")
    start = time.perf_counter()
    model.run()
    taken, info, status = time.perf_counter() - start, model.getInfo(), model.getModelStatus()
    answer = {"seconds": taken, "status": model.modelStatusToString(status),
              "end": ENDS.get(status, "limit"), "nodes": info.mip_node_count,
              "version": f"HiGHS {model.version()}"}
    if math.isfinite(info.mip_dual_bound):
        answer["bound"] = info.mip_dual_bound
    if info.primal_solution_status == highspy.SolutionStatus.kSolutionStatusFeasible:
        answer["objective"] = info.objective_function_value
        answer["x"] = dict(zip(model.getLp().col_names_, model.getSolution().col_value))
    print(json.dumps(answer))


if __name__ == "__main__":
    main()
