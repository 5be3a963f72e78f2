// Random vectors, points of cones and problems, for properties that hold of all of them.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "switchyard/cones.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::testing {

using Vector = std::vector<double>;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double Normal() { return normal_(engine_); }
  double Uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(engine_);
  }
  std::int32_t Below(std::int32_t count) {
    return std::uniform_int_distribution<std::int32_t>(0, count - 1)(engine_);
  }
  bool Chance(double probability) { return Uniform(0, 1) < probability; }
  Vector Normals(std::int32_t count) {
    Vector v(static_cast<std::size_t>(count));
    for (double& e : v) e = Normal();
    return v;
  }
  Csc Sparse(std::int32_t rows, std::int32_t cols, double density) {
    Csc a(rows, cols);
    for (std::int32_t j = 0; j < cols; ++j) {
      for (std::int32_t i = 0; i < rows; ++i) {
        if (!Chance(density)) continue;
        a.row.push_back(i);
        a.value.push_back(Normal());
      }
      a.start[static_cast<std::size_t>(j) + 1] = static_cast<std::int32_t>(a.row.size());
    }
    return a;
  }

 private:
  std::mt19937 engine_;
  std::normal_distribution<double> normal_;
};

inline double Norm(const double* w, int dim) {
  return std::sqrt(std::inner_product(w, w + dim, w, 0.0));
}

/// svec of G G' for a random G of the given rank.
inline Vector RandomSemidefinite(Random& random, int order, int rank) {
  Eigen::MatrixXd g(order, rank);
  for (Eigen::Index i = 0; i < g.size(); ++i) g.data()[i] = random.Normal();
  const Eigen::MatrixXd s = g * g.transpose();
  Vector svec;
  for (int j = 0; j < order; ++j) {
    for (int i = 0; i < j; ++i) svec.push_back(std::sqrt(2.0) * s(i, j));
    svec.push_back(s(j, j));
  }
  return svec;
}

/// A point of the cone by construction: `slack` inside, on the boundary to rounding where it is 0.
/// For PSD the dimension is 6.
inline Vector PointOf(const sy_cone& cone, Random& random, double slack) {
  Vector s = random.Normals(cone.dim);
  const double a = cone.parameter;
  switch (cone.kind) {
    case SY_CONE_ZERO:
      return Vector(s.size(), 0.0);
    case SY_CONE_NONNEGATIVE:
      for (double& e : s) e = std::abs(e) + slack;
      s[0] = slack;
      return s;
    case SY_CONE_SECOND_ORDER:
      s[0] = Norm(s.data() + 1, cone.dim - 1) + slack;
      return s;
    case SY_CONE_PSD:
      s = RandomSemidefinite(random, 3, 2);
      for (const std::size_t diagonal : {0u, 2u, 5u}) s[diagonal] += slack;
      return s;
    case SY_CONE_EXPONENTIAL:
      s[1] = std::abs(s[1]) + 0.05;
      s[0] = s[1] * random.Uniform(-5, 4);
      s[2] = s[1] * std::exp(s[0] / s[1]) + slack;
      return s;
    case SY_CONE_POWER:
      s[0] = std::abs(s[0]);
      s[1] = std::abs(s[1]);
      s[2] = (random.Chance(0.5) ? 1 : -1) * std::pow(s[0], a) * std::pow(s[1], 1 - a);
      s[0] += slack;
      s[1] += slack;
      return s;
    default:  // SY_CONE_ROTATED
      s[1] = std::abs(s[1]) + 0.05;
      s[0] = std::pow(Norm(s.data() + 2, cone.dim - 2), 2) / (2 * s[1]) + slack;
      return s;
  }
}

/// One cone of each kind, and of a kind with several shapes more than one.
inline const std::vector<sy_cone>& AllCones() {
  static const std::vector<sy_cone> cones = {
      {SY_CONE_ZERO, 3, 0},         {SY_CONE_NONNEGATIVE, 4, 0}, {SY_CONE_SECOND_ORDER, 4, 0},
      {SY_CONE_SECOND_ORDER, 1, 0}, {SY_CONE_PSD, 6, 0},         {SY_CONE_EXPONENTIAL, 3, 0},
      {SY_CONE_POWER, 3, 0.3},      {SY_CONE_POWER, 3, 0.75},    {SY_CONE_ROTATED, 5, 0},
      {SY_CONE_ROTATED, 3, 0}};
  return cones;
}

}  // namespace switchyard::testing
