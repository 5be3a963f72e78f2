"""What a path costs and by how much it breaks its constraints, from the gcs/1 file alone."""

import math


def _sparse(file, matrix):
    """Rows of (column, value), of a matrix by its name or written out."""
    if isinstance(matrix, str):
        table = file["matrices"][matrix]
        rows = [[] for _ in range(table["rows"])]
        for i, j, value in table["entries"]:
            rows[i].append((j, float(value)))
        return rows
    return [[(j, float(value)) for j, value in enumerate(row)] for row in matrix]


def _image(file, one, x, offset):
    """A x + offset."""
    return [sum(value * x[j] for j, value in row) + float(b)
            for row, b in zip(_sparse(file, one["A"]), offset)]


def _value(file, function, x):
    if function["type"] == "linear":
        return sum(float(a) * xi for a, xi in zip(function["a"], x)) + float(function["b"])
    z = _image(file, function, x, function["b"])
    return {"l2_norm": math.hypot(*z), "l1_norm": sum(map(abs, z)),
            "squared_l2_norm": sum(zi * zi for zi in z)}[function["type"]]


def _outside(lower, z, upper):
    return max((max(float(l) - zi, zi - float(u), 0.0) for l, zi, u in zip(lower, z, upper)),
               default=0.0)


def _broken(file, constraint, x):
    if constraint["type"] == "lorentz_cone":
        z = _image(file, constraint, x, constraint["b"])
        return max(0.0, math.hypot(*z[1:]) - z[0])
    z = _image(file, constraint, x, [0] * len(constraint["lb"]))
    return _outside(constraint["lb"], z, constraint["ub"])


def _distance(file, one, x):
    """By how much x breaks the description of a set, absolute, as it stands in the file."""
    if one["type"] == "point":
        return _outside(one["x"], x, one["x"])
    if one["type"] == "hyperrectangle":
        return _outside(one["lb"], x, one["ub"])
    if one["type"] == "hpolyhedron":
        return max(0.0, *(z - float(b) for z, b in
                          zip(_image(file, one, x, [0] * len(one["b"])), one["b"])))
    if one["type"] == "hyperellipsoid":
        from_center = [xi - float(c) for xi, c in zip(x, one["center"])]
        return max(0.0, math.hypot(*_image(file, one, from_center, [0] * len(one["A"]))) - 1)
    return max(_broken(file, file["constraints"][name], x) for name in one["constraints"])


def judge(file, edges, points):
    """(cost, violation) of the path along `edges`, indices, whose vertices lie at `points`.

    The violation is the largest of all sets and constraints, absolute. Raises ValueError where the
    edges are no path from the source to the target.
    """
    taken = [file["edges"][i] for i in edges]
    vertices = [file["source"], *(edge["head"] for edge in taken)]
    if [edge["tail"] for edge in taken] != vertices[:-1] or vertices[-1] != file["target"]:
        raise ValueError(f"edges {edges} are no path from the source to the target")
    cost, violation = 0.0, 0.0
    for index, x in zip(vertices, points, strict=True):
        vertex = file["vertices"][index]
        cost += sum(_value(file, file["functions"][name], x) for name in vertex["costs"])
        violation = max(violation, _distance(file, file["sets"][vertex["set"]], x))
    for edge, tail, head in zip(taken, points[:-1], points[1:], strict=True):
        both = tail + head
        cost += sum(_value(file, file["functions"][name], both) for name in edge["costs"])
        violation = max([violation, *(_broken(file, file["constraints"][name], both)
                                      for name in edge["constraints"])])
    return cost, violation
