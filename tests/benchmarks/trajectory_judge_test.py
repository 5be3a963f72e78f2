#!/usr/bin/env python3
"""Tests the judge of trajectories on lines and parabolas whose costs are known.

    trajectory_judge_test.py SOURCE
"""

import copy
import math
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(sys.argv.pop(1)) / "benchmarks" / "drake"))
from trajectory_judge import judge  # noqa: E402
from trajectory_scenarios import (  # noqa: E402
    box, costs, joined, orders, point, scenario, subgraph, two_rooms, velocity)

DIAGONAL = [{"points": [[k / 3, k / 3] for k in range(4)], "duration": 1.0},
            {"points": [[1 + k / 3, 1 + k / 3] for k in range(4)], "duration": 1.0}]


def changed(segments, segment, point_, by):
    """The point of a segment moved."""
    segments = copy.deepcopy(segments)
    segments[segment]["points"][point_] = [
        a + b for a, b in zip(segments[segment]["points"][point_], by)]
    return segments


def line(length, duration, order=2):
    """From 0 along an axis."""
    return {"points": [[length * k / order] for k in range(order + 1)], "duration": duration}


def one_room(terms, end=1.0, order=2, **rest):
    room = subgraph("room", [box([-1], [2])], order, 0.01, 10)
    return scenario(1, room, [0], [end], terms, **rest)


class Costs(unittest.TestCase):
    def test_the_diagonal_of_two_rooms_costs_its_time_and_its_length(self):
        cost, broken = judge(two_rooms(), DIAGONAL)
        self.assertAlmostEqual(cost, 2 + 2 * math.sqrt(2), places=12)
        self.assertLess(max(broken.values()), 1e-12)

    def test_energy_is_the_sum_of_the_squares_of_the_legs(self):
        cost, _ = judge(one_room(costs(energy=3), order=4), [line(1, 1, order=4)])
        self.assertAlmostEqual(cost, 3 * 4 * 0.25 ** 2)

    def test_terms_of_a_subgraph_are_for_its_segments_alone(self):
        rooms = [subgraph("first", [box([0], [1])], 1, 0, 10, terms=costs(time=5)),
                 subgraph("second", [box([1], [2])], 2, 0, 10, terms=costs(length=7))]
        two = {"num_positions": 1, "continuous_joints": [], "subgraphs": rooms,
               "edges": [joined(0, 1)], "terms": costs(time=1), "source": 0, "target": 1}
        first, second = line(1, 2, order=1), {"points": [[1], [1.5], [2]], "duration": 3}
        self.assertAlmostEqual(judge(two, [first, second])[0], 6 * 2 + 3 + 7)


class Regions(unittest.TestCase):
    def test_a_control_point_outside_breaks_its_region(self):
        _, broken = judge(two_rooms(), changed(DIAGONAL, 0, 1, [-0.334, 0]))
        self.assertAlmostEqual(broken["regions"], 0.334 - 1 / 3)

    def test_a_segment_in_no_region_is_none(self):
        with self.assertRaisesRegex(ValueError, "segment 1 is in no region"):
            judge(two_rooms(), changed(DIAGONAL, 0, 1, [-1, 0]))

    def test_a_trajectory_that_ends_before_the_target_is_none(self):
        with self.assertRaises(ValueError):
            judge(two_rooms(), DIAGONAL[:1])

    def test_regions_without_an_edge_do_not_follow_each_other(self):
        walled = two_rooms()
        walled["subgraphs"][0]["pairs"] = [[1, 0]]
        with self.assertRaises(ValueError):
            judge(walled, DIAGONAL)

    def test_an_end_outside_the_subspace_breaks_regions(self):
        rooms = [subgraph("first", [box([0], [1])], 1, 0, 10),
                 subgraph("second", [box([0], [2])], 2, 0, 10)]
        two = {"num_positions": 1, "continuous_joints": [], "subgraphs": rooms,
               "edges": [joined(0, 1, subspace=point(0.75))], "terms": [], "source": 0,
               "target": 1}
        segments = [line(1, 1, order=1), {"points": [[1], [1], [2]], "duration": 1}]
        self.assertAlmostEqual(judge(two, segments)[1]["regions"], 0.25)


class Constraints(unittest.TestCase):
    def test_a_gap_at_a_joint_is_seen_and_whole_turns_of_a_continuous_joint_are_not(self):
        turn = subgraph("turn", [box([0], [2]), box([5], [2 * math.pi + 0.1])], 1, 0, 10)
        circle = scenario(1, turn, [0.5], [6], [], continuous_joints=[0])
        segments = [{"points": [[0.5], [0.01]], "duration": 1},
                    {"points": [[2 * math.pi + 0.01], [6]], "duration": 1}]
        self.assertLess(judge(circle, segments)[1]["joints"], 1e-12)
        circle["continuous_joints"] = []
        self.assertAlmostEqual(judge(circle, segments)[1]["joints"], 2 * math.pi)

    def test_a_velocity_beyond_its_bound_is_seen(self):
        cost, broken = judge(one_room(costs(time=1) + [velocity([1])]), [line(1, 0.5, order=2)])
        self.assertAlmostEqual(cost, 0.5)
        self.assertAlmostEqual(broken["bounds"], 0.5 - 0.25)  # each of the two legs

    def test_an_acceleration_bound_is_exact_for_a_parabola(self):
        # q = a t^2 / 2 on [0, h] has the control points 0, 0, a h^2 / 2.
        for bound, expected in ((2.0, 0.0), (1.9, 0.1 * 0.25 / 2)):
            term = {"type": "derivative_bounds", "order": 2, "lower": [-1], "upper": [bound]}
            parabola = {"points": [[0], [0], [0.25]], "duration": 0.5}
            _, broken = judge(one_room([term], end=0.25), [parabola])
            self.assertAlmostEqual(broken["bounds"], expected)

    def test_continuity_by_time_is_not_that_of_paths(self):
        rooms = subgraph("rooms", [box([0], [1]), box([1], [2])], 2, 0.01, 10)
        same = [line(1, 1), {"points": [[1], [1.5], [2]], "duration": 2}]
        for kind, expected in (("path_continuity", 0.0), ("continuity", 0.25)):
            _, broken = judge(scenario(1, rooms, [0], [2], orders(kind, 1)), same)
            self.assertAlmostEqual(broken["continuity"], expected)

    def test_a_zero_derivative_holds_the_side_that_has_one(self):
        ends = one_room([], ends=orders("zero_derivatives", 1))
        self.assertAlmostEqual(judge(ends, [line(1, 1)])[1]["continuity"], 0.5)
        rest = {"points": [[0], [0], [1], [1]], "duration": 1}
        ends["subgraphs"][0]["order"] = 3
        self.assertEqual(judge(ends, [rest])[1]["continuity"], 0)

    def test_a_duration_beyond_its_range_is_seen(self):
        self.assertAlmostEqual(judge(one_room([]), [line(1, 12)])[1]["durations"], 2)


if __name__ == "__main__":
    unittest.main()
