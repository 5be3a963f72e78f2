"""One shortest path by Drake and Clarabel, in a process of its own.

    solve_with_drake.py FILE PATHS PREPROCESSING THREADS

FILE is a gcs/1 graph; PATHS how many to round to, 0 for the relaxation alone; PREPROCESSING 0 or 1;
THREADS at most so many, 0 for Drake's own choice. Writes one line of JSON: `status`, `build` and
`solve` (seconds), and where there is an answer `objective` and, after rounding, `edges` (indices in
the file) and `points` along the path.

Reading the file and a first graph of two points, which loads what a solve needs, are not timed.
"""

import gzip
import json
import logging
import sys
import time
from pathlib import Path

from pydrake.common import Parallelism
from pydrake.geometry.optimization import GraphOfConvexSetsOptions
from pydrake.solvers import ClarabelSolver

from drake_graph import DrakeGraph

TWO_POINTS = {
    "source": 0, "target": 1, "constraints": {},
    "matrices": {"A": {"rows": 1, "cols": 2, "entries": [[0, 0, 1], [0, 1, -1]]}},
    "functions": {"f": {"type": "l2_norm", "A": "A", "b": [0]}},
    "sets": {"s": {"type": "point", "x": [0]}, "t": {"type": "point", "x": [1]}},
    "vertices": [{"name": "s", "set": "s", "costs": []}, {"name": "t", "set": "t", "costs": []}],
    "edges": [{"tail": 0, "head": 1, "costs": ["f"], "constraints": []}]}


def read(path):
    data = Path(path).read_bytes()
    return json.loads(gzip.decompress(data) if path.endswith(".gz") else data)


def options(paths, preprocessing, threads):
    chosen = GraphOfConvexSetsOptions()
    chosen.convex_relaxation = True
    chosen.preprocessing = preprocessing
    chosen.max_rounded_paths = paths
    chosen.max_rounding_trials = 100
    chosen.flow_tolerance = 1e-5
    chosen.rounding_seed = 0
    chosen.solver = ClarabelSolver()
    if threads > 0:
        chosen.parallelism = Parallelism(threads)
    return chosen


def path_of(drake, result):
    """The indices of the edges of the path that was rounded to, and the points along it."""
    index = {edge.id(): i for i, edge in enumerate(drake.edges)}
    edges = drake.graph.GetSolutionPath(drake.source, drake.target, result)
    vertices = [drake.source, *(edge.v() for edge in edges)]
    return {"edges": [index[edge.id()] for edge in edges],
            "points": [list(vertex.GetSolution(result)) for vertex in vertices]}


def solve(file, chosen):
    start = time.perf_counter()
    drake = DrakeGraph(file)
    built = time.perf_counter()
    result = drake.graph.SolveShortestPath(drake.source, drake.target, chosen)
    solved = time.perf_counter()
    answer = {"status": result.get_solution_result().name.removeprefix("k"), "build": built - start,
              "solve": solved - built}
    if result.is_success():
        answer["objective"] = result.get_optimal_cost()
        if chosen.max_rounded_paths > 0:
            answer |= path_of(drake, result)
    return answer


def main():
    path, paths, preprocessing, threads = sys.argv[1], *map(int, sys.argv[2:5])
    logging.getLogger("drake").setLevel(logging.WARNING)
    file = read(path)
    chosen = options(paths, bool(preprocessing), threads)
    solve(TWO_POINTS, chosen)
    print(json.dumps(solve(file, chosen)))


if __name__ == "__main__":
    main()
