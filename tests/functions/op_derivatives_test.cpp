// Every operation beside its formulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>

#include "core/functions/tape_function.hpp"
#include "switchyard/functions/check_derivatives.hpp"
#include "switchyard/functions/tape.hpp"
#include "tests/functions/evaluated.hpp"
#include "tests/functions/formulas.hpp"

namespace switchyard {
namespace {

using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::shared_ptr<const Function> FunctionOf(Op op) {
  const int n = NumOperands(op);
  Tape tape(n);
  tape.AddOutput(n == 1   ? tape.Apply(op, 0)
                 : n == 2 ? tape.Apply(op, 0, 1)
                          : tape.Apply(op, 0, 1, 2));
  return CompileTape(tape);
}

void ExpectNear(double ours, double theirs, double tolerance) {
  EXPECT_LE(std::abs(ours - theirs), tolerance * std::max(1.0, std::abs(theirs)))
      << ours << " and " << theirs;
}

class OfOperation : public testing::TestWithParam<OpFormula> {};

TEST_P(OfOperation, DerivativesAreItsFormulasAndItsDifferences) {
  const OpFormula& c = GetParam();
  const auto f = FunctionOf(c.op);
  std::mt19937 source(7);
  std::uniform_real_distribution<double> operand(c.lower, c.upper);
  for (int k = 0; k < 100; ++k) {
    const VectorXd x = VectorXd::NullaryExpr(f->num_vars(), [&] { return operand(source); });
    const double a = x[0];
    const double b = x.size() > 1 ? x[1] : 0;
    // Differences see a kink that is within their step.
    const bool has_kink = c.op == Op::kMin || c.op == Op::kMax || c.op == Op::kAbs;
    if (has_kink && std::abs(a - b) < 0.1) continue;
    const auto expected = c.formula(a, b);
    const Evaluated ours = At(*f, x);
    ExpectNear(ours.values[0], expected[0], 1e-13);
    ExpectNear(ours.jacobian(0, 0), expected[1], 1e-12);
    ExpectNear(ours.hessian(0, 0), expected[3], 1e-12);
    if (x.size() > 1) {
      ExpectNear(ours.jacobian(0, 1), expected[2], 1e-12);
      ExpectNear(ours.hessian(0, 1), expected[4], 1e-12);
      ExpectNear(ours.hessian(1, 1), expected[5], 1e-12);
    }
    const DerivativeReport report = CheckDerivatives(*f, x, {}, 1e-7);
    EXPECT_TRUE(report.agrees()) << x.transpose() << "\n" << to_string(report);
  }
}

INSTANTIATE_TEST_SUITE_P(All, OfOperation, testing::ValuesIn(kFormulas),
                         [](const auto& of) { return std::string(of.param.name); });

TEST(OfOperations, EveryOneIsTested) {
  for (int op = static_cast<int>(Op::kAdd); op < static_cast<int>(Op::kIfPositive); ++op) {
    const auto tests = [&](const OpFormula& c) { return static_cast<int>(c.op) == op; };
    EXPECT_TRUE(std::any_of(kFormulas.begin(), kFormulas.end(), tests)) << op;
  }
}

std::shared_ptr<const Function> PowerBy(double k) {
  Tape tape(1);
  tape.AddOutput(tape.Apply(Op::kPower, 0, tape.Constant(k)));
  return CompileTape(tape);
}

TEST(PowerByConstant, OfAWholeNumberIsExactEverywhere) {
  for (const double k : {-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0}) {
    for (const double a : {-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0}) {
      if (a == 0 && k < 0) continue;
      const auto factorial_power = [&](double c, double e) {
        return c == 0 ? 0 : c * std::pow(a, e);
      };
      const Evaluated ours = At(*PowerBy(k), VectorXd::Constant(1, a));
      EXPECT_EQ(ours.values[0], std::pow(a, k)) << a << "^" << k;
      EXPECT_EQ(ours.jacobian(0, 0), factorial_power(k, k - 1)) << a << "^" << k;
      EXPECT_EQ(ours.hessian(0, 0), factorial_power(k * (k - 1), k - 2)) << a << "^" << k;
    }
  }
}

TEST(PowerByConstant, OfAFractionIsInfiniteWhereItIs) {
  const Evaluated root = At(*PowerBy(0.5), VectorXd::Zero(1));
  EXPECT_EQ(root.values[0], 0);
  EXPECT_EQ(root.jacobian(0, 0), kInfinity);
  EXPECT_EQ(root.hessian(0, 0), -kInfinity);
  const Evaluated three_halves = At(*PowerBy(1.5), VectorXd::Zero(1));
  EXPECT_EQ(three_halves.jacobian(0, 0), 0);
  EXPECT_EQ(three_halves.hessian(0, 0), kInfinity);
  EXPECT_TRUE(std::isnan(At(*PowerBy(0.5), VectorXd::Constant(1, -1)).jacobian(0, 0)));
}

TEST(PowerByConstant, NeitherOverflowsNorVanishesBeforeItsDerivatives) {
  const Evaluated small = At(*PowerBy(3), VectorXd::Constant(1, 1e-110));  // a^3 is 0
  EXPECT_EQ(small.jacobian(0, 0), 3 * std::pow(1e-110, 2));
  EXPECT_EQ(small.hessian(0, 0), 6 * 1e-110);
  const Evaluated large = At(*PowerBy(3), VectorXd::Constant(1, 1e110));  // a^3 is infinite
  EXPECT_EQ(large.jacobian(0, 0), 3 * std::pow(1e110, 2));
  EXPECT_EQ(large.hessian(0, 0), 6 * 1e110);
}

TEST(PowerOfConstant, IsAnExponential) {
  Tape tape(1);
  tape.AddOutput(tape.Apply(Op::kPower, tape.Constant(3), 0));
  const auto f = CompileTape(tape);
  const double l = std::log(3.0);
  const Evaluated ours = At(*f, VectorXd::Constant(1, -1.5));
  ExpectNear(ours.jacobian(0, 0), l * std::pow(3, -1.5), 1e-15);
  ExpectNear(ours.hessian(0, 0), l * l * std::pow(3, -1.5), 1e-15);
}

TEST(Power, OfZeroHasTheLimitsOfItsDerivatives) {
  const Evaluated ours = At(*FunctionOf(Op::kPower), Eigen::Vector2d(0, 2.5));
  EXPECT_EQ(ours.values[0], 0);
  EXPECT_EQ(ours.jacobian, Eigen::RowVector2d(0, 0));
  EXPECT_EQ(ours.hessian, Eigen::Matrix2d::Zero());
}

TEST(Kinks, AreAsTheTableOfOperationsSays) {
  EXPECT_EQ(At(*FunctionOf(Op::kAbs), VectorXd::Zero(1)).jacobian(0, 0), 0);
  EXPECT_EQ(At(*FunctionOf(Op::kMin), Eigen::Vector2d(1, 1)).jacobian, Eigen::RowVector2d(1, 0));
  EXPECT_EQ(At(*FunctionOf(Op::kMax), Eigen::Vector2d(1, 1)).jacobian, Eigen::RowVector2d(1, 0));
  const auto positive = FunctionOf(Op::kIfPositive);
  const auto nonnegative = FunctionOf(Op::kIfNonnegative);
  EXPECT_EQ(positive->jacobian(), Pattern(1, 3, {{0, 1}, {0, 2}}));
  for (const double a : {-1.0, 0.0, 1.0}) {
    const VectorXd x = Eigen::Vector3d(a, 5, 7);
    EXPECT_EQ(At(*positive, x).values[0], a > 0 ? 5 : 7);
    EXPECT_EQ(At(*positive, x).jacobian, Eigen::RowVector3d(0, a > 0, !(a > 0)));
    EXPECT_EQ(At(*nonnegative, x).values[0], a >= 0 ? 5 : 7);
    EXPECT_EQ(At(*nonnegative, x).jacobian, Eigen::RowVector3d(0, a >= 0, !(a >= 0)));
  }
}

TEST(Branches, ThatAreNotTakenAddNothingWhereTheyAreNotDefined) {
  Tape tape(2);  // x > 0 ? sqrt(x) y : y^2, and max(y, log(x))
  const auto root = tape.Apply(Op::kMultiply, tape.Apply(Op::kSqrt, 0), 1);
  tape.AddOutput(tape.Apply(Op::kIfPositive, 0, root, tape.Apply(Op::kMultiply, 1, 1)));
  tape.AddOutput(tape.Apply(Op::kMax, 1, tape.Apply(Op::kLog, 0)));
  for (const JacobianMode mode : {JacobianMode::kReverse, JacobianMode::kForward}) {
    const Evaluated ours = At(TapeFunction(tape, {.jacobian = mode}), Eigen::Vector2d(0, 3));
    EXPECT_EQ(ours.values, Eigen::Vector2d(9, 3));
    EXPECT_EQ(ours.jacobian, (Eigen::Matrix2d() << 0, 6, 0, 1).finished());
    EXPECT_EQ(ours.hessian, (Eigen::Matrix2d() << 0, 0, 0, 2).finished());
  }
}

TEST(UndefinedPoints, ComeOutAsTheyAre) {
  const Evaluated root = At(*FunctionOf(Op::kSqrt), VectorXd::Zero(1));
  EXPECT_EQ(root.jacobian(0, 0), kInfinity);
  EXPECT_EQ(root.hessian(0, 0), -kInfinity);
  EXPECT_TRUE(std::isnan(At(*FunctionOf(Op::kSqrt), VectorXd::Constant(1, -1)).values[0]));
  EXPECT_EQ(At(*FunctionOf(Op::kLog), VectorXd::Zero(1)).values[0], -kInfinity);
  EXPECT_EQ(At(*FunctionOf(Op::kDivide), Eigen::Vector2d(1, 0)).values[0], kInfinity);
}

}  // namespace
}  // namespace switchyard
