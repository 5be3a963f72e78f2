#include "switchyard/symbolic/expression.hpp"

#include <cmath>
#include <limits>

#include "tests/model/said.hpp"
#include "tests/symbolic/random_expression.hpp"

namespace switchyard {
namespace {

const Variable x(1), y(2), z(3);

TEST(Expression, HasTheValueOfTheSameArithmeticOnNumbers) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    RandomExpressions random(seed, 4);
    const WithValue made = random.Make(6);
    EXPECT_NEAR(made.e.Evaluate(random.values()), made.value, 1e-10 * (1 + std::abs(made.value)))
        << made.e;
  }
}

TEST(Expression, MixesNumbersVariablesAndExpressionsInEachOperator) {
  const Expression::Values at = {{x, 3.0}, {y, 5.0}};
  const Expression e = x * y;
  const auto value = [&at](const Expression& f) { return f.Evaluate(at); };
  EXPECT_EQ(value(x + y), 8);
  EXPECT_EQ(value(x - 1), 2);
  EXPECT_EQ(value(1 - x), -2);
  EXPECT_EQ(value(2 * x), 6);
  EXPECT_EQ(value(x * 2.5), 7.5);
  EXPECT_EQ(value(x / 2), 1.5);
  EXPECT_EQ(value(6 / x), 2);
  EXPECT_EQ(value(x / y), 0.6);
  EXPECT_EQ(value(e + x), 18);
  EXPECT_EQ(value(y - e), -10);
  EXPECT_EQ(value(e * e), 225);
  EXPECT_EQ(value(-e), -15);
  EXPECT_EQ(value(-x), -3);
  EXPECT_EQ(value(+e), 15);
  EXPECT_EQ(value(pow(x, 2) + pow(2, x) + pow(x, y)), 9 + 8 + 243);
  EXPECT_EQ(value(max(x, 4) + min(y, x) + abs(-x)), 10);
  EXPECT_EQ(value(floor(x / 2) + ceil(x / 2)), 3);
}

TEST(Expression, ChangesInPlace) {
  Expression e = x;
  e += 2;
  e += y;
  e -= x * y;
  e *= 2;
  e /= 4;
  e -= z;
  e -= 1.5;
  e *= x;
  e /= y;
  const double X = 3, Y = 5, Z = 7;
  EXPECT_DOUBLE_EQ(e.Evaluate({{x, X}, {y, Y}, {z, Z}}),
                   ((X + 2 + Y - X * Y) / 2 - Z - 1.5) * X / Y);
}

TEST(Expression, MayBeAddedToItself) {
  Expression e = x + 2 * y + x * y + 1;
  e += e;
  EXPECT_EQ(to_string(e), "2 + 2*v1 + 4*v2 + 2*v1*v2");
  e -= e;
  EXPECT_TRUE(e.is_constant());
  EXPECT_EQ(e.Evaluate(), 0);
}

TEST(Expression, FoldsWhatIsFree) {
  EXPECT_TRUE((0 * Expression(sin(x))).is_constant());
  EXPECT_TRUE((x - x).is_constant());
  EXPECT_TRUE(pow(x, 0).EqualTo(1));
  EXPECT_TRUE(pow(x, 1).EqualTo(x));
  EXPECT_TRUE(pow(x, 0.5).EqualTo(sqrt(x)));
  EXPECT_TRUE((x * x).EqualTo(pow(x, 2)));
  EXPECT_TRUE((x * x * x).EqualTo(pow(x, 3)));
  EXPECT_TRUE(((x - y) * (x - y)).EqualTo(pow(x - y, 2)));
  EXPECT_TRUE(sin(Expression(0.5)).EqualTo(std::sin(0.5)));
  EXPECT_TRUE(atan2(Expression(1), Expression(2)).EqualTo(std::atan2(1, 2)));
  EXPECT_TRUE((0 / Expression(x)).EqualTo(0));
}

TEST(Expression, AddsUpTermsOfOneVariableAsALongSumGrows) {
  Expression sum = 0;
  for (int i = 0; i < 100000; ++i) sum += 0.5 * Variable(1 + i % 10);
  EXPECT_LT(sum.linear().size(), 100U);
  const auto merged = sum.MergedLinear();
  ASSERT_EQ(merged.size(), 10U);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(merged[static_cast<std::size_t>(i)].variable.get_id(), 1 + i);
    EXPECT_EQ(merged[static_cast<std::size_t>(i)].coefficient, 5000);
  }
}

TEST(Expression, ListsItsVariablesInTheOrderInWhichTheyAreRead) {
  const Variable u(4), v(5), w(6);
  const Expression e = z + y - z + atan2(sin(w), v) * (w + u) + y;
  EXPECT_EQ(e.GetVariables(), (std::vector<Variable>{y, w, v, u}));
}

TEST(Expression, HasTheValueOfWhatIsPutForItsVariables) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    RandomExpressions random(seed, 3);
    const WithValue outer = random.Make(4);
    Expression::Substitution put;
    Expression::Values values_put;
    for (const Variable v : random.variables()) {
      const WithValue inner = random.Make(2);
      put[v] = inner.e;
      values_put[v] = inner.value;
    }
    const double expected = outer.e.Evaluate(values_put);
    EXPECT_NEAR(outer.e.Substitute(put).Evaluate(random.values()), expected,
                1e-9 * (1 + std::abs(expected)));
  }
}

TEST(Expression, PutsAllAtOnceAndLeavesTheOtherVariables) {
  const Expression e = x + 2 * y + x * z;
  EXPECT_EQ(e.Substitute({{x, y}, {y, x}}).to_string(), "v2 + 2*v1 + v2*v3");
  EXPECT_EQ(e.Substitute(x, 2).to_string(), "2 + 2*v2 + 2*v3");
}

TEST(Expression, IsEqualUpToTheOrderOfLinearTerms) {
  EXPECT_TRUE((x + y + 1).EqualTo(1 + y + x));
  EXPECT_TRUE((x + y - x).EqualTo(y));
  EXPECT_TRUE(Expression(sin(x + y) * 2).EqualTo(2 * sin(y + x)));
  EXPECT_FALSE((x + y).EqualTo(x + z));
  EXPECT_FALSE(sin(x).EqualTo(cos(x)));
  EXPECT_FALSE((x * y).EqualTo(2 * x * y));
  EXPECT_FALSE((x * y).EqualTo(x * y + 1));
}

// Work that grows with the number of nodes, not of paths to them; and no calls as deep as a chain.
TEST(Expression, IsWalkedNodeByNodeHoweverDeepAndShared) {
  Expression shared = x;
  Expression same = x;
  for (int i = 0; i < 60; ++i) {
    shared = sin(shared) * cos(shared);
    same = sin(same) * cos(same);
  }
  EXPECT_LT(std::abs(shared.Evaluate({{x, 1.0}})), 1);
  EXPECT_EQ(shared.GetVariables().size(), 1U);
  EXPECT_TRUE(shared.EqualTo(same));
  EXPECT_TRUE(shared.Substitute(x, 1).is_constant());
  EXPECT_LT(shared.to_string().size(), 101000U);
  Expression deep = x;
  for (int i = 0; i < 1000000; ++i) deep = cos(std::move(deep));
  EXPECT_NEAR(deep.Evaluate({{x, 1.0}}), 0.7390851332151607, 1e-15);
  EXPECT_EQ(deep.to_string(20), "cos(cos(cos(cos(cos(...");
}

TEST(Expression, SaysWhatItCannotCompute) {
  EXPECT_EQ(Said([] { (void)((x + 2 * y) / 0); }), "division of v1 + 2*v2 by 0");
  EXPECT_EQ(Said([] {
              (void)(x * y + 1).Evaluate({{x, 1.0}});
            }),
            "the value of 1 + v1*v2: v2 has no value");
}

}  // namespace
}  // namespace switchyard
