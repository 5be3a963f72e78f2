"""Solves the problem of runner/kinematic.cpp by Drake with Ipopt; answers in JSON.

    solve_kinematic_with_drake.py PROBLEM CONTROL_POINTS TURNS

PROBLEM is the first line of `kinematic --json`.
"""

import json
import sys
import time

import numpy as np
from pydrake.planning import KinematicTrajectoryOptimization
from pydrake.solvers import IpoptSolver


def built(problem, num_control_points):
    """The optimization with its costs, bounds and ends."""
    goal, velocity, acceleration, jerk = (
        np.array(problem[name]) for name in ("goal", "velocity", "acceleration", "jerk"))
    zero = np.zeros(len(goal))
    position = np.full(len(goal), problem["position"])
    motion = KinematicTrajectoryOptimization(len(goal), num_control_points)
    motion.AddDurationConstraint(*problem["duration"])
    motion.AddDurationCost()
    motion.AddPathLengthCost()
    motion.AddPositionBounds(-position, position)
    motion.AddVelocityBounds(-velocity, velocity)
    motion.AddAccelerationBounds(-acceleration, acceleration)
    motion.AddJerkBounds(-jerk, jerk)
    motion.AddPathPositionConstraint(zero, zero, 0)
    motion.AddPathPositionConstraint(goal, goal, 1)
    motion.AddPathVelocityConstraint(zero, zero, 0)
    motion.AddPathVelocityConstraint(zero, zero, 1)
    return motion


def main():
    problem, size, turns = json.loads(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
    seconds = []
    for _ in range(turns):
        motion = built(problem, size)
        start = time.perf_counter()
        result = IpoptSolver().Solve(motion.prog(), None, None)
        seconds.append(time.perf_counter() - start)
    answer = {"status": result.get_solution_result().name, "seconds": min(seconds)}
    if result.is_success():
        answer["objective"] = result.get_optimal_cost()
    print(json.dumps(answer))


if __name__ == "__main__":
    main()
