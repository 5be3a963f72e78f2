// Factorizations of indefinite matrices, by their residual and by eigenvalues.
#include "ipopt/pivoted_ldl.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace switchyard::testing {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using ipopt::PivotedLdl;

/// The pattern of a dense matrix's upper triangle where it is not zero, and its values.
struct Sparse {
  linalg::SymmetricPattern pattern;
  std::vector<double> values;

  explicit Sparse(const MatrixXd& A) {
    pattern.n = static_cast<linalg::Index>(A.rows());
    for (int j = 0; j < A.cols(); ++j) {
      for (int i = 0; i <= j; ++i) {
        if (A(i, j) == 0) continue;
        pattern.row.push_back(i);
        values.push_back(A(i, j));
      }
      pattern.start.push_back(static_cast<linalg::Index>(pattern.row.size()));
    }
  }
};

void ExpectSolved(const MatrixXd& A, int negative, double error = 1e-12) {
  const Sparse sparse(A);
  PivotedLdl ldl(sparse.pattern, std::vector<linalg::Index>(A.rows(), 0));
  const auto inertia = ldl.Factor(sparse.values.data(), 0.1);
  EXPECT_EQ(inertia.zero, 0);
  EXPECT_EQ(inertia.negative, negative);
  const VectorXd b = VectorXd::LinSpaced(A.rows(), -1, 2);
  VectorXd x = b;
  ldl.Solve(x.data());
  EXPECT_LE((A * x - b).norm(), error * (A.norm() * x.norm() + b.norm()));
}

/// Tridiagonal of order n: `diagonal` and ones beside it.
MatrixXd Chain(int n, double diagonal) {
  MatrixXd A = diagonal * MatrixXd::Identity(n, n);
  for (int i = 1; i < n; ++i) A(i, i - 1) = A(i - 1, i) = 1;
  return A;
}

// Eigenvalues of a chain are d + 2 cos(k pi / (n + 1)): with d = 0 no entry of the diagonal is a
// pivot, and half of them are negative.
TEST(PivotedLdl, TakesPairsWhereTheDiagonalIsZero) {
  for (const int n : {2, 4, 10, 64, 200}) ExpectSolved(Chain(n, 0), n / 2);
  ExpectSolved(Chain(99, -3), 99);
  ExpectSolved(Chain(99, 3), 0);
}

TEST(PivotedLdl, CountsAsZeroWhatHasNone) {
  const Sparse sparse(Chain(9, 0));  // cos(5 pi / 10) = 0
  PivotedLdl ldl(sparse.pattern, std::vector<linalg::Index>(9, 0));
  const auto inertia = ldl.Factor(sparse.values.data(), 0.1);
  EXPECT_EQ(inertia.zero, 1);
  EXPECT_EQ(inertia.negative, 4);
}

// Units of 1e-9 to 1e9: congruent, so of the same inertia.
TEST(PivotedLdl, IsIndifferentToUnits) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> orders(-9, 9);
  MatrixXd A = Chain(40, 0.5);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(A);
  const auto negative = static_cast<int>((eigen.eigenvalues().array() < 0).count());
  for (int i = 0; i < 40; ++i) {
    const double unit = std::pow(10, orders(engine));
    A.row(i) *= unit;
    A.col(i) *= unit;
  }
  ExpectSolved(A, negative);
}

// Columns of size 1e-3 and of 1 below zeros: pivots that fronts have to delay.
TEST(PivotedLdl, DelaysWhatIsNoPivotYet) {
  constexpr int kBlocks = 20, kSize = 4, kBorder = 6;
  constexpr int n = kBlocks * kSize + kBorder;
  std::mt19937 engine(7);
  std::normal_distribution<double> normal;
  MatrixXd A = MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < i; ++j) {
      const bool of_border = i >= kBlocks * kSize, of_block = i / kSize == j / kSize;
      if (of_border) A(i, j) = A(j, i) = normal(engine);
      if (of_block && !of_border) A(i, j) = A(j, i) = 1e-3 * normal(engine);
    }
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(A);
  ExpectSolved(A, static_cast<int>((eigen.eigenvalues().array() < 0).count()));
}

}  // namespace
}  // namespace switchyard::testing
