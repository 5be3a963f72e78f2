#!/usr/bin/env python3
"""Runs our side of the comparison with Drake on its smallest scenario and judges the answer.

    trajectories_test.py SOURCE PROGRAM
"""

import json
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE, PROGRAM = Path(sys.argv[1]), sys.argv[2]
sys.path.insert(0, str(SOURCE / "benchmarks" / "drake"))
from trajectory_judge import judge  # noqa: E402
from trajectory_scenarios import two_rooms  # noqa: E402


def run(scenario, paths):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scenario.json"
        file.write_text(json.dumps(scenario))
        out = subprocess.run([PROGRAM, file, str(paths), "1"], capture_output=True, text=True,
                             check=False)
        return json.loads(out.stdout) if out.returncode == 0 else out.stderr


class Runner(unittest.TestCase):
    def test_two_rooms_are_crossed_along_the_diagonal(self):
        answer = run(two_rooms(), 10)
        cost, broken = judge(two_rooms(), answer["segments"])
        self.assertAlmostEqual(cost, 2 + 2 * math.sqrt(2), delta=1e-5)
        self.assertAlmostEqual(answer["cost"], cost, delta=1e-6)
        self.assertLess(max(broken.values()), 1e-5)

    def test_the_relaxation_of_one_way_is_that_way(self):
        self.assertAlmostEqual(run(two_rooms(), 0)["cost"], 2 + 2 * math.sqrt(2), delta=1e-5)

    def test_a_mistake_in_a_scenario_is_a_sentence(self):
        wrong = two_rooms()
        wrong["subgraphs"][0]["h_min"] = 30
        self.assertRegex(run(wrong, 10), r"^trajectories: .*30")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
