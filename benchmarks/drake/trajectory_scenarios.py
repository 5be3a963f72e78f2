"""The scenarios of compare_trajectories, each written once, as data that both sides read.

    {"name", "num_positions", "continuous_joints": [joint],
     "subgraphs": [{"name", "regions": [set], "order", "h_min", "h_max", "pairs", "terms"}],
     "edges": [{"from", "to", "subspace": set or null, "pairs", "terms"}],
     "terms", "source", "target", "nonlinear", "relaxation_is_one"}

A set is {"type": "box", "lower", "upper"}, {"type": "polytope", "A", "b"} (A x <= b) or {"type":
"point", "x"}. `pairs` are pairs of regions with an edge from the first to the second; null: those
that meet, which each side finds by itself. A term is one of

    {"type": "time_cost" | "length_cost" | "energy_cost", "weight"}
    {"type": "velocity_bounds", "lower", "upper"}
    {"type": "derivative_bounds", "order", "lower", "upper"}
    {"type": "path_continuity" | "continuity" | "zero_derivatives", "order"}

`nonlinear`: Ipopt solves the restrictions. `relaxation_is_one`: what Drake solves is a relaxation;
it is not where it has a surrogate for a nonlinear term.

Where Drake is known to mean another thing than it says, scenarios keep to what both mean: energy
has the weight 1 (Drake squares it), derivative bounds are asked of subgraphs and not of edges
between them (Drake takes the wrong duration), subspaces have no part in continuous joints (Drake
has a wrong sign), and no bound is infinite (Drake throws).
"""

import gzip
import json
import math
import random


def box(lower, upper):
    return {"type": "box", "lower": lower, "upper": upper}


def point(*x):
    return {"type": "point", "x": list(x)}


def box_rows(lower, upper):
    """A box as a polytope."""
    unit = [[float(i == j) for j in range(len(lower))] for i in range(len(lower))]
    return {"type": "polytope", "A": unit + [[-a for a in row] for row in unit],
            "b": list(upper) + [-a for a in lower]}


def costs(time=0.0, length=0.0, energy=0.0):
    weights = {"time_cost": time, "length_cost": length, "energy_cost": energy}
    return [{"type": name, "weight": weight} for name, weight in weights.items() if weight > 0]


def velocity(limits):
    return {"type": "velocity_bounds", "lower": [-v for v in limits], "upper": list(limits)}


def orders(kind, last):
    return [{"type": kind, "order": k} for k in range(1, last + 1)]


def subgraph(name, regions, order, h_min, h_max, pairs=None, terms=()):
    return {"name": name, "regions": regions, "order": order, "h_min": h_min, "h_max": h_max,
            "pairs": pairs, "terms": list(terms)}


def place(name, x):
    """A point to pass, of order 0 and without time."""
    return subgraph(name, [point(*x)], 0, 0, 0, pairs=[])


def joined(source, target, pairs=None, subspace=None, terms=()):
    return {"from": source, "to": target, "subspace": subspace, "pairs": pairs,
            "terms": list(terms)}


def scenario(num_positions, rooms, start, goal, terms, ends=(), **rest):
    """From a point to a point through one subgraph; `ends` are terms of the edges at both."""
    pairs = rest.pop("end_pairs", (None, None))
    return {"num_positions": num_positions, "continuous_joints": [],
            "subgraphs": [rooms, place("start", start), place("goal", goal)],
            "edges": [joined(1, 0, pairs[0], terms=ends), joined(0, 2, pairs[1], terms=ends)],
            "terms": terms, "source": 1, "target": 2, "nonlinear": False,
            "relaxation_is_one": True} | rest


# ---- From the instances ----


def _graph(instances, name):
    return json.loads(gzip.decompress((instances / "gcs" / f"{name}.json.gz").read_bytes()))


def _dense(matrix):
    rows = [[0.0] * matrix["cols"] for _ in range(matrix["rows"])]
    for i, j, value in matrix["entries"]:
        rows[i][j] += float(value)
    return rows


def _ends(graph):
    vertices = [graph["vertices"][graph[end]] for end in ("source", "target")]
    return [graph["sets"][vertex["set"]]["x"] for vertex in vertices]


def iiwa14(instances, task):
    """The arm through its polytopes of configurations."""
    graph = _graph(instances, f"iiwa14_{task}")
    regions = [{"type": "polytope", "A": _dense(graph["matrices"][one["A"]]), "b": one["b"]}
               for one in graph["sets"].values() if one["type"] == "hpolyhedron"]
    limits = [1.4835, 1.4835, 1.7453, 1.309, 2.2689, 2.3562, 2.3562]  # of the arm, rad/s
    return scenario(7, subgraph("regions", regions, 3, 1e-2, 20), *_ends(graph),
                    [*costs(time=1, length=1), velocity(limits), *orders("path_continuity", 1)])


def quadrotor(instances, number):
    """Rooms of a building: the boxes that hold every control point of the instance, and its edges.

    Edges are given since rooms touch: two with a corner in common meet or not by the last digit.
    """
    graph = _graph(instances, f"quadrotor_building_{number}")
    regions, index = [], {}
    for v, vertex in enumerate(graph["vertices"]):
        one = graph["sets"][vertex["set"]]
        if one["type"] == "hpolyhedron":
            sides = {1.0: [math.inf] * 3, -1.0: [math.inf] * 3}
            for i, j, value in graph["matrices"][one["A"]]["entries"]:
                if j < 3:  # the first control point
                    sides[value][j] = min(sides[value][j], one["b"][i])
            index[v] = len(regions)
            regions.append(box([-b for b in sides[-1.0]], sides[1.0]))
    ways = [(edge["tail"], edge["head"]) for edge in graph["edges"]]
    return scenario(3, subgraph("rooms", regions, 7, 1e-2, 20,
                                [[index[u], index[v]] for u, v in ways if {u, v} <= index.keys()]),
                    *_ends(graph),
                    [*costs(time=1, length=1), velocity([10] * 3), *orders("path_continuity", 4)],
                    ends=orders("zero_derivatives", 3),
                    end_pairs=([[0, index[v]] for u, v in ways if u == graph["source"]],
                               [[index[u], 0] for u, v in ways if v == graph["target"]]))


# ---- Generated ----


def maze(size):
    """A spanning tree of cells, by depth-first search, and one more opening for 25 cells."""
    draw = random.Random(size)
    cells = [(i, j) for i in range(size) for j in range(size)]
    neighbours = {(i, j): [(a, b) for a, b in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1))
                           if 0 <= a < size and 0 <= b < size] for i, j in cells}
    seen, stack, open_walls = {(0, 0)}, [(0, 0)], set()
    while stack:
        ways = [cell for cell in neighbours[stack[-1]] if cell not in seen]
        if not ways:
            stack.pop()
            continue
        cell = draw.choice(ways)
        open_walls.add(frozenset((stack[-1], cell)))
        seen.add(cell)
        stack.append(cell)
    walls = sorted({tuple(sorted((one, other))) for one in cells for other in neighbours[one]
                    if frozenset((one, other)) not in open_walls})
    open_walls |= {frozenset(wall) for wall in draw.sample(walls, size * size // 25)}
    index = {cell: k for k, cell in enumerate(cells)}
    pairs = sorted([index[one], index[other]] for wall in open_walls
                   for one, other in (tuple(wall), tuple(wall)[::-1]))
    regions = [box([i, j], [i + 1, j + 1]) for i, j in cells]
    return scenario(2, subgraph("cells", regions, 6, 1e-2, 20, pairs), [0.5, 0.5],
                    [size - 0.5, size - 0.5],
                    [*costs(time=1), velocity([1, 1]), *orders("path_continuity", 2)],
                    end_pairs=([[0, 0]], [[len(cells) - 1, 0]]))


def _tiles(columns, rows, at=(0.0, 0.0), seed=1, height=()):
    """Boxes of side 1.2 to 1.4 about the points of a grid of step 1, with gaps: one in six is left
    out, but for the first and the last."""
    draw = random.Random(seed)
    tiles = []
    for i in range(columns):
        for j in range(rows):
            half = 0.5 * draw.uniform(1.2, 1.4)
            if draw.random() < 5 / 6 or (i, j) in ((0, 0), (columns - 1, rows - 1)):
                tiles.append(box([at[0] + i - half, at[1] + j - half, *(-h for h in height)],
                                 [at[0] + i + half, at[1] + j + half, *height]))
    return tiles


def two_subgraphs(subspace):
    """Order 3 below, order 5 above, and one way from the one to the other."""
    terms = [*costs(time=1, length=1), velocity([1, 1])]
    slow = {"type": "velocity_bounds", "lower": [-0.2, -0.1], "upper": [0.2, 0.1]}
    return {"num_positions": 2, "continuous_joints": [],
            "subgraphs": [subgraph("below", _tiles(6, 3, seed=3), 3, 1e-2, 20,
                                   terms=orders("path_continuity", 1)),
                          subgraph("above", _tiles(6, 3, at=(0.3, 3.0), seed=4), 5, 1e-2, 20,
                                   terms=orders("path_continuity", 2)),
                          place("start", [0, 0]), place("goal", [5.3, 5])],
            "edges": [joined(2, 0), joined(0, 1, subspace=subspace, terms=[slow]), joined(1, 3)],
            "terms": terms, "source": 2, "target": 3, "nonlinear": False,
            "relaxation_is_one": True}


def continuous_joints():
    """Two joints that turn without limits and one that does not; the short way crosses 2 pi."""
    step = 2 * math.pi / 6
    half = 0.6 * step
    blocked = {(3, 3), (2, 3), (3, 4), (0, 1), (1, 1), (5, 4), (4, 0)}
    regions = [box([i * step - half, j * step - half, -1], [i * step + half, j * step + half, 1])
               for i in range(6) for j in range(6) if (i, j) not in blocked]
    return scenario(3, subgraph("regions", regions, 3, 1e-2, 20), [0.1, 0.1, -0.5],
                    [4 * step + 0.2, 4 * step - 0.1, 0.5],
                    [*costs(time=1, length=1), velocity([1, 1.5, 1]),
                     *orders("path_continuity", 1)], continuous_joints=[0, 1])


def energy():
    return scenario(3, subgraph("rooms", _tiles(7, 7, height=[0.5]), 4, 1e-2, 20), [0, 0, 0.3],
                    [6, 6, -0.3], [*costs(time=0.2, energy=1), velocity([1] * 3),
                                   *orders("path_continuity", 1)])


def acceleration():
    """From rest to rest."""
    limits = {"type": "derivative_bounds", "order": 2, "lower": [-1, -1], "upper": [1, 1]}
    rooms = subgraph("rooms", _tiles(5, 5), 5, 0.2, 5, terms=[limits])
    return scenario(2, rooms, [0, 0], [4, 4], [*costs(time=1, length=0.1), velocity([1, 1]),
                                               *orders("path_continuity", 1)],
                    ends=orders("zero_derivatives", 1), nonlinear=True, relaxation_is_one=False)


def time_continuity():
    rooms = subgraph("rooms", _tiles(5, 5, seed=2), 5, 0.2, 5, terms=orders("continuity", 2))
    return scenario(2, rooms, [0, 0], [4, 4], [*costs(time=1, length=0.5), velocity([1, 1])],
                    nonlinear=True, relaxation_is_one=False)


def thousand():
    """1,000 boxes about a grid, 2,500 pairs of neighbours, an edge each way."""
    draw = random.Random(1)
    columns, rows = 40, 25
    regions = []
    for i in range(columns):
        for j in range(rows):
            x, y = i + draw.uniform(-0.1, 0.1), j + draw.uniform(-0.1, 0.1)
            regions.append(box([x - 0.7, y - 0.7], [x + 0.7, y + 0.7]))
    straight = [(rows * i + j, rows * (i + a) + j + b) for i in range(columns) for j in range(rows)
                for a, b in ((1, 0), (0, 1)) if i + a < columns and j + b < rows]
    oblique = [(rows * i + j, rows * (i + 1) + j + 1) for i in range(columns - 1)
               for j in range(rows - 1)]
    chosen = straight + draw.sample(oblique, 2500 - len(straight))
    pairs = sorted([one, other] for pair in chosen for one, other in (pair, pair[::-1]))
    return scenario(2, subgraph("regions", regions, 3, 1e-2, 20, pairs), [0, 0],
                    [columns - 1, rows - 1], [*costs(time=1, length=1), velocity([1, 1]),
                                              *orders("path_continuity", 1)],
                    end_pairs=([[0, 0]], [[len(regions) - 1, 0]]))


def two_rooms():
    """So small that its answer is known: 2 along each axis at no more than 1 a second, and the
    straight line is in both rooms. It comes before what is measured."""
    rooms = subgraph("rooms", [box([0, 0], [1, 1]), box([1, 1], [2, 2])], 3, 1e-2, 20)
    return scenario(2, rooms, [0, 0], [2, 2], [*costs(time=1, length=1), velocity([1, 1]),
                                               *orders("path_continuity", 1)])


def scenarios(instances):
    """By name, in the order of the table: what makes each."""
    made = {f"iiwa14_{task}": lambda task=task: iiwa14(instances, task)
            for task in ("AS_TS", "CS_LB", "TS_CS")}
    made |= {f"quadrotor_{number}": lambda number=number: quadrotor(instances, number)
             for number in range(5)}
    made |= {"maze_20": lambda: maze(20), "maze_50": lambda: maze(50)}
    made |= {"two_subgraphs_point": lambda: two_subgraphs(point(3.5, 2.6)),
             "two_subgraphs_polytope": lambda: two_subgraphs(box_rows([3.2, 2.4], [3.6, 2.6]))}
    made |= {one.__name__: one for one in (continuous_joints, energy, acceleration,
                                           time_continuity, thousand)}
    return made
