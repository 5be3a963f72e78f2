"""A gcs/1 graph as Drake's GraphOfConvexSets.

Each entry of the file's tables becomes one object of Drake, made once and shared by the vertices
and edges that name it. Of the ways Drake has for an entry, this is the fastest that leaves the
relaxation as strong as the file allows:

    linear cost                  LinearCost
    squared norm                 QuadraticCost, known to be convex
    norms                        L2NormCost, L1NormCost
    linear constraint            LinearEqualityConstraint where lb = ub, else LinearConstraint
    Lorentz cone                 LorentzConeConstraint
    intersection of constraints  Intersection of one HPolyhedron and, for each cone whose z_0 is a
                                 constant, a Hyperellipsoid; equalities, and cones whose z_0 is not
                                 constant, are constraints of the vertex
"""

import numpy as np
from pydrake.geometry.optimization import (
    GraphOfConvexSets, HPolyhedron, Hyperellipsoid, Hyperrectangle, Intersection, Point)
from pydrake.solvers import (
    Binding, Constraint, Cost, L1NormCost, L2NormCost, LinearConstraint, LinearCost,
    LinearEqualityConstraint, LorentzConeConstraint, QuadraticCost)


def vector(numbers):
    """Numbers, "inf" and "-inf" among them."""
    return np.array([float(number) for number in numbers])


def dense(matrix):
    a = np.zeros((matrix["rows"], matrix["cols"]))
    for i, j, value in matrix["entries"]:
        a[i, j] += float(value)
    return a


def ellipsoid(a, b):
    """{x : b_0 >= |A x + b|}, A and b but for row 0, which is 0 in A; None without an interior.

    With the least-squares center c, r = A c + b is orthogonal to the range of A, and so the square
    of the norm is |A (x - c)|^2 + |r|^2.
    """
    center = np.linalg.lstsq(a[1:], -b[1:], rcond=None)[0]
    rest = a[1:] @ center + b[1:]
    square = b[0] ** 2 - rest @ rest
    if b[0] <= 0 or square <= 0:
        return None
    return Hyperellipsoid(np.asfortranarray(a[1:] / np.sqrt(square)), center)


class Tables:
    """The tables of a file as objects of Drake, by their names in the file."""

    def __init__(self, file):
        self._matrices = {name: dense(matrix) for name, matrix in file["matrices"].items()}
        self._rows = file["constraints"]
        self.costs = {name: self._cost(one) for name, one in file["functions"].items()}
        self.constraints = {name: self._constraint(one) for name, one in self._rows.items()}
        self.sets, self.set_constraints = {}, {}
        for name, one in file["sets"].items():
            self.sets[name], self.set_constraints[name] = self._set(one)

    def _matrix(self, matrix):
        """By its name, or written out as rows."""
        return self._matrices[matrix] if isinstance(matrix, str) else np.array(matrix, dtype=float)

    def _cost(self, function):
        if function["type"] == "linear":
            return LinearCost(vector(function["a"]), float(function["b"]))
        a, b = self._matrix(function["A"]), vector(function["b"])
        if function["type"] == "squared_l2_norm":
            return QuadraticCost(2 * a.T @ a, 2 * a.T @ b, b @ b, True)
        return {"l2_norm": L2NormCost, "l1_norm": L1NormCost}[function["type"]](a, b)

    def _constraint(self, constraint):
        a = self._matrix(constraint["A"])
        if constraint["type"] == "lorentz_cone":
            return LorentzConeConstraint(a, vector(constraint["b"]))
        lower, upper = vector(constraint["lb"]), vector(constraint["ub"])
        if (lower == upper).all():
            return LinearEqualityConstraint(a, lower)
        return LinearConstraint(a, lower, upper)

    def _set(self, one):
        """A set, and the constraints on its vertex that say the rest of it."""
        if one["type"] == "point":
            return Point(vector(one["x"])), []
        if one["type"] == "hyperrectangle":
            return Hyperrectangle(vector(one["lb"]), vector(one["ub"])), []
        if one["type"] == "hpolyhedron":
            return HPolyhedron(self._matrix(one["A"]), vector(one["b"])), []
        if one["type"] == "hyperellipsoid":
            return Hyperellipsoid(self._matrix(one["A"]), vector(one["center"])), []
        return self._intersection(one)

    def _intersection(self, one):
        rows, sides = [np.zeros((0, one["dimension"]))], [np.zeros(0)]
        balls, rest = [], []
        for name in one["constraints"]:
            constraint = self.constraints[name]
            a = self._matrix(self._rows[name]["A"])
            if isinstance(constraint, LorentzConeConstraint):
                ball = None if a[0].any() else ellipsoid(a, constraint.b())
                (rest if ball is None else balls).append(constraint if ball is None else ball)
            elif isinstance(constraint, LinearEqualityConstraint):
                rest.append(constraint)
            else:
                lower, upper = constraint.lower_bound(), constraint.upper_bound()
                rows += [a[np.isfinite(upper)], -a[np.isfinite(lower)]]
                sides += [upper[np.isfinite(upper)], -lower[np.isfinite(lower)]]
        polyhedron = HPolyhedron(np.vstack(rows), np.concatenate(sides))
        return (Intersection([polyhedron, *balls]) if balls else polyhedron), rest


class DrakeGraph:
    """The graph with its `vertices` and `edges` in the order of the file, its source and target."""

    def __init__(self, file):
        tables = Tables(file)
        self.graph = GraphOfConvexSets()
        self.vertices = [self._vertex(tables, one) for one in file["vertices"]]
        self.edges = [self._edge(tables, one) for one in file["edges"]]
        self.source = self.vertices[file["source"]]
        self.target = self.vertices[file["target"]]

    def _vertex(self, tables, one):
        vertex = self.graph.AddVertex(tables.sets[one["set"]], one["name"])
        for name in one["costs"]:
            vertex.AddCost(Binding[Cost](tables.costs[name], vertex.x()))
        for constraint in tables.set_constraints[one["set"]]:
            vertex.AddConstraint(Binding[Constraint](constraint, vertex.x()))
        return vertex

    def _edge(self, tables, one):
        edge = self.graph.AddEdge(self.vertices[one["tail"]], self.vertices[one["head"]])
        both = np.concatenate([edge.xu(), edge.xv()])
        for name in one["costs"]:
            edge.AddCost(Binding[Cost](tables.costs[name], both))
        for name in one["constraints"]:
            edge.AddConstraint(Binding[Constraint](tables.constraints[name], both))
        return edge
