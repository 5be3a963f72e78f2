#!/usr/bin/env python3
"""Generates graphs of convex sets and plans through them as a user does.

    plan_test.py --source SOURCE --program PROGRAM [unittest arguments]

Cases that need a backend which is not built are skipped with a word.
"""

import hashlib
import json
import re
import unittest
import xml.etree.ElementTree

import command_line_test
from command_line_test import ANSWERED, BAD_INPUT, FIELDS, NOT_ANSWERED, CommandLine

SVG = "{http://www.w3.org/2000/svg}"
LINEAR = ("highs", "clp", "clarabel")  # with duals, so that a bound is proven
PLAN_FIELDS = FIELDS | {"relaxation", "path", "edges", "points", "rounded", "pruned", "gap"}

class Planning(CommandLine):
    @property
    def choice(self):
        """From start over a triangle or an ellipse to goal; the triangle is on the line."""
        return json.loads((self.source / "examples" / "graphs" / "choice.json").read_text())

    def generate(self, family, *arguments):
        path = self.folder / f"{family}.json"
        self.expect(self.run_program("generate", family, *arguments, "-o", path), ANSWERED)
        return path, json.loads(path.read_text())

    def plan(self, *arguments, code=ANSWERED, **more):
        """The result/1 of a plan."""
        done = self.expect(self.run_program("plan", *arguments, "--json", "-", **more), code)
        return json.loads(done.stdout)

    def changed(self, **fields):
        return self.file("changed.json", json.dumps(self.choice | fields))


def boxes(graph):
    """The boxes of the vertices, points as boxes without extent."""
    found = []
    for vertex in graph["vertices"]:
        of = graph["sets"][vertex["set"]]
        found.append((of["x"], of["x"]) if of["type"] == "point" else (of["lb"], of["ub"]))
    return found


def common(a, b):
    """The extents of what two boxes have in common."""
    return [min(a[1][k], b[1][k]) - max(a[0][k], b[0][k]) for k in range(2)]


class Generating(Planning):
    def test_a_seed_makes_the_same_graph_on_every_machine(self):
        for family, digest in (("maze", "2131ad3dd5df3026"), ("building", "a0b9c027d9cc367c")):
            _, graph = self.generate(family, "--size", 12, "--seed", 5)
            shape = [boxes(graph), [(e["tail"], e["head"]) for e in graph["edges"]]]
            self.assertEqual(hashlib.sha256(json.dumps(shape).encode()).hexdigest()[:16], digest)
            first = (self.folder / f"{family}.json").read_bytes()
            self.generate(family, "--size", 12, "--seed", 5)
            self.assertEqual((self.folder / f"{family}.json").read_bytes(), first)
            _, other = self.generate(family, "--size", 12, "--seed", 6)
            self.assertNotEqual(boxes(graph) + graph["edges"], boxes(other) + other["edges"])

    def test_every_place_can_be_reached_and_left(self):
        for family, size, least in (("maze", 15, 225), ("building", 90, 90)):
            with self.subTest(family=family):
                _, graph = self.generate(family, "--size", size, "--seed", 3)
                self.assertGreaterEqual(len(graph["vertices"]), least)
                ends = {graph["source"], graph["target"]}
                pairs = {(e["tail"], e["head"]) for e in graph["edges"]}
                inner = {pair for pair in pairs if not ends & set(pair)}
                self.assertEqual(inner, {(v, u) for u, v in inner})
                reached, waiting = {graph["source"]}, [graph["source"]]
                while waiting:
                    at = waiting.pop()
                    fresh = {v for u, v in pairs if u == at} - reached
                    reached |= fresh
                    waiting += fresh
                self.assertEqual(len(reached), len(graph["vertices"]))

    def test_what_an_edge_joins_meets_in_a_line_and_rooms_do_not_overlap(self):
        _, graph = self.generate("building", "--size", 70, "--seed", 9)
        places = boxes(graph)
        ends = {graph["source"], graph["target"]}
        for edge in graph["edges"]:
            if ends & {edge["tail"], edge["head"]}:
                continue
            extents = sorted(common(places[edge["tail"]], places[edge["head"]]))
            self.assertEqual(extents, [0, 1])
        inner = [box for k, box in enumerate(places) if k not in ends]
        for i, a in enumerate(inner):
            for b in inner[:i]:
                self.assertLessEqual(min(common(a, b)), 0)

    def test_a_size_out_of_range(self):
        done = self.run_program("generate", "maze", "--size", 1, "-o", "-")
        self.expect(done, BAD_INPUT)
        self.assertIn("--size needs 2 to 5000 cells along each side, got 1", done.stderr)
        self.expect(self.run_program("generate", "tower", "-o", "-"), BAD_INPUT)


class Paths(Planning):
    def setUp(self):
        super().setUp()
        self.need("relax-and-round")

    def check_path(self, graph, result):
        """The path is one of the graph, its points lie in its sets, its cost is theirs."""
        places = boxes(graph)
        edges = [graph["edges"][k] for k in result["edges"]]
        vertices = [edges[0]["tail"]] + [edge["head"] for edge in edges]
        self.assertEqual([graph["source"], graph["target"]], [vertices[0], vertices[-1]])
        self.assertEqual([edge["tail"] for edge in edges], vertices[:-1])
        self.assertEqual(result["path"], [graph["vertices"][v]["name"] for v in vertices])
        cost = 0
        for v, x, before in zip(vertices, result["points"], [None] + result["points"]):
            lower, upper = places[v]
            for k in range(2):
                self.assertGreater(x[k], lower[k] - 1e-6)
                self.assertLess(x[k], upper[k] + 1e-6)
            cost += sum(abs(x[k] - before[k]) for k in range(2)) if before else 0
        self.assertAlmostEqual(result["objective"], cost, delta=1e-6 * cost)
        self.assertLessEqual(result["bound"], cost * (1 + 1e-9))

    def test_backends_agree_on_the_bound_and_find_a_way(self):
        self.any_of(*LINEAR)
        path, graph = self.generate("building", "--cost", "linear", "--seed", 2)
        bounds = []
        for backend in LINEAR:
            if backend not in self.backends:
                continue
            with self.subTest(backend=backend):
                result = self.plan(path, "--solver", backend)
                self.assertIn(result["termination"], ("optimal", "locally_optimal"))
                self.assertLessEqual(PLAN_FIELDS, set(result))
                self.assertEqual(result["command"], "plan")
                self.assertEqual(len(result["subsolvers"]), 1)
                self.assertTrue(result["subsolvers"][0].endswith(backend))
                self.assertLess(result["pruned"]["edges_after"], result["pruned"]["edges_before"])
                self.assertEqual(result["pruned"]["edges_before"], len(graph["edges"]))
                costs = [tried["cost"] for tried in result["rounded"] if tried["cost"] is not None]
                self.assertAlmostEqual(min(costs), result["objective"], delta=1e-6 * min(costs))
                self.check_path(graph, result)
                bounds.append(result["bound"])
        self.assertLess(max(bounds) - min(bounds), 1e-5 * max(bounds))

    def test_a_seed_and_any_number_of_threads_give_the_same_answer(self):
        backend = self.any_of("clp", "highs")
        path, _ = self.generate("building", "--cost", "linear", "--size", 40)
        answers = [self.plan(path, "--solver", backend, "--seed", 4, "--threads", threads)
                   for threads in (1, 2, 2)]
        for field in ("path", "points", "objective", "bound", "rounded"):
            self.assertEqual(answers[0][field], answers[1][field])
            self.assertEqual(answers[1][field], answers[2][field])

    def test_the_relaxation_alone_is_a_bound(self):
        backend = self.any_of("clp", "highs")
        path, _ = self.generate("maze", "--cost", "linear", "--size", 8)
        bound = self.plan(path, "--solver", backend, "--relaxation")
        self.assertEqual(bound["termination"], "optimal")
        self.assertNotIn("path", bound)
        self.assertEqual(bound["rounded"], [])
        whole = self.plan(path, "--solver", backend)
        self.assertAlmostEqual(bound["relaxation"]["cost"], whole["relaxation"]["cost"], delta=1e-6)
        self.assertLessEqual(bound["bound"], whole["objective"] + 1e-6)

    def test_length_by_a_conic_backend(self):
        self.need("clarabel")
        result = self.plan(self.changed(), "--solver", "clarabel")
        self.assertEqual(result["termination"], "optimal")
        self.assertEqual(result["path"], ["start", "below", "goal"])
        self.assertEqual(result["edges"], [2, 3])
        self.assertAlmostEqual(result["objective"], 4, delta=1e-6)

    def test_in_words(self):
        backend = self.any_of("clp", "highs")
        path, _ = self.generate("maze", "--cost", "linear", "--size", 12)
        done = self.expect(self.run_program("plan", path, "--solver", backend), ANSWERED)
        for line in (r"graph +146 vertices, \d+ edges, \d+ after pruning", r"relaxation +\d",
                     r"bound +\d", r"cost +\d", r"path +start cell0_0 .* more \.\.\. .* goal \("):
            self.assertRegex(done.stdout, rf"(?m)^{line}")
        quiet = self.expect(self.run_program("plan", path, "--quiet"), ANSWERED)
        self.assertEqual(quiet.stdout + quiet.stderr, "")

    def test_the_solution_has_points_and_flows(self):
        self.need("clarabel")
        solution = self.folder / "solution.json"
        self.plan(self.changed(), "--solution", solution)
        values = json.loads(solution.read_text())["variables"]
        self.assertAlmostEqual(values["goal.x[0]"], 4, delta=1e-6)
        self.assertEqual(sum(name.endswith(".flow") for name in values), 2)
        self.assertNotIn("above.x[0]", values)


class Refusals(Planning):
    def test_a_target_that_no_edges_lead_to_is_a_mistake_of_the_file(self):
        path = self.changed(edges=self.choice["edges"][:1])
        done = self.expect(self.run_program("plan", path), BAD_INPUT)
        self.assertIn("/target: needs a vertex that edges lead to from start, got goal",
                      done.stderr)

    def test_a_set_without_a_point_is_a_mistake_of_the_file(self):
        sets = dict(self.choice["sets"])
        name = next(iter(sets))
        sets[name] = {"type": "hpolyhedron", "A": "empty", "b": [0, -1]}
        entries = [[0, 0, 1], [1, 0, -1]]
        matrices = dict(self.choice.get("matrices", {}),
                        empty={"rows": 2, "cols": 2, "entries": entries})
        path = self.changed(sets=sets, matrices=matrices)
        done = self.expect(self.run_program("plan", path), BAD_INPUT)
        self.assertIn(f"/sets/{name}: needs a set that has a point, got an empty one", done.stderr)

    def test_bad_files_are_refused_with_the_place(self):
        sets = self.choice["sets"]
        edges = [dict(edge) for edge in self.choice["edges"]]
        edges[1]["costs"] = ["lenght"]
        for fields, said in (({"target": 9}, "/target: "),
                             ({"edges": edges}, "/edges/1/costs/0: "),
                             ({"sets": sets | {"goal": {"type": "point", "x": [4]}}}, "/edges/"),
                             ({"sets": sets | {"goal": {"type": "pint", "x": [4, 0]}}},
                              "/sets/goal/type: ")):
            done = self.expect(self.run_program("plan", self.changed(**fields)), BAD_INPUT)
            self.assertIn(said, done.stderr)
        done = self.run_program("plan", self.file("cut.json", '{"format": "gcs/1",\n "name": }'))
        self.expect(done, BAD_INPUT)
        self.assertRegex(done.stderr, r"cut\.json:2:10: expected ")

    def test_bad_usage(self):
        path = self.changed()
        for usage, said in ((["--relaxation", "--round"], "excludes"),
                            (["--paths", "0"], "--paths"),
                            (["--picture", "x.png"], 'needs a file that ends in .svg, got "x.png"'),
                            (["--seed", "5000000000"], "--seed needs 0 to 2147483647")):
            done = self.expect(self.run_program("plan", path, *usage), BAD_INPUT)
            self.assertIn(said, done.stderr)

    def test_no_backend_is_not_answered(self):
        path = self.changed()
        done = self.run_program("plan", path, "--solver", "none-of-these")
        self.expect(done, NOT_ANSWERED)
        self.assertIn("no_backend: --solver none-of-these: there is no such backend", done.stderr)


class Pictures(Planning):
    def setUp(self):
        super().setUp()
        self.need("relax-and-round")

    def draw(self, path, *arguments):
        """What is drawn, by class (the legend is a group of its own); the size; the whole."""
        drawn = self.folder / "picture.svg"
        self.plan(path, "--picture", drawn, *arguments)
        root = xml.etree.ElementTree.parse(drawn).getroot()
        size = [float(root.get("width")), float(root.get("height"))]
        return {kind: [e for e in root if e.get("class") == kind]
                for kind in ("s", "f", "p", "d", "a", "b")}, size, root

    def points(self, element):
        return [tuple(map(float, pair.split())) for pair in re.split("[MLZ]", element.get("d"))
                if pair]

    def test_sets_of_the_plane_are_drawn_as_they_are(self):
        self.need("conic")
        parts, size, root = self.draw(self.changed())
        polygon, ellipse = parts["s"]
        self.assertEqual(polygon.tag, SVG + "path")
        self.assertEqual(polygon.find(SVG + "title").text, "below")
        corners = sorted(self.points(polygon))
        (start, goal), (x, y) = self.points(parts["p"][0])[::2], (0, 1)
        scale = (goal[x] - start[x]) / 4
        # y - x <= -2, x + y <= 2, y >= -2: the corners (2, 0), (0, -2), (4, -2).
        for corner, at in zip(corners, ((0, -2), (2, 0), (4, -2))):
            self.assertAlmostEqual(corner[x], start[x] + scale * at[x], delta=0.3)
            self.assertAlmostEqual(corner[y], start[y] - scale * at[y], delta=0.3)
        self.assertEqual(ellipse.tag, SVG + "ellipse")
        radii = sorted((float(ellipse.get("rx")), float(ellipse.get("ry"))))
        self.assertAlmostEqual(radii[0], scale / 2, delta=0.1)
        self.assertAlmostEqual(radii[1], scale, delta=0.1)
        self.assertEqual(len(parts["d"]), 3)
        words = " ".join(e.text for e in root.iter(SVG + "text"))
        for word in ("choice", "optimal", "cost 4", "bound", "relax-and-round", "conic"):
            self.assertIn(word, words)

    def test_all_that_is_drawn_is_on_the_canvas(self):
        backend = self.any_of("clp", "highs")
        path, _ = self.generate("building", "--cost", "linear")
        parts, (width, height), _ = self.draw(path, "--solver", backend)
        for kind in ("s", "f", "p"):
            self.assertTrue(parts[kind])
            for element in parts[kind]:
                for x, y in self.points(element):
                    self.assertTrue(0 <= x <= width and 0 <= y <= height, (x, y))
        source, target = parts["a"][0], parts["b"][0]  # from the lower left to the upper right
        self.assertLess(float(source.get("cx")), float(target.get("x")))
        self.assertGreater(float(source.get("cy")), float(target.get("y")))

    def test_a_picture_of_many_edges_is_small(self):
        backend = self.any_of("clp", "highs")
        path, graph = self.generate("maze", "--cost", "linear", "--size", 50)
        self.assertGreater(len(graph["edges"]), 5000)
        self.draw(path, "--solver", backend)
        self.assertLess((self.folder / "picture.svg").stat().st_size, 400_000)

    def test_the_relaxation_and_no_way_are_drawn_too(self):
        self.need("clarabel")
        parts, _, _ = self.draw(self.changed(), "--relaxation")
        self.assertTrue(parts["f"])
        self.assertFalse(parts["p"])
        far = {"far": {"type": "linear", "A": "difference", "lb": [9, 9], "ub": [9, 9]}}
        edges = [dict(edge, constraints=["far"]) for edge in self.choice["edges"]]
        parts, _, _ = self.draw(self.changed(constraints=far, edges=edges))
        self.assertEqual([len(parts[kind]) for kind in "sfpab"], [2, 0, 0, 1, 1])


if __name__ == "__main__":
    command_line_test.main()
