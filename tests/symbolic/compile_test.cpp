#include <cmath>

#include "switchyard/symbolic/decompose.hpp"
#include "tests/model/said.hpp"
#include "tests/symbolic/random_expression.hpp"

#include <gtest/gtest.h>

namespace switchyard {
namespace {

using Eigen::VectorXd;

VectorXd At(const CompiledExpressions& compiled, const Expression::Values& values) {
  VectorXd x(compiled.variables.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = values.at(compiled.variables[i]);
  return x;
}

VectorXd ValuesOf(const Function& f, const VectorXd& x) {
  VectorXd y(f.num_outputs());
  f.Evaluate({.x = x.data(), .values = y.data()});
  return y;
}

TEST(CompileExpressions, ComputesWhatTheExpressionsEvaluateTo) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    RandomExpressions random(seed, 4);
    Eigen::VectorX<Expression> e(3);
    for (auto& one : e) one = random.Make(5).e;
    const CompiledExpressions compiled = CompileExpressions(e);
    EXPECT_EQ(compiled.function->num_outputs(), 3);
    const VectorXd y = ValuesOf(*compiled.function, At(compiled, random.values()));
    for (int i = 0; i < 3; ++i) {
      const double value = e[i].Evaluate(random.values());
      EXPECT_NEAR(y[i], value, 1e-10 * (1 + std::abs(value))) << e[i];
    }
  }
}

TEST(CompileExpressions, HasTheGradientOfTheExpressions) {
  const Variable x(1), y(2);
  const CompiledExpressions compiled =
      CompileExpressions(Eigen::Vector2<Expression>(x * x * y + sin(x), 3 * y - x));
  EXPECT_EQ(compiled.variables, Eigen::Vector2<Variable>(x, y));
  const Function& f = *compiled.function;
  const VectorXd at = Eigen::Vector2d(0.5, 2);
  VectorXd entries(f.jacobian().size());
  f.Evaluate({.x = at.data(), .jacobian = entries.data()});
  Eigen::Matrix2d J = Eigen::Matrix2d::Zero();
  for (int k = 0; k < f.jacobian().size(); ++k) {
    J(f.jacobian().row[static_cast<std::size_t>(k)],
      f.jacobian().col[static_cast<std::size_t>(k)]) += entries[k];
  }
  EXPECT_NEAR(J(0, 0), 2 * 0.5 * 2 + std::cos(0.5), 1e-12);
  EXPECT_NEAR(J(0, 1), 0.25, 1e-12);
  EXPECT_EQ(J(1, 0), -1);
  EXPECT_EQ(J(1, 1), 3);
}

TEST(CompileExpressions, ComputesSharedNodesOnce) {
  Expression e = Variable(1);
  for (int i = 0; i < 50; ++i) e = sin(e) * cos(e);
  const CompiledExpressions compiled =
      CompileExpressions(Eigen::VectorX<Expression>::Constant(1, e));
  const VectorXd y = ValuesOf(*compiled.function, VectorXd::Ones(1));
  EXPECT_NEAR(y[0], e.Evaluate({{Variable(1), 1.0}}), 1e-15);
}

TEST(CompileExpressions, TakesConstantsAndVariablesThatCancel) {
  const Variable x(1), y(2);
  const CompiledExpressions compiled =
      CompileExpressions(Eigen::Vector3<Expression>(2, sin(x - x) + y, x - x));
  EXPECT_EQ(compiled.variables.size(), 1);
  EXPECT_EQ(ValuesOf(*compiled.function, VectorXd::Constant(1, 5)), Eigen::Vector3d(2, 5, 0));
}

TEST(CompileExpressions, RefusesWhatIsNotANumber) {
  const Expression e = sin(Variable(1) + std::nan(""));
  EXPECT_EQ(Said([&] { (void)CompileExpressions(Eigen::VectorX<Expression>::Constant(1, e)); }),
            "v1 + nan has a coefficient that is not a number");
}

}  // namespace
}  // namespace switchyard
