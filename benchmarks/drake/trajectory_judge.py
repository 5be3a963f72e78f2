"""What a trajectory costs and by how much it breaks its scenario, from the scenario and its control
points and durations alone. A scenario has at most one entry of `edges` for two subgraphs.

Violations are in units of q. A bound h^N lower <= d^N r <= h^N upper on a derivative's control
point, and the equality of two of them, is divided by the factor m! / (m - N)! that is before the
N-fold difference of the control points of a curve of order m.
"""

import math

NEAR = 1e-2  # a segment farther than that from a region is not one of it


# ---- Regions ----


def _outside(one, x):
    """The distance of x to the farthest side of a set that it is beyond."""
    if one["type"] == "polytope":
        return max((sum(a * xi for a, xi in zip(row, x)) - b) / (math.hypot(*row) or 1)
                   for row, b in zip(one["A"], one["b"]))
    lower, upper = (one["x"],) * 2 if one["type"] == "point" else (one["lower"], one["upper"])
    return max(max(l - xi, xi - u) for l, xi, u in zip(lower, x, upper))


def _all_outside(one, points):
    worst = 0.0
    for x in points:
        worst = max(worst, _outside(one, x))
        if worst > NEAR:
            break
    return worst


def _is_place(subgraph):
    return subgraph["order"] == 0 and subgraph["h_max"] == 0


def _with_places(scenario, segments):
    """With the source and the target, where they are points to pass and so no segments."""
    subgraphs = scenario["subgraphs"]
    before = [{"points": segments[0]["points"][:1], "duration": 0.0}]
    after = [{"points": segments[-1]["points"][-1:], "duration": 0.0}]
    return (before * _is_place(subgraphs[scenario["source"]]) + segments
            + after * _is_place(subgraphs[scenario["target"]]))


class _Ways:
    """Which region may follow which. A region is (subgraph, index)."""

    def __init__(self, scenario):
        self._pairs = {(s, s): one["pairs"] for s, one in enumerate(scenario["subgraphs"])}
        self.joins = {(one["from"], one["to"]): one for one in scenario["edges"]}
        self._pairs |= {ends: one["pairs"] for ends, one in self.joins.items()}
        self._pairs = {ends: pairs and set(map(tuple, pairs)) for ends, pairs in
                       self._pairs.items()}

    def lead(self, u, v):
        ends = (u[0], v[0])
        if ends not in self._pairs or u == v:
            return False
        return self._pairs[ends] is None or (u[1], v[1]) in self._pairs[ends]


def _regions(scenario, segments, ways):
    """(violation, region of each segment): those that the trajectory breaks least.

    The least over all walks from the source to the target, segment by segment.
    """
    best = {}
    for k, segment in enumerate(segments):
        found = {}
        for s, subgraph in enumerate(scenario["subgraphs"]):
            if (subgraph["order"] != len(segment["points"]) - 1
                    or (k == 0 and s != scenario["source"])
                    or (k == len(segments) - 1 and s != scenario["target"])):
                continue
            for r, one in enumerate(subgraph["regions"]):
                outside = _all_outside(one, segment["points"])
                if outside <= NEAR:
                    before = [way for u, way in best.items() if ways.lead(u, (s, r))]
                    if k == 0 or before:
                        worst, walk = min(before, default=(0.0, []))
                        found[s, r] = (max(worst, outside), [*walk, (s, r)])
        best = found
        if not best:
            raise ValueError(f"segment {k} is in no region that may come there")
    return min(best.values())


# ---- Derivatives ----


def _differences(points, k):
    """The k-fold forward differences, one for each control point of the k-th derivative."""
    for _ in range(k):
        points = [[b - a for a, b in zip(p, q)] for p, q in zip(points, points[1:])]
    return points


def _factor(segment, k):
    return math.perm(len(segment["points"]) - 1, k)


def _beyond(term, segment, points):
    """By how much some control points of a derivative, as differences, are beyond bounds."""
    k = term.get("order", 1)
    scale = segment["duration"] ** k / _factor(segment, k)
    return max(max(scale * l - x, x - scale * u) for point in points
               for l, x, u in zip(term["lower"], point, term["upper"]))


def _segment_violation(terms, segment):
    bounds = [term for term in terms if term["type"] in ("velocity_bounds", "derivative_bounds")
              and term.get("order", 1) < len(segment["points"])]
    return max((_beyond(term, segment, _differences(segment["points"], term.get("order", 1)))
                for term in bounds), default=0.0)


def _jump(u, v, k, by_time):
    """Of the k-th derivative, from the end of u to the start of v."""
    scales = [_factor(one, k) / (one["duration"] ** k if by_time else 1) for one in (u, v)]
    ends = zip(_differences(u["points"], k)[-1], _differences(v["points"], k)[0])
    return max(abs(scales[0] * a - scales[1] * b) for a, b in ends) / max(scales)


def _joint_violation(terms, u, v):
    worst = 0.0
    for term in terms:
        k = term.get("order", 1)
        sides = [(one, end) for one, end in ((u, -1), (v, 0)) if len(one["points"]) > k]
        if term["type"] in ("path_continuity", "continuity") and len(sides) == 2:
            worst = max(worst, _jump(u, v, k, term["type"] == "continuity"))
        for one, end in sides:
            point = _differences(one["points"], k)[end]
            if term["type"] == "zero_derivatives":
                worst = max(worst, *map(abs, point))
            elif term["type"] in ("velocity_bounds", "derivative_bounds"):
                worst = max(worst, _beyond(term, one, [point]))
    return worst


# ---- The whole ----


def _gap(scenario, u, v):
    """Between the end of u and the start of v, modulo 2 pi on continuous joints."""
    apart = [b - a for a, b in zip(u["points"][-1], v["points"][0])]
    for j in scenario["continuous_joints"]:
        apart[j] = math.remainder(apart[j], 2 * math.pi)
    return max(map(abs, apart))


def _cost(terms, segment):
    legs = [math.hypot(*leg) for leg in _differences(segment["points"], 1)]
    measures = {"time_cost": segment["duration"], "length_cost": sum(legs),
                "energy_cost": sum(leg * leg for leg in legs)}
    return sum(term["weight"] * measures[term["type"]] for term in terms
               if term["type"] in measures)


def judge(scenario, segments):
    """(cost, violations by name) of `segments`, each with `points` (order + 1 rows) and `duration`.

    Raises ValueError where they are no walk through the regions from the source to the target.
    """
    if not segments:
        raise ValueError("there is no segment")
    segments = _with_places(scenario, segments)
    ways = _Ways(scenario)
    outside, walk = _regions(scenario, segments, ways)
    broken = {"regions": outside, "durations": 0.0, "bounds": 0.0, "joints": 0.0,
              "continuity": 0.0}
    cost = 0.0
    for (s, _), one in zip(walk, segments):
        subgraph = scenario["subgraphs"][s]
        terms = scenario["terms"] + subgraph["terms"]
        cost += _cost(terms, one)
        h = one["duration"]
        broken["durations"] = max(broken["durations"], subgraph["h_min"] - h, h - subgraph["h_max"])
        broken["bounds"] = max(broken["bounds"], _segment_violation(terms, one))
    for (s, _), (t, _), u, v in zip(walk, walk[1:], segments, segments[1:]):
        broken["joints"] = max(broken["joints"], _gap(scenario, u, v))
        join = scenario["subgraphs"][s] if s == t else ways.joins[s, t]
        if join.get("subspace"):
            broken["regions"] = max(broken["regions"], _outside(join["subspace"], u["points"][-1]))
        broken["continuity"] = max(broken["continuity"],
                                   _joint_violation(scenario["terms"] + join["terms"], u, v))
    return cost, broken
