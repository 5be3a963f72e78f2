#include "switchyard/functions/check_derivatives.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "switchyard/functions/make_function.hpp"
#include "tests/functions/evaluated.hpp"
#include "tests/model/said.hpp"

namespace switchyard {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::VectorXd;
using Kind = DerivativeMismatch::Kind;

// (x_0^2 x_1, sin(x_1)) with a mistake that a test makes.
struct Mistaken {
  double jacobian_11 = 0;
  double hessian_01 = 0;
  VectorXd operator()(const VectorXd& x) const {
    return Vector2d(x[0] * x[0] * x[1], std::sin(x[1]));
  }
  Matrix2d Jacobian(const VectorXd& x) const {
    return (Matrix2d() << 2 * x[0] * x[1], x[0] * x[0], 0, std::cos(x[1]) + jacobian_11).finished();
  }
  Matrix2d Hessian(const VectorXd& x, const VectorXd& w) const {
    const double cross = w[0] * 2 * x[0] + hessian_01;
    return (Matrix2d() << w[0] * 2 * x[1], cross, cross, -w[1] * std::sin(x[1])).finished();
  }
};

TEST(CheckDerivatives, FindsNothingWhereTheyAreRight) {
  const DerivativeReport report =
      CheckDerivatives(*MakeFunction(2, Mistaken()), Vector2d(3, 4), Vector2d(2, -5));
  EXPECT_TRUE(report.agrees());
  EXPECT_LT(report.worst_error, 1e-10);
  EXPECT_EQ(to_string(report).substr(0, 42), "the derivatives agree with differences to ");
}

TEST(CheckDerivatives, NamesAWrongEntryOfTheJacobian) {
  const auto f = MakeFunction(2, Mistaken{.jacobian_11 = 1e-4});
  const DerivativeReport report = CheckDerivatives(*f, Vector2d(3, 4));
  ASSERT_EQ(report.disagreeing.size(), 1u);
  const DerivativeMismatch& found = report.disagreeing[0];
  EXPECT_EQ(found.kind, Kind::kJacobian);
  EXPECT_EQ(found.row, 1);
  EXPECT_EQ(found.col, 1);
  EXPECT_NEAR(found.by_differences, std::cos(4.0), 1e-9);
  EXPECT_NEAR(found.relative_error, 1e-4, 1e-9);
  EXPECT_EQ(report.worst_error, found.relative_error);
  EXPECT_EQ(to_string(report).substr(0, 35), "Jacobian: row 1 and column 1 is -0.");
}

TEST(CheckDerivatives, NamesAWrongEntryOfTheHessian) {
  const auto f = MakeFunction(2, Mistaken{.hessian_01 = 1e-3});
  const DerivativeReport report = CheckDerivatives(*f, Vector2d(3, 4));
  ASSERT_EQ(report.disagreeing.size(), 1u);
  EXPECT_EQ(report.disagreeing[0].kind, Kind::kHessian);
  EXPECT_EQ(report.disagreeing[0].row, 0);
  EXPECT_EQ(report.disagreeing[0].col, 1);
  EXPECT_NEAR(report.disagreeing[0].ours, 6 + 1e-3, 1e-12);
}

// (a x_0 x_1 + x_1, x_1), with an error in each row of the Jacobian and one in the Hessian.
struct Scaled {
  double a;
  double error;
  VectorXd operator()(const VectorXd& x) const { return Vector2d(a * x[0] * x[1] + x[1], x[1]); }
  Matrix2d Jacobian(const VectorXd& x) const {
    return (Matrix2d() << a * x[1] + error, a * x[0] + 1, error, 1).finished();
  }
  Matrix2d Hessian(const VectorXd&, const VectorXd& w) const {
    return (Matrix2d() << 0, w[0] * a, w[0] * a, error).finished();
  }
};

TEST(CheckDerivatives, IsRelativeToTheRow) {
  const auto found = [](double a) {
    return CheckDerivatives(*MakeFunction(2, Scaled{.a = a, .error = 1e-4}), Vector2d(1, 0))
        .disagreeing;
  };
  EXPECT_EQ(found(1).size(), 3u);
  const auto beside_large = found(1000);  // beside which 1e-4 in row 0, or in row 1 of H, is 1e-7
  ASSERT_EQ(beside_large.size(), 1u);
  EXPECT_EQ(beside_large[0].kind, Kind::kJacobian);
  EXPECT_EQ(beside_large[0].row, 1);
}

TEST(CheckDerivatives, NamesWhatThePatternLacks) {
  struct Lacking {
    double operator()(const VectorXd& x) const { return x[0] * x[1]; }
    Eigen::SparseMatrix<double> Jacobian(const VectorXd& x) const {
      Eigen::SparseMatrix<double> J(1, 2);
      J.insert(0, 0) = x[1];
      return J;
    }
  };
  const auto f = MakeFunction(2, Lacking(), {.jacobian = Pattern(1, 2, {{0, 0}})});
  const DerivativeReport report = CheckDerivatives(*f, Vector2d(3, 4));
  EXPECT_FALSE(report.agrees());
  EXPECT_TRUE(report.disagreeing.empty());
  ASSERT_EQ(report.missing.size(), 1u);
  EXPECT_EQ(report.missing[0].col, 1);
  EXPECT_EQ(to_string(report).substr(0, 72),
            "Jacobian: row 0 and column 1 has no place in the pattern, so is 0, by di");
}

TEST(CheckDerivatives, NamesWhatIsNotANumber) {
  const auto root = MakeFunction(1, [](const auto& x) { return sqrt(x[0]); });
  const DerivativeReport report = CheckDerivatives(*root, VectorXd::Constant(1, -1));
  EXPECT_EQ(report.disagreeing.size(), 2u);
  EXPECT_TRUE(std::isnan(report.disagreeing[0].ours));
}

TEST(CheckDerivatives, SaysWhatItCannotCheck) {
  const auto plain = MakeFunction(2, [](const VectorXd& x) { return x[0]; });
  EXPECT_EQ(Said([&] { CheckDerivatives(*plain, Vector2d(1, 2)); }),
            "check of derivatives: the function has none");
  const auto f = MakeFunction(2, Mistaken());
  EXPECT_EQ(Said([&] { CheckDerivatives(*f, VectorXd::Ones(3)); }),
            "check of derivatives: x needs 2 entries, got 3");
  EXPECT_EQ(Said([&] { CheckDerivatives(*f, Vector2d(1, 2), VectorXd::Ones(1)); }),
            "check of derivatives: the weights need 2 entries, got 1");
}

}  // namespace
}  // namespace switchyard
