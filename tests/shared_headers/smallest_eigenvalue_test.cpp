// The smallest eigenvalue against a library's, and where it is known.
#include "switchyard/smallest_eigenvalue.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "tests/shared_headers/random_problem.hpp"

namespace switchyard {
namespace {

using testing::Random;

SmallestEigenvalue SmallestOf(const Eigen::MatrixXd& m) {
  const auto n = static_cast<std::size_t>(m.rows());
  std::vector<double> a(n * n, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      a[i * n + j] = m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
  return SmallestEigenvalueOf(std::move(a), n);
}

Eigen::MatrixXd RandomMatrix(Random& random, int rows, int cols) {
  return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return random.Normal(); });
}

TEST(SmallestEigenvalue, IsThatOfALibrary) {
  Random random(4);
  for (const int n : {1, 2, 3, 4, 7, 20, 60}) {
    for (const double scale : {1.0, 1e-200, 1e200}) {
      for (int trial = 0; trial < 20; ++trial) {
        const Eigen::MatrixXd g = RandomMatrix(random, n, n);
        const Eigen::MatrixXd m = g + g.transpose();
        const Eigen::VectorXd values =
            Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m).eigenvalues();
        const SmallestEigenvalue found = SmallestOf(scale * m);
        EXPECT_NEAR(found.value / scale, values[0], 1e-14 * n * values.cwiseAbs().maxCoeff());
        EXPECT_GE(found.rounding, 0);
        EXPECT_LE(found.rounding / scale, 1e-14 * n * m.norm());
      }
    }
  }
}

// Q D Q' with a known D, of many sizes, equal ones and zeros among them.
TEST(SmallestEigenvalue, IsWithinItsRounding) {
  Random random(5);
  for (const int n : {2, 3, 5, 12, 40}) {
    for (int trial = 0; trial < 20; ++trial) {
      const Eigen::MatrixXd q = RandomMatrix(random, n, n).householderQr().householderQ();
      Eigen::VectorXd d = Eigen::VectorXd::NullaryExpr(
          n, [&] { return std::pow(10, random.Uniform(-9, 2)) * (random.Chance(0.5) ? 1 : -1); });
      if (trial % 3 == 0) d = d.cwiseAbs();
      if (trial % 4 == 0) d.head(n / 2).setConstant(d.minCoeff());
      if (trial % 5 == 0) d[0] = 0;
      const Eigen::MatrixXd m = q * d.asDiagonal() * q.transpose();
      const SmallestEigenvalue found = SmallestOf(m);
      // What the product rounds is not the method's.
      EXPECT_NEAR(found.value, d.minCoeff(), found.rounding + 1e-15 * n * m.norm());
    }
  }
}

TEST(SmallestEigenvalue, IsExactWhereNothingIsRounded) {
  EXPECT_EQ(SmallestOf(Eigen::MatrixXd(0, 0)).value, 0);
  EXPECT_EQ(SmallestOf(Eigen::MatrixXd::Constant(1, 1, -2)).value, -2);
  EXPECT_EQ(SmallestOf(Eigen::MatrixXd::Constant(1, 1, -2)).rounding, 0);
  EXPECT_EQ(SmallestOf(Eigen::MatrixXd::Zero(5, 5)).value, 0);
  EXPECT_EQ(SmallestOf(Eigen::MatrixXd::Identity(6, 6)).value, 1);
  EXPECT_EQ(SmallestOf(Eigen::Vector4d(4, 0, 1, 2).asDiagonal().toDenseMatrix()).value, 0);
  EXPECT_EQ(SmallestOf(Eigen::Vector4d(4, -8, 1, 2).asDiagonal().toDenseMatrix()).value, -8);
}

TEST(SmallestEigenvalue, OfWhatIsNotFiniteIsNone) {
  for (const double odd : {HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    Eigen::MatrixXd m = Eigen::MatrixXd::Identity(3, 3);
    m(2, 1) = odd;
    EXPECT_TRUE(std::isnan(SmallestOf(m).value));
  }
}

}  // namespace
}  // namespace switchyard
