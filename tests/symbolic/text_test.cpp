#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "switchyard/model/program.hpp"
#include "switchyard/symbolic/formula.hpp"

namespace switchyard {
namespace {

class TextOf : public testing::Test {
 protected:
  MathematicalProgram program_;
  VectorXDecisionVariable x = program_.NewContinuousVariables(3, "x");
  Variable y = program_.NewContinuousVariables(1, "y")[0];
};

TEST_F(TextOf, ASumOfTerms) {
  EXPECT_EQ(to_string(2 * x[0] + 3 * y - x[0] * x[1] + sqrt(1 + pow(x[0], 2))),
            "2*x(0) + 3*y - x(0)*x(1) + sqrt(1 + x(0)^2)");
  EXPECT_EQ(to_string(Expression()), "0");
  EXPECT_EQ(to_string(Expression(-2.5)), "-2.5");
  EXPECT_EQ(to_string(1 + x[0]), "1 + x(0)");
  EXPECT_EQ(to_string(x[0] - 1), "x(0) - 1");
  EXPECT_EQ(to_string(-x[0] - y), "-x(0) - y");
  EXPECT_EQ(to_string(x[0] + y - x[0]), "y");
  EXPECT_EQ(to_string(x[0] - x[0]), "0");
  EXPECT_EQ(to_string(-1 * Expression(sin(y))), "-sin(y)");
  EXPECT_EQ(to_string(0.1 * y + 1e30), "1e+30 + 0.1*y");
  EXPECT_EQ(to_string(y - std::numeric_limits<double>::infinity()), "y - inf");
}

TEST_F(TextOf, ProductsQuotientsAndPowers) {
  EXPECT_EQ(to_string(2 * x[0] * (3 * x[1]) * x[2]), "6*x(0)*x(1)*x(2)");
  EXPECT_EQ(to_string((x[0] + 1) * (y - 2)), "(1 + x(0))*(y - 2)");
  EXPECT_EQ(to_string(x[0] / y), "x(0)/y");
  EXPECT_EQ(to_string(x[0] / (2 * y)), "x(0)/(2*y)");
  EXPECT_EQ(to_string(x[0] / (y * x[1])), "x(0)/(y*x(1))");
  EXPECT_EQ(to_string(3 / x[0] - 1 / y), "3/x(0) - 1/y");
  EXPECT_EQ(to_string(-3 / (x[0] + y)), "-3/(x(0) + y)");
  EXPECT_EQ(to_string(x[0] / pow(y, 2)), "x(0)/y^2");
  EXPECT_EQ(to_string(pow(x[0] * y, 2)), "(x(0)*y)^2");
  EXPECT_EQ(to_string(pow(pow(y, 2) + 0, 3)), "(y^2)^3");
  EXPECT_EQ(to_string(pow(-2.0, y)), "(-2)^y");
  EXPECT_EQ(to_string(pow(y, -1)), "y^(-1)");
  EXPECT_EQ(to_string(pow(y, x[0] + 1)), "y^(1 + x(0))");
  EXPECT_EQ(to_string(pow(sin(y), 2)), "sin(y)^2");
  EXPECT_EQ(to_string((-x[0]) * y), "-x(0)*y");
}

TEST_F(TextOf, Functions) {
  EXPECT_EQ(to_string(atan2(y, x[0]) + min(y, 1) - max(x[0], x[1])),
            "atan2(y, x(0)) + min(y, 1) - max(x(0), x(1))");
  EXPECT_EQ(to_string(exp(-y) + log(y) + abs(y) + floor(y) + ceil(y)),
            "exp(-y) + log(y) + abs(y) + floor(y) + ceil(y)");
  EXPECT_EQ(to_string(sin(y) + cos(y) + tan(y) + asin(y) + acos(y) + atan(y)),
            "sin(y) + cos(y) + tan(y) + asin(y) + acos(y) + atan(y)");
  EXPECT_EQ(to_string(sinh(y) + cosh(y) + tanh(y)), "sinh(y) + cosh(y) + tanh(y)");
  EXPECT_EQ(to_string(if_then_else(x[0] > 1, y, 0)), "if_then_else(x(0) - 1 > 0, y, 0)");
}

TEST_F(TextOf, Formulas) {
  EXPECT_EQ(to_string(x[0] + y <= 2), "x(0) + y <= 2");
  EXPECT_EQ(to_string(1 >= x[0]), "1 >= x(0)");
  EXPECT_EQ(to_string(Formula(x[0] == y)), "x(0) == y");
  EXPECT_EQ(to_string(x[0] < 2 && y > 1 && x[1] + x[2] == 0),
            "x(0) < 2 and y > 1 and x(1) + x(2) == 0");
  EXPECT_EQ(to_string((x[0] < 2 || y != 1.0) && y >= 0), "(x(0) < 2 or y != 1) and y >= 0");
  EXPECT_EQ(to_string(!(x[0] < 2)), "not (x(0) < 2)");
  EXPECT_EQ(to_string(Formula::True()), "true");
  EXPECT_EQ(to_string(Formula::False()), "false");
}

TEST_F(TextOf, AShortenedExpressionEndsInDots) {
  EXPECT_EQ((x[0] + x[1] + x[2]).to_string(10), "x(0) + x(1...");
  EXPECT_EQ((x[0] + x[1]).to_string(11), "x(0) + x(1)");
}

TEST_F(TextOf, MatricesByEigen) {
  std::ostringstream out;
  out << Eigen::Vector2<Expression>(x[0] + 1, 2 * y);
  EXPECT_EQ(out.str(), "1 + x(0)\n     2*y");
}

}  // namespace
}  // namespace switchyard
