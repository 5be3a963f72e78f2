#include "tests/support/known_answers.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace switchyard::testing {

int OrderOf(std::int32_t svec_dim) {
  return static_cast<int>(std::lround((std::sqrt(8.0 * svec_dim + 1) - 1) / 2));
}

Vector Svec(const Eigen::MatrixXd& m) {
  Vector v;
  for (int j = 0; j < m.cols(); ++j) {
    for (int i = 0; i <= j; ++i) v.push_back(m(i, j) * (i == j ? 1 : std::sqrt(2.0)));
  }
  return v;
}

Pair ComplementaryPair(const sy_cone& cone, Random& random) {
  Vector s = PointOf(cone, random, 0);
  Vector z(s.size(), 0.0);
  const double scale = random.Uniform(0.2, 2);
  switch (cone.kind) {
    case SY_CONE_ZERO:
      return {s, random.Normals(cone.dim)};
    case SY_CONE_NONNEGATIVE:
      for (std::size_t i = 0; i < s.size(); ++i) {
        if (random.Chance(0.5)) s[i] = 0;
        if (s[i] == 0) z[i] = random.Uniform(0.1, 2);
      }
      return {s, z};
    case SY_CONE_SECOND_ORDER:
      if (cone.dim == 1) return {s, {scale}};
      for (std::size_t i = 0; i < s.size(); ++i) z[i] = scale * (i == 0 ? s[i] : -s[i]);
      return {s, z};
    case SY_CONE_ROTATED:
      for (std::size_t i = 0; i < s.size(); ++i) z[i] = scale * (i < 2 ? s[1 - i] : -s[i]);
      return {s, z};
    case SY_CONE_EXPONENTIAL: {  // the gradient of s_2 - s_1 exp(s_0 / s_1), of degree 1
      const double ratio = s[0] / s[1];
      const double e = std::exp(ratio);
      return {s, {-scale * e, scale * e * (ratio - 1), scale}};
    }
    case SY_CONE_POWER: {  // the gradient of s_0^a s_1^(1-a) - |s_2|, of degree 1
      const double a = cone.parameter;
      const double mean = std::abs(s[2]);
      const double sign = s[2] > 0 ? 1 : -1;
      return {s, {scale * a * mean / s[0], scale * (1 - a) * mean / s[1], -scale * sign}};
    }
    default: {  // PSD: G G' and H H' with G'H = 0
      const int order = OrderOf(cone.dim);
      Eigen::MatrixXd g(order, order);
      for (double& e : g.reshaped()) e = random.Normal();
      const Eigen::MatrixXd q = g.householderQr().householderQ();
      const int rank = std::max(1, order / 2 + order % 2);
      const Eigen::MatrixXd left = q.leftCols(rank), right = q.rightCols(order - rank);
      return {Svec(left * random.Uniform(0.2, 2) * left.transpose()),
              Svec(right * scale * right.transpose())};
    }
  }
}

void ChooseSides(Random& random, double value, double& lower, double& upper, double& dual) {
  lower = -kInfinity;
  upper = kInfinity;
  dual = 0;
  const std::int32_t kind = random.Below(5);
  const bool active = random.Chance(0.6);
  const double size = random.Uniform(0.1, 2);
  if (kind == 0) {
    lower = upper = value;
    dual = random.Normal();
  } else if (kind == 1 || kind == 2) {
    lower = active ? value : value - size;
    dual = active ? size : 0;
    if (kind == 2) upper = value + 1 + size;
  } else if (kind == 3) {
    upper = active ? value : value + size;
    dual = active ? -size : 0;
  }
}

Csc GramMatrix(const Csc& G) {
  Csc P(G.cols, G.cols);
  for (std::int32_t j = 0; j < G.cols; ++j) {
    Vector e(static_cast<std::size_t>(G.cols), 0.0);
    e[static_cast<std::size_t>(j)] = 1;
    Vector image(static_cast<std::size_t>(G.rows), 0.0);
    MultiplyAdd(G.View(), 1, e.data(), image.data());
    Vector column(e.size(), 0.0);
    TransposedMultiplyAdd(G.View(), 1, image.data(), column.data());
    for (std::int32_t i = 0; i <= j; ++i) {
      if (column[static_cast<std::size_t>(i)] == 0) continue;
      P.row.push_back(i);
      P.value.push_back(column[static_cast<std::size_t>(i)]);
    }
    P.start[static_cast<std::size_t>(j) + 1] = static_cast<std::int32_t>(P.row.size());
  }
  return P;
}

std::int32_t ConeRows(const std::vector<sy_cone>& cones) {
  std::int32_t rows = 0;
  for (const sy_cone& cone : cones) rows += cone.dim;
  return rows;
}

ProblemData RandomFrame(const Shape& shape, Random& random) {
  ProblemData d;
  d.num_vars = shape.vars;
  d.flags = SY_PROBLEM_CONVEX;
  d.P = shape.quadratic
            ? GramMatrix(random.Sparse(shape.vars / 2, shape.vars, std::min(0.5, shape.density)))
            : Csc(shape.vars, shape.vars);
  d.A = random.Sparse(shape.rows, shape.vars, shape.density);
  d.F = random.Sparse(ConeRows(shape.cones), shape.vars, shape.density);
  d.cones = shape.cones;
  d.q.assign(static_cast<std::size_t>(shape.vars), 0.0);
  d.row_lower.assign(static_cast<std::size_t>(shape.rows), -kInfinity);
  d.row_upper.assign(static_cast<std::size_t>(shape.rows), kInfinity);
  d.g.assign(static_cast<std::size_t>(d.F.rows), 0.0);
  return d;
}

KnownAnswer KnownOptimum(const Shape& shape, Random& random) {
  KnownAnswer known{RandomFrame(shape, random), {}};
  ProblemData& d = known.problem;
  Vectors& v = known.at;
  v.x = random.Normals(shape.vars);
  v.x_dual.assign(v.x.size(), 0.0);
  v.row_dual.assign(d.row_lower.size(), 0.0);
  if (shape.bounds) {
    d.x_lower.resize(v.x.size());
    d.x_upper.resize(v.x.size());
    for (std::size_t j = 0; j < v.x.size(); ++j) {
      ChooseSides(random, v.x[j], d.x_lower[j], d.x_upper[j], v.x_dual[j]);
    }
  }
  const Vector Ax = Product(d.A, v.x);
  for (std::size_t i = 0; i < Ax.size(); ++i) {
    ChooseSides(random, Ax[i], d.row_lower[i], d.row_upper[i], v.row_dual[i]);
  }
  const Vector Fx = Product(d.F, v.x);
  for (const sy_cone& cone : shape.cones) {
    const Pair pair = ComplementaryPair(cone, random);
    for (std::size_t i = 0; i < pair.s.size(); ++i) {
      d.g[v.cone_dual.size()] = pair.s[i] - Fx[v.cone_dual.size()];
      v.cone_dual.push_back(pair.z[i]);
    }
  }
  d.q = Combined(d, v);
  SymmetricMultiplyAdd(d.P.View(), -1, v.x.data(), d.q.data());
  d.offset = random.Normal();
  return known;
}

KnownAnswer KnownContradiction(const Shape& shape, Random& random) {
  KnownAnswer known{RandomFrame(shape, random), {}};
  ProblemData& d = known.problem;
  Vectors& v = known.at;
  d.q = random.Normals(shape.vars);
  v.row_dual = random.Normals(shape.rows);
  for (const sy_cone& cone : shape.cones) {
    const Pair pair = ComplementaryPair(cone, random);
    v.cone_dual.insert(v.cone_dual.end(), pair.z.begin(), pair.z.end());
  }
  d.g = random.Normals(d.F.rows);
  double sum = 0;
  for (std::size_t i = 0; i < d.g.size(); ++i) sum -= d.g[i] * v.cone_dual[i];
  v.x_dual = Combined(d, v);
  d.x_lower.assign(v.x_dual.size(), -kInfinity);
  d.x_upper.assign(v.x_dual.size(), kInfinity);
  for (std::size_t j = 0; j < v.x_dual.size(); ++j) {
    v.x_dual[j] = -v.x_dual[j];
    double& side = v.x_dual[j] > 0 ? d.x_lower[j] : d.x_upper[j];
    side = random.Normal();
    sum += v.x_dual[j] * side;
  }
  for (std::size_t i = 0; i < v.row_dual.size(); ++i) {
    double& side = v.row_dual[i] > 0 ? d.row_lower[i] : d.row_upper[i];
    side = i == 0 ? 0 : random.Normal();
    sum += v.row_dual[i] * side;
  }
  (v.row_dual[0] > 0 ? d.row_lower[0] : d.row_upper[0]) = (1 - sum) / v.row_dual[0];
  return known;
}

KnownAnswer KnownRay(const Shape& shape, Random& random) {
  KnownAnswer known{RandomFrame(shape, random), {}};
  ProblemData& d = known.problem;
  Vector& ray = known.at.x;
  ray = random.Normals(shape.vars - 1);
  ray.push_back(1);  // the last column is what makes the rest fit
  const auto close = [&](Csc& M, const Vector& wanted) {
    const std::int32_t last = M.cols - 1;
    M.row.resize(static_cast<std::size_t>(M.start[static_cast<std::size_t>(last)]));
    M.value.resize(M.row.size());
    M.start.back() = M.start[static_cast<std::size_t>(last)];
    const Vector rest = Product(M, ray);
    for (std::int32_t i = 0; i < M.rows; ++i) {
      M.row.push_back(i);
      M.value.push_back(wanted[static_cast<std::size_t>(i)] - rest[static_cast<std::size_t>(i)]);
    }
    M.start.back() = static_cast<std::int32_t>(M.row.size());
  };
  Vector into;
  for (const sy_cone& cone : shape.cones) {
    const Vector s = PointOf(cone, random, 0);
    into.insert(into.end(), s.begin(), s.end());
  }
  if (!into.empty()) close(d.F, into);
  if (shape.quadratic) {
    Csc G = random.Sparse(shape.vars / 2, shape.vars, 0.5);
    close(G, Vector(static_cast<std::size_t>(G.rows), 0.0));
    d.P = GramMatrix(G);
  }
  const auto recede = [&](double step, double& lower, double& upper) {
    lower = step >= 0 && random.Chance(0.7) ? random.Normal() : -kInfinity;
    upper = step <= 0 && random.Chance(0.7) ? random.Normal() : kInfinity;
  };
  d.x_lower.resize(ray.size());
  d.x_upper.resize(ray.size());
  for (std::size_t j = 0; j < ray.size(); ++j) recede(ray[j], d.x_lower[j], d.x_upper[j]);
  const Vector Ad = Product(d.A, ray);
  for (std::size_t i = 0; i < Ad.size(); ++i) recede(Ad[i], d.row_lower[i], d.row_upper[i]);
  d.g = random.Normals(d.F.rows);
  d.q = random.Normals(shape.vars);
  double slope = 0;
  for (std::size_t j = 0; j + 1 < ray.size(); ++j) slope += d.q[j] * ray[j];
  d.q.back() = -1 - slope;
  return known;
}

}  // namespace switchyard::testing
