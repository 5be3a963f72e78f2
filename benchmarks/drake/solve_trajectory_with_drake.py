"""One scenario of trajectory_scenarios.py by Drake, in a process of its own.

    solve_trajectory_with_drake.py SCENARIO PATHS PREPROCESSING THREADS

PATHS is how many to round to, 0 for the relaxation alone; PREPROCESSING 0 or 1; THREADS at most so
many, 0 for Drake's own choice. Writes one line of JSON: `status`, `build` and `solve` (seconds),
`kilobytes` (the most that the process took beyond what it had before the build), and where there is
an answer `cost` and, after rounding, `segments` of `points` and `duration`.

Reading the file and a first trajectory through two rooms are not timed.
"""

import json
import logging
import resource
import sys
import time
from pathlib import Path

import numpy as np
from pydrake.common import Parallelism
from pydrake.geometry.optimization import (
    GraphOfConvexSetsOptions, HPolyhedron, Hyperrectangle, Point)
from pydrake.planning import GcsTrajectoryOptimization
from pydrake.solvers import ClarabelSolver, IpoptSolver

from trajectory_scenarios import two_rooms


def convex_set(one):
    if one["type"] == "box":
        return Hyperrectangle(np.array(one["lower"]), np.array(one["upper"]))
    if one["type"] == "polytope":
        return HPolyhedron(np.array(one["A"]), np.array(one["b"]))
    return Point(np.array(one["x"]))


def add(terms, to):
    """To the whole problem, a subgraph, or the edges between two."""
    for term in terms:
        kind = term["type"]
        if kind == "time_cost":
            to.AddTimeCost(term["weight"])
        elif kind == "length_cost":
            to.AddPathLengthCost(term["weight"])
        elif kind == "energy_cost":
            to.AddPathEnergyCost(term["weight"])
        elif kind == "velocity_bounds":
            to.AddVelocityBounds(np.array(term["lower"]), np.array(term["upper"]))
        elif kind == "derivative_bounds":
            to.AddNonlinearDerivativeBounds(np.array(term["lower"]), np.array(term["upper"]),
                                            term["order"])
        elif kind == "path_continuity":
            to.AddPathContinuityConstraints(term["order"])
        elif kind == "continuity":
            to.AddContinuityConstraints(term["order"])
        else:
            to.AddZeroDerivativeConstraints(term["order"])


def build(scenario):
    """The problem and its subgraphs."""
    problem = GcsTrajectoryOptimization(scenario["num_positions"], scenario["continuous_joints"])
    subgraphs = []
    for one in scenario["subgraphs"]:
        regions = [convex_set(region) for region in one["regions"]]
        shape = {name: one[name] for name in ("order", "h_min", "h_max", "name")}
        pairs = {} if one["pairs"] is None else {"edges_between_regions": one["pairs"]}
        subgraphs.append(problem.AddRegions(regions, **pairs, **shape))
        add(one["terms"], subgraphs[-1])
    for one in scenario["edges"]:
        subspace = one["subspace"] and convex_set(one["subspace"])
        add(one["terms"], problem.AddEdges(subgraphs[one["from"]], subgraphs[one["to"]], subspace,
                                           one["pairs"]))
    add(scenario["terms"], problem)
    return problem, subgraphs


def options(scenario, paths, preprocessing, threads):
    chosen = GraphOfConvexSetsOptions()
    chosen.convex_relaxation = True
    chosen.preprocessing = preprocessing
    chosen.max_rounded_paths = paths
    chosen.max_rounding_trials = 100
    chosen.flow_tolerance = 1e-5
    chosen.rounding_seed = 0
    chosen.solver = ClarabelSolver()
    chosen.preprocessing_solver = ClarabelSolver()
    chosen.restriction_solver = IpoptSolver() if scenario["nonlinear"] else ClarabelSolver()
    if threads > 0:
        chosen.parallelism = Parallelism(threads)
    return chosen


def kilobytes():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def solve(scenario, chosen):
    before, start = kilobytes(), time.perf_counter()
    problem, subgraphs = build(scenario)
    built = time.perf_counter()
    trajectory, result = problem.SolvePath(subgraphs[scenario["source"]],
                                           subgraphs[scenario["target"]], chosen)
    solved = time.perf_counter()
    answer = {"status": result.get_solution_result().name.removeprefix("k"), "build": built - start,
              "solve": solved - built, "kilobytes": kilobytes() - before}
    if result.is_success():
        answer["cost"] = result.get_optimal_cost()
        if chosen.max_rounded_paths > 0:
            segments = map(trajectory.segment, range(trajectory.get_number_of_segments()))
            answer["segments"] = [
                {"points": one.control_points().T.tolist(),
                 "duration": one.end_time() - one.start_time()} for one in segments]
    return answer


def main():
    path, paths, preprocessing, threads = sys.argv[1], *map(int, sys.argv[2:5])
    logging.getLogger("drake").setLevel(logging.WARNING)
    scenario = json.loads(Path(path).read_text())
    first = two_rooms()
    solve(first, options(first, 1, False, threads))
    print(json.dumps(solve(scenario, options(scenario, paths, bool(preprocessing), threads))))


if __name__ == "__main__":
    main()
