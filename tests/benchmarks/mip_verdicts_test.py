#!/usr/bin/env python3
"""Tests what the comparison of mixed-integer solvers believes: its reader, its judge, its verdicts.

    mip_verdicts_test.py SOURCE
"""

import gzip
import math
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

sys.path.insert(0, str(Path(sys.argv.pop(1)) / "benchmarks" / "mip"))
import report  # noqa: E402
from conic_file import judge, read_conic  # noqa: E402
from verdicts import judge_together  # noqa: E402

# max x_0 + x_1 + 1 with x_0 <= 0 integer, (x_1, x_2) in Q; 2 (x_1) (3) >= x_2^2, x_0 + x_1 - 2 = 0.
DISC = """# of two entries
VER
1
OBJSENSE
MAX
VAR
3 2
L- 1
Q 2
INT
1
0
CON
4 2
QR 3
L= 1
OBJACOORD
2
0 1
1 1
OBJBCOORD
1
ACOORD
4
0 1 1
2 2 1
3 0 1
3 1 1
BCOORD
2
1 3
3 -2
"""
LIMITS = SimpleNamespace(seconds=60, gap=1e-4)


def read(text):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "problem.cbf.gz"
        path.write_bytes(gzip.compress(text.encode()))
        return read_conic(path)


def answer(name, **rest):
    return {"name": name, "end": "optimal", "status": "optimal", "seconds": 1.0} | rest


def point(name, objective, bound=None, violation=0.0, **rest):
    return answer(name, objective=objective, cost=objective, violation=violation,
                  bound=objective if bound is None else bound, **rest)


def together(*answers, optimum=None, maximize=False):
    judge_together(answers, optimum, maximize, LIMITS)
    return answers


class Files(unittest.TestCase):
    def test_a_point_that_holds_costs_what_the_file_says(self):
        self.assertEqual(judge(read(DISC), [-1, 3, -2]), (3, 0))

    def test_every_kind_of_cone_is_looked_at(self):
        problem = read(DISC)
        self.assertAlmostEqual(judge(problem, [0, 2, -2.5])[1], 0.5 / 2.5)  # Q
        self.assertAlmostEqual(judge(problem, [1, 1, 0])[1], 1)  # L-
        self.assertAlmostEqual(judge(problem, [-1, 2.5, 0])[1], 0.5 / 2.5)  # L=
        self.assertAlmostEqual(judge(problem, [-0.5, 2.5, 0])[1], 0.5)  # an integer

    def test_a_rotated_cone_is_a_turned_one(self):
        problem = read(DISC.replace("Q 2", "F 2"))
        self.assertEqual(judge(problem, [-4, 6, 6])[1], 0)  # 2 6 3 = 6^2
        outside = math.hypot(3 / math.sqrt(2), 7) - 9 / math.sqrt(2)
        self.assertAlmostEqual(judge(problem, [-4, 6, 7])[1], outside / 7)

    def test_what_is_not_read_is_refused(self):
        with self.assertRaisesRegex(ValueError, "cone: must be one of F, .*, and is EXP"):
            read(DISC.replace("QR 3", "EXP 3"))
        with self.assertRaisesRegex(ValueError, "section: .*, and is PSDVAR"):
            read(DISC + "PSDVAR\n1\n2\n")


class Verdicts(unittest.TestCase):
    def test_answers_that_agree_are_solved(self):
        for one in together(point("a", 10), point("b", 10.0005, 9.9999), optimum=10):
            self.assertEqual((one["wrong"], one["solved"]), ([], True))

    def test_a_bound_beyond_the_optimum_is_wrong_on_either_side(self):
        low, = together(point("a", 10.01), optimum=10)
        self.assertIn("its bound is beyond 10", low["wrong"])
        high, = together(point("a", 9.99), optimum=10, maximize=True)
        self.assertIn("its bound is beyond 10", high["wrong"])
        self.assertFalse(high["solved"])

    def test_a_point_of_another_speaks_where_it_holds(self):
        wrong, _ = together(point("a", 10), point("b", 9))
        self.assertTrue(wrong["wrong"])
        right, other = together(point("a", 10), point("b", 9, violation=1e-4))
        self.assertEqual(right["wrong"], [])
        self.assertIn("better than the bound of a", other["notes"])

    def test_infeasible_is_wrong_where_a_point_is_known(self):
        claims, _ = together(answer("a", end="infeasible"), point("b", 1))
        self.assertEqual(claims["wrong"], ["infeasible, and 1 is known"])
        claims, = together(answer("a", end="infeasible"))
        self.assertTrue(claims["solved"])

    def test_an_objective_that_is_not_that_of_its_point_is_wrong(self):
        one, = together(point("a", 10) | {"cost": 10.1})
        self.assertEqual(one["wrong"], ["says 10, costs 10.1"])

    def test_an_objective_below_its_own_bound_is_wrong(self):
        one, = together(point("a", 10, bound=11, violation=1e-6))
        self.assertEqual(one["wrong"], ["its objective is beyond its bound"])

    def test_a_point_that_breaks_much_is_none(self):
        little, much = together(point("a", 1, violation=1e-4), point("b", 1, violation=1e-2))
        self.assertEqual((little["wrong"], little["notes"]),
                         ([], ["breaks a constraint by 1.0e-04"]))
        self.assertFalse(much["solved"])

    def test_what_is_not_closed_or_late_or_failed_is_not_solved(self):
        for one in together(point("a", 10, bound=9), point("b", 10, seconds=62.0),
                            point("c", 10, end="limit"),
                            {"name": "d", "end": "failed", "status": "over 90 s"}):
            self.assertEqual((one["wrong"], one["solved"]), ([], False))


class Reports(unittest.TestCase):
    def test_each_family_has_its_names(self):
        for name, family in (("achtziger_stolpe07-5.2flowc", "stolpe"), ("b1bigflowc", "stolpe"),
                             ("10_0_5_w", "x_0_5_w"), ("ck_n50_m10_o1_5", "ck"),
                             ("clay0203h", "clay"), ("pp-n10-d10", "pp"), ("bell5", "milp")):
            self.assertEqual(report.family_of("milp", name), family)

    def test_what_is_not_solved_counts_the_limit(self):
        solved, late = together(point("a", 10), point("b", 10, end="limit"))
        self.assertEqual([report.counted(one, 60) for one in (solved, late)], [1, 60])
        self.assertAlmostEqual(report.shifted_mean([1, 60]), math.sqrt(11 * 70) - 10)


if __name__ == "__main__":
    unittest.main()
