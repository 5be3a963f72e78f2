#!/usr/bin/env python3
"""Runs the command line as a user does, on the example problems and on small files written here.

    command_line_test.py --source SOURCE --program PROGRAM [unittest arguments]

Cases that need a backend which is not built are skipped with a word.
"""

import argparse
import gzip
import json
import math
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ANSWERED, NOT_ANSWERED, BAD_INPUT, FAILURE = range(4)
OPTIMA = {"transport.mps": 4110, "depots.mps": 453, "ball.cbf": math.sqrt(26726 / 643)}
FIELDS = {"format", "command", "name", "termination", "primal", "dual", "message", "objective",
          "bound", "seconds", "peak_memory_bytes", "subsolvers", "considered"}
SECONDS = {"read", "build", "lower", "presolve", "solve", "recover", "total"}
PATIENCE = 120  # of one command, on a machine that does other things too

INFEASIBLE = """NAME NONE
ROWS
 N COST
 G MANY
COLUMNS
 X COST 1 MANY 1
RHS
 RHS MANY 5
BOUNDS
 UP BND X 2
ENDATA
"""
UNBOUNDED = """NAME DOWN
ROWS
 N COST
 L LIMIT
COLUMNS
 X COST -1 LIMIT -1
 Y COST 0 LIMIT 1
RHS
 RHS LIMIT 4
ENDATA
"""
BROKEN = """NAME BROKEN
ROWS
 N COST
 G ROW
COLUMNS
 X COST 1 ROW abc
ENDATA
"""


def hard_program(size=60, rows=6, seed=1):
    """A market split problem: feasible with slack at once, and far beyond proof."""
    numbers = random.Random(seed)
    names = [f"X{j}" for j in range(size)]
    a = [[numbers.randrange(1, 100) for _ in names] for _ in range(rows)]
    lines = ["NAME SPLIT", "ROWS", " N COST", *[f" E R{i}" for i in range(rows)], "COLUMNS",
             " M1 'MARKER' 'INTORG'"]
    for j, name in enumerate(names):
        lines += [f" {name} R{i} {a[i][j]}" for i in range(rows)]
    lines.append(" M2 'MARKER' 'INTEND'")
    for i in range(rows):
        lines += [f" OVER{i} COST 1 R{i} -1", f" UNDER{i} COST 1 R{i} 1"]
    lines += ["RHS", *[f" RHS R{i} {sum(a[i]) // 2}" for i in range(rows)],
              "BOUNDS", *[f" UP BND {name} 1" for name in names], "ENDATA"]
    return "\n".join(lines) + "\n"


class CommandLine(unittest.TestCase):
    source = program = None
    backends = ()

    @classmethod
    def setUpClass(cls):
        listed = json.loads(cls.run_program("plugins", "list", "--json").stdout)
        cls.backends = [one["name"] for one in listed["solvers"] if one["ready"]]

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="switchyard-command-line-"))
        self.addCleanup(shutil.rmtree, self.folder)

    @classmethod
    def environment(cls, **more):
        kept = {k: v for k, v in os.environ.items() if not k.startswith("SWITCHYARD_")}
        return kept | {"HOME": "/nonexistent", "XDG_DATA_HOME": ""} | more

    @classmethod
    def run_program(cls, *arguments, program=None, stdin=None, **more):
        given = {"input": stdin} if stdin is not None else {"stdin": subprocess.DEVNULL}
        return subprocess.run([str(program or cls.program), *map(str, arguments)],
                              capture_output=True, timeout=PATIENCE, env=cls.environment(**more),
                              text=not isinstance(stdin, bytes), **given)

    def need(self, *names):
        for name in names:
            if name not in self.backends:
                self.skipTest(f"the backend {name} is not built")

    def any_of(self, *names):
        for name in names:
            if name in self.backends:
                return name
        return self.skipTest(f"none of {', '.join(names)} is built")

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def example(self, name):
        return self.source / "examples" / "problems" / name

    def expect(self, done, code):
        self.assertEqual(done.returncode, code, f"{done.args}\n{done.stdout}\n{done.stderr}")
        return done

    def solve(self, *arguments, code=ANSWERED, **more):
        """The result/1 of a solve."""
        done = self.expect(self.run_program("solve", *arguments, "--json", "-", **more), code)
        return json.loads(done.stdout)

    def expect_optimum(self, result, optimum):
        self.assertEqual(result["termination"], "optimal", result)
        self.assertEqual(result["primal"], "feasible", result)
        self.assertLess(abs(result["objective"] - optimum), 1e-5 * max(1, abs(optimum)))


    def expect_between(self, result, optimum):
        """A point of a problem to be minimized, and a bound, that the optimum is between."""
        self.assertIn(result["termination"], ("optimal", "locally_optimal"), result)
        self.assertEqual(result["primal"], "feasible", result)
        self.assertGreater(result["objective"], optimum - 1e-5 * max(1, abs(optimum)), result)
        self.assertLess(result["bound"], optimum + 1e-5 * max(1, abs(optimum)), result)
        if result["termination"] == "optimal":
            self.expect_optimum(result, optimum)


class Answers(CommandLine):
    def test_each_example_has_its_optimum_by_each_backend_that_takes_it(self):
        self.any_of("highs", "clp", "clarabel")
        solved = set()
        for name, optimum in OPTIMA.items():
            for backend in self.backends:
                done = self.run_program("solve", self.example(name), "--solver", backend,
                                        "--gap", "1e-9", "--json", "-")
                result = json.loads(done.stdout)
                if result["termination"] == "no_backend":
                    self.assertEqual(done.returncode, NOT_ANSWERED)
                    continue
                with self.subTest(problem=name, backend=backend):
                    self.expect(done, ANSWERED)
                    if backend == "relax-and-round":  # seeks a point, and proves a bound
                        self.expect_between(result, optimum)
                        continue
                    self.expect_optimum(result, optimum)
                    solved.add(name)
        if {"highs", "clarabel"} <= set(self.backends):
            self.assertEqual(solved, set(OPTIMA))

    def test_the_result_has_its_fields(self):
        backend = self.any_of("highs", "clp", "clarabel")
        result = self.solve(self.example("transport.mps"), "--solver", backend)
        self.assertLessEqual(FIELDS, set(result))
        self.assertEqual(result["format"], "result/1")
        self.assertEqual(result["command"], "solve")
        self.assertEqual(result["name"], "TRANSPORT")
        self.assertTrue(result["solver"].endswith("." + backend) or result["solver"] == backend)
        self.assertRegex(result["solver_version"], r"^\d+\.\d+")
        self.assertEqual(set(result["seconds"]), SECONDS)
        self.assertGreaterEqual(result["seconds"]["total"], result["seconds"]["solve"])
        self.assertGreater(result["peak_memory_bytes"], 0)
        self.assertEqual(set(result["violation"]),
                         {"bounds", "rows", "cones", "integrality", "nonlinear"})
        self.assertLess(max(result["violation"].values()), 1e-5)
        self.assertAlmostEqual(result["gap"], abs(result["objective"] - result["bound"]) /
                               abs(result["objective"]))
        chosen = [one for one in result["considered"] if one["verdict"] == "chosen"]
        self.assertEqual([one["solver"] for one in chosen], [result["solver"]])

    def test_infeasible_and_unbounded_are_answers(self):
        backend = self.any_of("highs", "clp")
        for text, words in ((INFEASIBLE, "infeasible"), (UNBOUNDED, "unbounded")):
            result = self.solve(self.file("some.mps", text), "--solver", backend)
            self.assertEqual(result["termination"], words)

    def test_in_words(self):
        self.any_of("highs", "clp", "clarabel")
        done = self.expect(self.run_program("solve", self.example("transport.mps")), ANSWERED)
        self.assertRegex(done.stdout, r"^optimal by \S+ \d")
        self.assertRegex(done.stdout, r"\nobjective +4110(\.0\d*)?\n|\nobjective +4109\.99\d*\n")
        self.assertNotIn("\x1b", done.stdout + done.stderr)
        quiet = self.expect(self.run_program("solve", self.example("transport.mps"), "--quiet"),
                            ANSWERED)
        self.assertEqual(quiet.stdout, "")
        self.assertEqual(quiet.stderr, "")

    def test_the_solution_has_names(self):
        backend = self.any_of("highs", "clp", "clarabel")
        path = self.folder / "solution.json"
        self.solve(self.example("transport.mps"), "--solver", backend, "--solution", path)
        solution = json.loads(path.read_text())
        self.assertEqual(set(solution), {"variables", "rows"})
        self.assertEqual(len(solution["variables"]), 15)
        self.assertEqual(set(solution["rows"]), {"NORTH", "HARBOUR", "VALLEY", "ALDER", "BIRCH",
                                                 "CEDAR", "ELM", "FIR"})
        sent = sum(x for name, x in solution["variables"].items() if name.endswith("_ELM"))
        self.assertGreater(sent, 210 - 1e-4)
        for plant in ("NORTH", "HARBOUR", "VALLEY"):  # a limit from above has no positive price
            self.assertLess(solution["rows"][plant], 1e-5)

    def test_the_dump_is_the_problem(self):
        self.any_of("highs", "clp", "clarabel")
        path = self.folder / "dump.json"
        self.solve(self.example("transport.mps"), "--dump", path)
        dump = json.loads(path.read_text())
        self.assertEqual(dump["format"], "problem/1")
        self.assertEqual(dump["num_vars"], 15)
        self.assertEqual((dump["A"]["rows"], dump["A"]["cols"]), (8, 15))
        self.assertEqual(len(dump["A"]["entries"]), 30)
        self.assertEqual(len(dump["q"]), 15)

    def test_explain_says_who_could_serve_and_why_not(self):
        self.need("highs", "clarabel")
        done = self.expect(self.run_program("solve", self.example("ball.cbf"), "--explain"),
                           ANSWERED)
        self.assertRegex(done.stderr, r"(?m)^chosen +\S*conic: ")
        self.assertRegex(done.stderr, r"(?m)^skipped +\S*highs: does not take second-order")
        self.assertNotIn("skipped", done.stdout)

    def test_the_log_goes_to_its_file(self):
        backend = self.any_of("highs", "clp")
        log = self.folder / "log.txt"
        done = self.run_program("solve", self.example("transport.mps"), "--solver", backend,
                                "--log", log, "--quiet")
        self.expect(done, ANSWERED)
        self.assertEqual(done.stdout, "")
        self.assertGreater(log.stat().st_size, 0)


class Functions(CommandLine):
    """program/1 with functions. What needs no backend runs without one."""

    NONLINEAR = ("ipopt", "nlopt")
    HS71 = 17.0140172892

    def written(self, cost, guess=None, convex=False):
        """A program of one variable x, with this expression as its cost."""
        program = {"format": "program/1",
                   "variables": [{"name": "x"} | ({} if guess is None else {"guess": guess})],
                   "functions": {"f": {"type": "function", "description": "cost", "arguments": 1,
                                       "expressions": [cost], "convex": convex}},
                   "constraints": {"b": {"type": "bounding_box", "lb": [-3], "ub": [5]}},
                   "costs": [{"function": "f", "variables": [0]}],
                   "subject_to": [{"constraint": "b", "variables": [0]}]}
        return self.file("cost.json", json.dumps(program))

    def test_the_example_has_its_optimum(self):
        backend = self.any_of(*self.NONLINEAR)
        for name in self.NONLINEAR:
            if name not in self.backends:
                continue
            with self.subTest(backend=name):
                result = self.solve(self.example("hs71.json"), "--solver", name)
                self.assertEqual(result["termination"], "locally_optimal", result)
                self.assertLess(abs(result["objective"] - self.HS71), 1e-5 * self.HS71)
                self.assertLess(result["violation"]["nonlinear"], 1e-4)
                self.assertEqual(set(result["evaluations"]), {"objective", "gradient", "constraints",
                                                              "jacobian", "hessian"})
                self.assertGreater(result["evaluations"]["objective"], 0)
                self.assertNotIn("starts", result)
        path = self.folder / "solution.json"
        done = self.expect(self.run_program("solve", self.example("hs71.json"), "--solver", backend,
                                            "--solution", path), ANSWERED)
        self.assertRegex(done.stdout, r"\nviolation .*, functions \S+, integrality 0\n")
        rows = json.loads(path.read_text())["rows"]
        self.assertAlmostEqual(rows["product"], 0.55229366, places=3)
        self.assertAlmostEqual(rows["sphere"], -0.16146857, places=3)

    def test_a_program_without_functions_has_no_evaluations(self):
        self.any_of("highs", "clp", "clarabel")
        result = self.solve(self.example("transport.mps"))
        self.assertFalse({"evaluations", "starts"} & set(result))

    def test_a_convex_one_is_optimal(self):
        backend = self.any_of(*self.NONLINEAR)
        for convex, words in ((True, "optimal"), (False, "locally_optimal")):
            path = self.written("exp(x[0]) - 2*x[0]", 0, convex)
            result = self.solve(path, "--solver", backend)
            self.assertEqual(result["termination"], words, result)
            self.assertLess(abs(result["objective"] - (2 - 2 * math.log(2))), 1e-5)

    def test_many_starts_find_the_better_of_two_valleys(self):
        backend = self.any_of(*self.NONLINEAR)
        # Valleys at x = 2.03 and x = -1.94; the guess leads to the shallow one.
        path = self.written("(x[0]^2 - 4)^2 - 2*x[0]", -2)
        alone = self.solve(path, "--solver", backend)
        self.assertGreater(alone["objective"], 3)
        many = ("--solver", backend, "--starts", "12", "--seed", "1")
        result = self.solve(path, *many)
        self.assertLess(result["objective"], -4)
        self.assertEqual(result["starts"]["tried"], 12)
        self.assertEqual(result["starts"]["distinct"], 2)
        again = self.solve(path, *many, "--threads", "1")
        self.assertEqual(again["objective"], result["objective"])
        self.assertEqual(again["starts"], result["starts"])
        said = self.expect(self.run_program("solve", path, *many), ANSWERED).stdout
        self.assertRegex(said, r"\nstarts     \d+ of 12 gave an answer, 2 of these distinct\n")

    def test_many_starts_of_a_backend_that_is_not_there(self):
        done = self.run_program("solve", self.example("hs71.json"), "--starts", "2", "--solver",
                                "nobody")
        self.expect(done, NOT_ANSWERED)
        self.assertIn("no_backend", done.stderr)

    def test_derivatives_that_agree(self):
        check = ("solve", self.example("hs71.json"), "--check-derivatives")
        done = self.expect(self.run_program(*check), ANSWERED)
        self.assertRegex(done.stdout, r"^the derivatives of 3 terms agree with differences to \S+\n$")
        done = self.expect(self.run_program(*check, "--quiet"), ANSWERED)
        self.assertEqual(done.stdout + done.stderr, "")
        done = self.run_program("solve", self.example("ball.cbf"), "--check-derivatives")
        self.assertEqual(self.expect(done, ANSWERED).stdout, "the program has no functions\n")

    def test_derivatives_that_do_not(self):
        # Without a guess x is in the middle of [-3, 5], at 1.
        done = self.run_program("solve", self.written("abs(x[0] - 1)"), "--check-derivatives")
        self.expect(done, NOT_ANSWERED)
        self.assertRegex(done.stdout, r"(?m)^second derivative of cost by x and x: the pattern has no "
                                      r"place for it, differences say \S+$")
        done = self.run_program("solve", self.written("max(x[0], 1)"), "--check-derivatives")
        self.expect(done, NOT_ANSWERED)
        self.assertRegex(done.stdout, r"(?m)^derivative of cost by x is 1, differences say 0\.5$")
        done = self.run_program("solve", self.written("log(x[0])", -1), "--check-derivatives")
        self.expect(done, NOT_ANSWERED)
        self.assertIn("cost is not defined at the point", done.stdout)

    def test_a_wrong_expression_is_said_with_its_column(self):
        path = self.written("exp(x[0]) + sine(x[0])")
        done = self.expect(self.run_program("solve", path), BAD_INPUT)
        self.assertIn(f"{path}: /functions/f/expressions/0: needs ", done.stderr)
        self.assertIn(' at column 13, got "sine" (the nearest is "sin")', done.stderr)

    def test_convert_keeps_functions_or_says_what_holds_none(self):
        once, twice = self.folder / "once.json", self.folder / "twice.json.gz"
        self.expect(self.run_program("convert", self.example("hs71.json"), once), ANSWERED)
        self.expect(self.run_program("convert", once, twice), ANSWERED)
        self.assertEqual(gzip.decompress(twice.read_bytes()), once.read_bytes())
        for ending in ("mps", "cbf"):
            target = self.folder / f"target.{ending}"
            done = self.expect(self.run_program("convert", once, target), BAD_INPUT)
            self.assertIn(f"{ending} cannot hold this program; costs that are functions: 1 of kind "
                          "function cost; constraints that are quadratic: 1", done.stderr)
            self.assertFalse(target.exists())


class Streams(CommandLine):
    def test_standard_input_and_gzip(self):
        self.any_of("highs", "clp", "clarabel")
        text = self.example("transport.mps").read_bytes()
        packed = self.folder / "transport.mps.gz"
        packed.write_bytes(gzip.compress(text))
        self.expect_optimum(self.solve(packed), 4110)
        self.expect_optimum(self.solve("-", stdin=text), 4110)
        self.expect_optimum(self.solve("-", stdin=gzip.compress(text)), 4110)
        ball = self.example("ball.cbf").read_bytes()
        if "clarabel" in self.backends:
            self.expect_optimum(self.solve("-", stdin=ball), OPTIMA["ball.cbf"])

    def test_convert_there_and_back(self):
        for name in OPTIMA:
            for ending in (".mps", ".mps.gz", ".cbf", ".cbf.gz"):
                if name == "ball.cbf" and ".mps" in ending:
                    continue
                with self.subTest(problem=name, to=ending):
                    other = self.folder / ("other" + ending)
                    done = self.run_program("convert", self.example(name), other)
                    self.expect(done, ANSWERED)
                    self.assertEqual(done.stdout, "")
                    self.assertEqual(other.read_bytes()[:2] == b"\x1f\x8b", ending.endswith(".gz"))
                    backend = self.any_of("clarabel") if name == "ball.cbf" else "highs"
                    self.need(backend)
                    self.expect_optimum(self.solve(other, "--solver", backend, "--gap", "1e-9"),
                                        OPTIMA[name])

    def test_convert_through_pipes(self):
        text = self.example("transport.mps").read_bytes()
        done = self.expect(self.run_program("convert", "-", self.folder / "a.mps", stdin=text),
                           ANSWERED)
        self.assertEqual(done.stdout, b"")
        once = (self.folder / "a.mps").read_text()
        self.expect(self.run_program("convert", self.folder / "a.mps", self.folder / "b.mps"),
                    ANSWERED)
        self.assertEqual((self.folder / "b.mps").read_text(), once)

    def test_convert_says_what_the_target_cannot_hold(self):
        target = self.folder / "ball.mps"
        done = self.expect(self.run_program("convert", self.example("ball.cbf"), target),
                           BAD_INPUT)
        self.assertIn("cone", done.stderr)
        self.assertFalse(target.exists())


class Mistakes(CommandLine):
    def test_a_broken_file_is_said_with_line_and_column(self):
        path = self.file("broken.mps", BROKEN)
        done = self.expect(self.run_program("solve", path, "--json", "-"), BAD_INPUT)
        self.assertEqual(done.stdout, "")
        self.assertRegex(done.stderr, re.escape(str(path)) + r":6:15: expected .*, got .*abc")
        for command in (("convert", path, self.folder / "out.cbf"), ("solve", "-")):
            done = self.run_program(*command, stdin=BROKEN)
            self.expect(done, BAD_INPUT)
            self.assertRegex(done.stderr, r":6:15: expected ")

    def test_files_that_cannot_be_read_or_written(self):
        good = self.example("transport.mps")
        for command in (("solve", self.folder / "none.mps"), ("solve", self.folder),
                        ("convert", good, self.folder / "no" / "folder.mps"),
                        ("convert", good, self.folder / "name.xyz"),
                        ("solve", self.file("empty.mps", ""))):
            with self.subTest(command=command):
                done = self.expect(self.run_program(*command), BAD_INPUT)
                self.assertEqual(done.stdout, "")
                self.assertIn(str(command[-1]), done.stderr)

    def test_answers_that_cannot_be_written(self):
        self.any_of("highs", "clp", "clarabel")
        for option in ("--json", "--solution", "--dump", "--log"):
            with self.subTest(option=option):
                target = self.folder / "no" / "folder"
                done = self.run_program("solve", self.example("transport.mps"), option, target)
                self.expect(done, BAD_INPUT)
                self.assertIn(str(target), done.stderr)

    def test_usage(self):
        good = self.example("transport.mps")
        for command in ((), ("slove",), ("solve",), ("solve", good, "--no-such-option"),
                        ("solve", good, "--time-limit", "-1"), ("solve", good, "--gap", "x"),
                        ("solve", good, "--threads", "0"), ("plugins",), ("plugins", "describe"),
                        ("solve", good, "--starts", "0"),
                        ("solve", good, "--starts", "2", "--check-derivatives"),
                        ("convert", good), ("solve", good, "--option", "novalue")):
            with self.subTest(command=command):
                done = self.expect(self.run_program(*command), BAD_INPUT)
                self.assertEqual(done.stdout, "")
                self.assertNotEqual(done.stderr, "")

    def test_an_option_with_a_wrong_name_or_value(self):
        self.need("highs")
        solve = ("solve", self.example("transport.mps"), "--solver", "highs", "--option")
        for option, said in (("presolv=off", 'the nearest is "presolve"'),
                             ("highs:presolv=off", 'the nearest is "presolve"'),
                             ("simplex_iteration_limit=x", "needs an integer")):
            done = self.expect(self.run_program(*solve, option), BAD_INPUT)
            self.assertIn(said, done.stderr)
        self.expect_optimum(self.solve(*solve[1:], "presolve=off"), 4110)

    def test_a_backend_that_is_not_there(self):
        backend = self.any_of("highs", "clp", "clarabel")
        done = self.run_program("solve", self.example("transport.mps"), "--solver", "nobody",
                                "--json", "-")
        self.expect(done, NOT_ANSWERED)
        result = json.loads(done.stdout)
        self.assertEqual(result["termination"], "no_backend")
        self.assertIn("nobody", result["message"])
        self.assertRegex(result["message"], f"would serve: .*{backend}")
        self.assertIn("no_backend", done.stderr)
        done = self.run_program("solve", self.example("transport.mps"), "--option", "nobody:a=1")
        self.expect(done, NOT_ANSWERED)
        self.assertIn("no_backend", done.stderr)

    def test_a_backend_that_does_not_take_the_problem(self):
        self.need("clp")
        result = self.solve(self.example("depots.mps"), "--solver", "clp", code=NOT_ANSWERED)
        self.assertEqual(result["termination"], "no_backend")
        self.assertIn("integer variables", result["message"])

    def test_a_plugin_that_is_none(self):
        path = self.file("text.so", "text")
        done = self.run_program("solve", self.example("transport.mps"), "--plugin", path)
        self.expect(done, BAD_INPUT)
        self.assertIn(f"{path}: not a module", done.stderr)


class Plugins(CommandLine):
    def test_list_describe_and_doctor(self):
        backend = self.any_of("highs", "clp", "clarabel")
        listed = self.expect(self.run_program("plugins", "list"), ANSWERED)
        for name in self.backends:
            self.assertRegex(listed.stdout, rf"(?m)^{name} ")
        described = self.expect(self.run_program("plugins", "describe", backend), ANSWERED)
        self.assertRegex(described.stdout, rf"(?m)^id +\S*{backend}$")
        self.expect(self.run_program("plugins", "doctor"), ANSWERED)

    def test_tables_that_are_no_solvers_are_listed(self):
        engines = json.loads(self.run_program("plugins", "list", "--json").stdout)["dynamics"]
        if not engines:
            self.skipTest("no plugin offers rigid-body dynamics")
        listed = self.expect(self.run_program("plugins", "list"), ANSWERED).stdout
        for engine in engines:
            self.assertIn(f"dynamics: {engine['name']} {engine['version']} ({engine['file']})", listed)
            done = self.expect(self.run_program("plugins", "doctor", engine["file"]), ANSWERED)
            self.assertIn(f"dynamics: {engine['name']} {engine['version']}: ready", done.stdout)

    def test_describe_of_none(self):
        self.need("highs")
        done = self.expect(self.run_program("plugins", "describe", "higs"), BAD_INPUT)
        self.assertIn('the nearest is "highs"', done.stderr)

    def test_the_doctor_says_what_is_wrong_and_what_to_do(self):
        empty = self.folder / "empty.so"
        empty.write_bytes(b"")
        for file, said in ((empty, "not a module: the file is empty"),
                           (self.folder / "none.so", "file absent")):
            done = self.expect(self.run_program("plugins", "doctor", file), NOT_ANSWERED)
            self.assertIn(said, done.stdout)
        done = self.run_program("plugins", "doctor", SWITCHYARD_PLUGIN_PATH=str(self.folder))
        self.expect(done, NOT_ANSWERED)
        self.assertIn(str(empty), done.stdout)

    def test_a_module_that_is_named_and_found_serves_once(self):
        self.need("clp")
        listed = json.loads(self.run_program("plugins", "list", "--json").stdout)
        module = next(one["file"] for one in listed["solvers"] if one["name"] == "clp")
        result = self.solve(self.example("transport.mps"), "--plugin", module, "--solver", "clp")
        self.expect_optimum(result, 4110)

    def test_help_has_an_example_for_every_command(self):
        whole = self.expect(self.run_program("--help"), ANSWERED).stdout
        self.assertIn("Example: switchyard", whole)
        for command in (("solve",), ("plan",), ("generate",), ("convert",), ("plugins",),
                        ("plugins", "list"), ("plugins", "describe"), ("plugins", "doctor")):
            with self.subTest(command=command):
                text = self.expect(self.run_program(*command, "--help"), ANSWERED).stdout
                self.assertIn("Example: switchyard " + " ".join(command), text)
        for absent in ("check-plugin", "bench"):
            self.assertNotRegex(whole, rf"(?m)^ +{absent}\b")
        version = self.expect(self.run_program("--version"), ANSWERED).stdout
        self.assertRegex(version, r"^switchyard \d+\.\d+\.\d+\n$")

    def test_a_copied_tree_works_from_another_place(self):
        backend = self.any_of("clp", "highs", "clarabel")
        tree = self.program.parent.parent
        libraries = list((tree / "lib").glob("libswitchyard.so*"))
        if not libraries:
            self.skipTest("the program does not stand in a tree of bin and lib")
        other = self.folder / "a place with blanks"
        (other / "bin").mkdir(parents=True)
        (other / "lib").mkdir()
        shutil.copy(self.program, other / "bin")
        for path in libraries:
            shutil.copy(path, other / "lib", follow_symlinks=False)
        shutil.copytree(tree / "lib" / "switchyard", other / "lib" / "switchyard", symlinks=True)
        program = other / "bin" / self.program.name
        listed = json.loads(self.run_program("plugins", "list", "--json", program=program).stdout)
        self.assertEqual([one["name"] for one in listed["solvers"]], self.backends)
        for one in listed["solvers"] + listed["dynamics"]:
            self.assertTrue(one["file"].startswith(str(other.resolve())), one["file"])
        done = self.run_program("solve", self.example("transport.mps"), "--solver", backend,
                                "--json", "-", program=program)
        self.expect_optimum(json.loads(self.expect(done, ANSWERED).stdout), 4110)


class Limits(CommandLine):
    def test_a_time_limit_leaves_the_incumbent_and_its_bound(self):
        for backend in ("highs", "cbc"):
            if backend not in self.backends:
                continue
            with self.subTest(backend=backend):
                path = self.file("hard.mps", hard_program())
                began = time.monotonic()
                result = self.solve(path, "--solver", backend, "--time-limit", "2", "--gap", "0")
                spent = time.monotonic() - began
                self.assertEqual(result["termination"], "time_limit")
                self.assertEqual(result["primal"], "feasible")
                self.assertGreaterEqual(result["objective"], result["bound"])
                # 5 % and a quarter of a second are promised on a machine that does nothing else.
                self.assertLess(spent, 20)
        self.any_of("highs", "cbc")

    def test_no_time_at_all_is_not_answered(self):
        backend = self.any_of("highs", "cbc")
        result = self.solve(self.file("hard.mps", hard_program()), "--solver", backend,
                            "--time-limit", "0", code=NOT_ANSWERED)
        self.assertEqual(result["termination"], "time_limit")
        self.assertEqual(result["primal"], "none")

    def interrupt(self, backend, times):
        """Sends Ctrl-C once the search has surely begun; the process and what it wrote."""
        path = self.file("hard.mps", hard_program())
        process = subprocess.Popen(
            [self.program, "solve", path, "--solver", backend, "--gap", "0", "--json", "-"],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=self.environment())
        self.addCleanup(process.kill)
        time.sleep(3)
        for _ in range(times):
            process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=PATIENCE)
        return process.returncode, out

    def test_an_interrupt_stops_with_the_incumbent(self):
        backend = self.any_of("highs", "cbc")
        code, out = self.interrupt(backend, 1)
        result = json.loads(out)
        self.assertEqual(result["termination"], "cancelled")
        self.assertEqual(result["primal"], "feasible")
        self.assertEqual(code, ANSWERED)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--source", type=Path, required=True)
    parser.add_argument("--program", type=Path, required=True)
    args, rest = parser.parse_known_args()
    CommandLine.source, CommandLine.program = args.source.resolve(), args.program.resolve()
    unittest.main(argv=[sys.argv[0], *rest])


if __name__ == "__main__":
    main()
