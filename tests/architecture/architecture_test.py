#!/usr/bin/env python3
"""Tests the checker on small trees that keep the rules, and on trees that break one each."""

import tempfile
import unittest
from pathlib import Path

from check_architecture import mistakes
from function_lengths import functions


def body(lines):
    return "{\n" + "  Step();\n" * lines + "}\n"


class Tree(unittest.TestCase):
    def found(self, files):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return list(mistakes(Path(folder)))

    def assert_only(self, files, sentence):
        self.assertEqual(self.found(files), [sentence])


class Includes(Tree):
    def test_what_the_table_allows_passes(self):
        self.assertEqual(self.found({
            "include/switchyard/abi.h": "#include <stdint.h>\n",
            "include/switchyard/plugin.hpp": '#include "switchyard/abi.h"\n',
            "include/switchyard/solve/solve.hpp": '#include "switchyard/host/host.hpp"\n',
            "core/solve/solve.cpp": '#include "switchyard/lower/lower.hpp"\n',
            "core/bridges/norm.cpp": '#include "problem/builder.hpp"\n',
            "plugins/clp/clp.cpp": '#include "coin/ClpSimplex.hpp"\n#include "switchyard/abi.h"\n',
            "tools/switchyard/main.cpp": '#include "core/io/mps.hpp"\n#include <Highs.h>\n',
        }), [])

    def test_the_contract_knows_nothing(self):
        self.assert_only(
            {"include/switchyard/abi.h": "#include <stdint.h>\n#include <math.h>\n"},
            "include/switchyard/abi.h:2: includes math.h; abi.h knows nothing but stddef.h and "
            "stdint.h")

    def test_an_arrow_of_core_may_not_be_turned_round(self):
        self.assert_only(
            {"core/model/program.cpp": '#include "switchyard/lower/lower.hpp"\n'},
            "core/model/program.cpp:1: includes switchyard/lower/lower.hpp; model may know functions, "
            "linalg, symbolic, not lower")

    def test_the_host_applies_bridges_and_neither_knows_the_model(self):
        self.assertEqual(self.found({
            "core/host/facade.hpp": '#include "core/bridges/bridge.hpp"\n',
            "core/lower/lowering.cpp": '#include "core/problem/vectors.hpp"\n'}), [])
        self.assert_only(
            {"core/bridges/rows.cpp": '#include "core/lower/lowering.hpp"\n'},
            "core/bridges/rows.cpp:1: includes core/lower/lowering.hpp; bridges may know linalg, "
            "problem, not lower")

    def test_it_holds_for_public_headers_and_for_includes_from_the_folder_of_core(self):
        self.assertEqual(len(self.found({
            "include/switchyard/model/program.hpp": '#include "switchyard/solve/solve.hpp"\n',
            "core/host/host.cpp": '#include "model/program.hpp"\n'})), 2)

    def test_core_names_no_solver(self):
        self.assert_only(
            {"core/host/host.cpp": "#include <Highs.h>\n"},
            "core/host/host.cpp:1: includes Highs.h; core names no solver: a solver's library is a "
            "plugin's business")

    def test_a_plugin_never_knows_core(self):
        self.assert_only(
            {"plugins/clp/clp.cpp": '#include "switchyard/model/program.hpp"\n'},
            "plugins/clp/clp.cpp:1: includes switchyard/model/program.hpp; plugins know the shared "
            "headers, never core")

    def test_the_parts_of_solvers_know_what_they_are_made_of(self):
        self.assertEqual(self.found({
            "solvers/linalg/ordering.cpp": "#include <amd.h>\n#include <metis.h>\n",
            "solvers/cones/group.hpp": '#include "solvers/linalg/simd.hpp"\n',
            "solvers/presolve/draft.hpp": '#include "switchyard/problem.hpp"\n',
            "solvers/conic/form.hpp": '#include "solvers/presolve/presolve.hpp"\n'
                                      '#include "solvers/cones/kinds.hpp"\n'
                                      '#include "solvers/linalg/sparse.hpp"\n'}), [])

    def test_an_arrow_of_solvers_may_not_be_turned_round(self):
        self.assert_only(
            {"solvers/linalg/ldl.cpp": '#include "solvers/cones/kinds.hpp"\n'},
            "solvers/linalg/ldl.cpp:1: includes solvers/cones/kinds.hpp; linalg may know no other "
            "part of solvers, not cones")
        self.assert_only(
            {"solvers/cones/power.cpp": '#include "solvers/conic/form.hpp"\n'},
            "solvers/cones/power.cpp:1: includes solvers/conic/form.hpp; cones may know linalg, not "
            "conic")

    def test_solvers_keep_what_is_not_theirs_out(self):
        self.assertEqual(len(self.found({
            "solvers/conic/kkt.cpp": '#include <amd.h>\n#include <Highs.h>\n'
                                     '#include "core/host/host.hpp"\n'
                                     '#include "plugins/clp/clp.hpp"\n'})), 4)

    def test_nothing_but_benchmarks_knows_what_tests_share(self):
        wanted = '#include "tests/support/known_answers.hpp"\n'
        self.assertEqual(self.found({"benchmarks/runner/side_by_side.cpp": wanted}), [])
        self.assert_only(
            {"benchmarks/runner/waist.cpp": '#include "tests/host/scripted.hpp"\n'},
            "benchmarks/runner/waist.cpp:1: includes tests/host/scripted.hpp; benchmarks know of "
            "tests only tests/support")
        self.assertEqual(len(self.found({"core/host/host.cpp": wanted,
                                         "solvers/conic/kkt.cpp": wanted,
                                         "plugins/clp/clp.cpp": wanted})), 3)

    def test_a_part_that_is_not_in_the_table_is_named(self):
        self.assertEqual(len(self.found({"core/misc/a.cpp": "", "solvers/misc/a.cpp": ""})), 2)

    def test_what_is_built_or_fetched_is_not_looked_at(self):
        self.assertEqual(self.found({"build/core/host/a.cpp": "#include <Highs.h>\n"}), [])


class Lengths(Tree):
    def test_a_file_at_the_limit_passes_and_one_line_more_does_not(self):
        self.assertEqual(self.found({"core/io/a.hpp": "\n" * 300}), [])
        self.assert_only({"core/io/a.hpp": "\n" * 301},
                         "core/io/a.hpp: has 301 lines; a header has at most 300")
        self.assert_only({"plugins/clp/a.cpp": "\n" * 301},
                         "plugins/clp/a.cpp: has 301 lines; a plugin source has at most 300")

    def test_the_contract_has_no_limit(self):
        self.assertEqual(self.found({"include/switchyard/abi.h": "\n" * 700}), [])

    def test_a_function_at_the_limit_passes_and_one_line_more_does_not(self):
        self.assertEqual(self.found({"core/io/a.cpp": "void Read() " + body(58)}), [])
        self.assert_only({"core/io/a.cpp": "\nvoid Read() " + body(59)},
                         "core/io/a.cpp:2: the function Read has 61 lines; at most 60")


class Functions(unittest.TestCase):
    def lengths(self, text, suffix=".cpp"):
        return [(name, lines) for name, _, lines in functions(text, suffix)]

    def test_what_holds_functions_is_not_one(self):
        self.assertEqual(self.lengths(
            "namespace a {\nclass B : public C {\n public:\n  B() : x_(1) {}\n"
            "  int Get() const { return x_; }\n};\n"
            "template <class T>\n  requires(Big<T>)\nstruct D {\n  int x;\n};\n"
            "enum E { kF = 1 };\nconstexpr int kG[] = {1, 2};\n}  // namespace a\n"),
            [("B", 1), ("Get", 1)])

    def test_a_head_of_several_lines_counts(self):
        self.assertEqual(self.lengths("template <class T>\nint A(\n    T t) {\n  return t;\n}\n"),
                         [("A", 5)])

    def test_what_stands_before_a_function_does_not_count(self):
        self.assertEqual(self.lengths("class A {\n public:\n  // a comment {\n\n  A() {}\n};\n"),
                         [("A", 1)])

    def test_braces_in_comments_literals_and_directives_are_text(self):
        self.assertEqual(self.lengths(
            "#define OPEN() {\nint A() {\n  // }\n  Say(\"}\", '}', R\"(\n})\");\n"
            "  return 1'000;\n}\n"), [("A", 6)])

    def test_a_lambda_belongs_to_the_function_around_it(self):
        self.assertEqual(self.lengths("void A() {\n  F([&](int i) {\n    G(i);\n  });\n}\n"),
                         [("A", 5)])

    def test_what_may_follow_a_parameter_list(self):
        heads = ["int A() const noexcept ", "auto A() -> int ", "A() : a_(1), b_(2) ",
                 "int A(T t) requires Big<T> ", "A& operator=(A&&) & ", "TEST(Suite, A) "]
        for head in heads:
            self.assertEqual([n for _, n in self.lengths(head + body(1))], [3], head)

    def test_rust(self):
        self.assertEqual(self.lengths(
            "impl<'a> S<'a> {\n    fn solve(&self) -> i32 {\n        1\n    }\n}\n", ".rs"),
            [("solve", 3)])


if __name__ == "__main__":
    unittest.main()
