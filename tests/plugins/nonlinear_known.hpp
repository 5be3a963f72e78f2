// nonlinear_known.hpp - nonlinear programs whose answers are known.
#pragma once

#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include "nonlinear_programs.hpp"

namespace switchyard::test {

/// What a HandWritten is made from.
struct Nonlinear {
  ProblemData data;
  Functions functions;
};

/// Hock and Schittkowski 71: 17.0140173 near (1, 4.743, 3.8211, 1.3794).
inline Nonlinear Hs71() {
  Functions s;
  s.lower = {25, 40};
  s.upper = {kInfinity, 40};
  s.f = [](const Vector& x) { return x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2]; };
  s.gradient = [](const Vector& x) -> Vector {
    return {x[3] * (2 * x[0] + x[1] + x[2]), x[0] * x[3], x[0] * x[3] + 1,
            x[0] * (x[0] + x[1] + x[2])};
  };
  s.c = [](const Vector& x) -> Vector {
    return {x[0] * x[1] * x[2] * x[3], std::inner_product(x.begin(), x.end(), x.begin(), 0.0)};
  };
  s.jacobian = [](const Vector& x) -> Matrix {
    return {{x[1] * x[2] * x[3], x[0] * x[2] * x[3], x[0] * x[1] * x[3], x[0] * x[1] * x[2]},
            {2 * x[0], 2 * x[1], 2 * x[2], 2 * x[3]}};
  };
  s.hessian = [](const Vector& x, double w, const double* y) -> Matrix {
    return {{w * 2 * x[3] + 2 * y[1], w * x[3] + y[0] * x[2] * x[3], w * x[3] + y[0] * x[1] * x[3],
             w * (2 * x[0] + x[1] + x[2]) + y[0] * x[1] * x[2]},
            {0, 2 * y[1], y[0] * x[0] * x[3], w * x[0] + y[0] * x[0] * x[2]},
            {0, 0, 2 * y[1], w * x[0] + y[0] * x[0] * x[1]},
            {0, 0, 0, 2 * y[1]}};
  };
  s.jacobian_pattern = {{1, 1, 1, 1}, {1, 1, 1, 1}};
  s.hessian_pattern = {{1, 1, 1, 1}, {0, 1, 1, 1}, {0, 0, 1, 1}, {0, 0, 0, 1}};
  return {Box({1, 1, 1, 1}, {5, 5, 5, 5}), s};
}
inline constexpr double kHs71 = 17.0140172892;

/// Hock and Schittkowski 6: (1 - x)^2 where 10 (y - x^2) = 0, 0 at (1, 1).
inline Nonlinear Hs6() {
  Functions s;
  s.lower = s.upper = {0};
  s.f = [](const Vector& x) { return (1 - x[0]) * (1 - x[0]); };
  s.gradient = [](const Vector& x) -> Vector { return {-2 * (1 - x[0]), 0}; };
  s.c = [](const Vector& x) -> Vector { return {10 * (x[1] - x[0] * x[0])}; };
  s.jacobian = [](const Vector& x) -> Matrix { return {{-20 * x[0], 10}}; };
  s.hessian = [](const Vector&, double w, const double* y) -> Matrix {
    return {{2 * w - 20 * y[0], 0}, {0, 0}};
  };
  s.jacobian_pattern = {{1, 1}};
  s.hessian_pattern = {{1, 0}, {0, 0}};
  return {Free(2), s};
}

/// 100 (y - x^2)^2 + (1 - x)^2: 0 at (1, 1).
inline Nonlinear Rosenbrock() {
  Functions s;
  s.f = [](const Vector& x) {
    return 100 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1 - x[0], 2);
  };
  s.gradient = [](const Vector& x) -> Vector {
    const double t = x[1] - x[0] * x[0];
    return {-400 * x[0] * t - 2 * (1 - x[0]), 200 * t};
  };
  s.hessian = [](const Vector& x, double w, const double*) -> Matrix {
    return {{w * (1200 * x[0] * x[0] - 400 * x[1] + 2), -400 * w * x[0]}, {0, 200 * w}};
  };
  s.hessian_pattern = {{1, 1}, {0, 1}};
  return {Free(2), s};
}

/// x - log(x), x >= 0: 1 at 1; convex, not defined at its bound.
inline Nonlinear Logarithm() {
  Functions s;
  s.f = [](const Vector& x) { return -std::log(x[0]); };
  s.gradient = [](const Vector& x) -> Vector { return {-1 / x[0]}; };
  s.hessian = [](const Vector& x, double w, const double*) -> Matrix {
    return {{w / (x[0] * x[0])}};
  };
  s.hessian_pattern = {{1}};
  s.judge = [](const Vector& x) { return x[0] > 0 ? SY_EVALUATED : SY_UNDEFINED; };
  ProblemData d = Linear({1}, {0}, {kInfinity}, {}, {}, {});
  d.flags = SY_PROBLEM_CONVEX;
  return {std::move(d), s};
}

/// x where x^2 lies in [lower, upper], over the whole line.
inline Nonlinear Square(double lower, double upper) {
  Functions s;
  s.lower = {lower};
  s.upper = {upper};
  s.c = [](const Vector& x) -> Vector { return {x[0] * x[0]}; };
  s.jacobian = [](const Vector& x) -> Matrix { return {{2 * x[0]}}; };
  s.hessian = [](const Vector&, double, const double* y) -> Matrix { return {{2 * y[0]}}; };
  s.jacobian_pattern = s.hessian_pattern = {{1}};
  return {Linear({1}, {-kInfinity}, {kInfinity}, {}, {}, {}), s};
}

/// A convex program of all sections around a point that its duals prove optimal:
///   1/2 x'Px + q'x + sum exp(x_j - 1), rows as they come, balls 1/2 |x - center_i|^2 <= radius_i,
/// q chosen so that stationarity holds at `optimum` with row duals >= 0 and ball duals <= 0.
struct Certified {
  Nonlinear program;
  Vector optimum;
};

inline Functions ExponentialsInBalls(const Matrix& centers, const Vector& radii) {
  Functions s;
  s.lower.assign(radii.size(), -kInfinity);
  s.upper = radii;
  s.f = [](const Vector& x) {
    double sum = 0;
    for (const double v : x) sum += std::exp(v - 1);
    return sum;
  };
  s.gradient = [](Vector x) {
    for (double& v : x) v = std::exp(v - 1);
    return x;
  };
  s.jacobian = [centers](const Vector& x) {
    Matrix rows = centers;
    for (Vector& row : rows) {
      for (std::size_t j = 0; j < x.size(); ++j) row[j] = x[j] - row[j];
    }
    return rows;
  };
  s.c = [jacobian = s.jacobian](const Vector& x) {
    Vector c;
    for (const Vector& d : jacobian(x)) {
      c.push_back(0.5 * std::inner_product(d.begin(), d.end(), d.begin(), 0.0));
    }
    return c;
  };
  s.hessian = [count = radii.size()](const Vector& x, double w, const double* y) {
    const double sum = std::accumulate(y, y + count, 0.0);
    Matrix h(x.size(), Vector(x.size(), 0.0));
    for (std::size_t j = 0; j < x.size(); ++j) h[j][j] = w * std::exp(x[j] - 1) + sum;
    return h;
  };
  s.jacobian_pattern = Matrix(radii.size(), Vector(centers.front().size(), 1));
  s.hessian_pattern = Matrix(centers.front().size(), Vector(centers.front().size(), 0));
  for (std::size_t j = 0; j < s.hessian_pattern.size(); ++j) s.hessian_pattern[j][j] = 1;
  return s;
}

inline Certified RandomConvex(std::int32_t vars, std::int32_t rows, std::size_t balls,
                              unsigned seed) {
  Certified made;
  ProblemData& d = made.program.data;
  d = Random(vars, rows, seed);
  d.flags = SY_PROBLEM_CONVEX;
  std::mt19937 draw(seed + 1000);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto n = static_cast<std::size_t>(vars);
  for (std::size_t j = 0; j < n; ++j) made.optimum.push_back(j % 3 == 0 ? 0 : 2 * unit(draw));
  const Vector& x = made.optimum;
  Matrix diagonal(n, Vector(n, 0.0));
  for (std::size_t j = 0; j < n; ++j) diagonal[j][j] = unit(draw);
  d.P = Dense(diagonal, vars);

  d.row_lower.assign(d.row_lower.size(), 0.0);
  MultiplyAdd(d.A.View(), 1, x.data(), d.row_lower.data());
  Matrix centers(balls, Vector(n));
  for (Vector& center : centers) {
    for (double& v : center) v = unit(draw);
  }
  Vector radii = ExponentialsInBalls(centers, Vector(balls)).c(x);
  made.program.functions = ExponentialsInBalls(centers, radii);
  const Functions& s = made.program.functions;

  d.q = s.gradient(x);
  SymmetricMultiplyAdd(d.P.View(), 1, x.data(), d.q.data());
  for (double& v : d.q) v = -v;
  Vector row_dual(d.row_lower.size());
  for (double& y : row_dual) y = unit(draw);
  TransposedMultiplyAdd(d.A.View(), 1, row_dual.data(), d.q.data());
  const Matrix jacobian = s.jacobian(x);
  for (std::size_t j = 0; j < n; ++j) {
    if (x[j] == 0) d.q[j] += unit(draw);
    for (const Vector& gradient : jacobian) d.q[j] -= gradient[j];  // each ball's dual is -1
  }
  return made;
}

}  // namespace switchyard::test
