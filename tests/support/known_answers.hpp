// tests/support/known_answers.hpp - random problems whose answer is known by construction.
//
// An optimum: choose x, and duals of the right signs that are complementary to it; stationarity
// then gives q. A contradiction: choose duals with x_dual + A'row_dual + F'cone_dual = 0, then
// sides that add up to 1. A ray d: choose bounds and cones that it recedes into, P with Pd = 0,
// q'd = -1.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "tests/support/answer_errors.hpp"

namespace switchyard::testing {

struct Shape {
  std::int32_t vars = 6;
  std::int32_t rows = 5;
  std::vector<sy_cone> cones = {};
  bool quadratic = false;
  bool bounds = true;
  double density = 0.6;  // of A and F
};

struct KnownAnswer {
  ProblemData problem;
  Vectors at;
};

struct Pair {
  Vector s;
  Vector z;
};

int OrderOf(std::int32_t svec_dim);

Vector Svec(const Eigen::MatrixXd& m);

/// s in the cone and z in its dual with s'z = 0, neither of them 0 in general.
Pair ComplementaryPair(const sy_cone& cone, Random& random);

/// Sides around `value` and a dual that fits them: equal, lower, upper, both or none; active or
/// not.
void ChooseSides(Random& random, double value, double& lower, double& upper, double& dual);

/// The upper triangle of G'G.
Csc GramMatrix(const Csc& G);

std::int32_t ConeRows(const std::vector<sy_cone>& cones);

/// Matrices and sizes; every number that the answer decides is still 0.
ProblemData RandomFrame(const Shape& shape, Random& random);

KnownAnswer KnownOptimum(const Shape& shape, Random& random);

/// Without a feasible point; `at` has the duals that show it, sum side(...) - g'cone_dual = 1.
KnownAnswer KnownContradiction(const Shape& shape, Random& random);

/// A direction along which the objective falls by 1 and every bound and cone recedes.
KnownAnswer KnownRay(const Shape& shape, Random& random);

}  // namespace switchyard::testing
