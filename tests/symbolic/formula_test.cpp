#include "switchyard/symbolic/formula.hpp"

#include <type_traits>

#include "tests/model/said.hpp"

namespace switchyard {
namespace {

const Variable x(1), y(2);

TEST(Formula, ComparesTheValuesOfItsSides) {
  const Expression::Values at = {{x, 1.0}, {y, 2.0}};
  EXPECT_TRUE((x < y).Evaluate(at));
  EXPECT_FALSE((x > y).Evaluate(at));
  EXPECT_TRUE((2 * x == y + 0).Evaluate(at));
  EXPECT_TRUE((2 * x <= y).Evaluate(at));
  EXPECT_TRUE((2 * x >= y).Evaluate(at));
  EXPECT_FALSE((2 * x != y).Evaluate(at));
  EXPECT_TRUE((x <= 1 && y >= 2).Evaluate(at));
  EXPECT_FALSE((x <= 1 && y >= 3).Evaluate(at));
  EXPECT_TRUE((x <= 0 || y >= 2).Evaluate(at));
  EXPECT_TRUE((!(x <= 0)).Evaluate(at));
  EXPECT_FALSE(Formula(x == y).Evaluate(at));
  EXPECT_TRUE(Formula::True().Evaluate());
  EXPECT_FALSE(Formula::False().Evaluate());
}

TEST(Formula, IsNoBoolByItself) { EXPECT_FALSE((std::is_convertible_v<Formula, bool>)); }

TEST(Formula, IsDecidedWhereNoValueMatters) {
  EXPECT_TRUE(bool(Expression(1) <= 2));
  EXPECT_FALSE(bool(Expression(1) == 2));
  EXPECT_TRUE(bool(x + 1 > x));
  EXPECT_TRUE(bool(2 * x - x == x));
  EXPECT_TRUE(bool(sin(x) <= sin(x)));
  EXPECT_TRUE(bool(x == x));
  EXPECT_FALSE(bool(Formula(x == y)));
  EXPECT_TRUE(bool(Expression(x) != y));
  EXPECT_TRUE(bool(Expression(1) <= 2 && Formula(x == x)));
  EXPECT_FALSE(bool(x <= 1 && Expression(1) >= 2));
  EXPECT_TRUE(bool(x <= 1 || Expression(1) <= 2));
  EXPECT_FALSE(bool(!(Expression(1) <= 2)));
}

TEST(Formula, SaysThatItDependsOnValues) {
  EXPECT_EQ(Said([] { (void)bool(x + y <= 2); }),
            "whether v1 + v2 <= 2 depends on values: a formula is a bool only where it compares "
            "constants, or two variables by ==");
  EXPECT_EQ(Said([] { (void)bool(x <= y && Expression(1) <= 2); }),
            "whether v1 <= v2 and 1 <= 2 depends on values: a formula is a bool only where it "
            "compares constants, or two variables by ==");
}

TEST(Formula, OfTwoVariablesIsABoolAndAFormula) {
  const bool same = x == x;
  EXPECT_TRUE(same);
  if (x == y) ADD_FAILURE();
  const Formula f = x == y;
  EXPECT_EQ(f.kind(), Formula::Kind::kEqual);
  EXPECT_TRUE(f.left().EqualTo(x));
  EXPECT_TRUE(f.right().EqualTo(y));
  const bool differ = !(x == y);
  EXPECT_TRUE(differ);
  EXPECT_EQ(((x == y) && (y == x)).kind(), Formula::Kind::kAnd);
  EXPECT_EQ(((x == y) || (y == x)).kind(), Formula::Kind::kOr);
}

TEST(Formula, TakesConjunctionsApart) {
  const Formula f = (x <= 1 && y <= 2) && Formula::True() && x >= 0;
  ASSERT_EQ(f.kind(), Formula::Kind::kAnd);
  EXPECT_EQ(f.parts().size(), 3U);
  EXPECT_EQ((f && Formula::False()).kind(), Formula::Kind::kFalse);
  EXPECT_EQ(Formula::All({}).kind(), Formula::Kind::kTrue);
}

TEST(Formula, ListsPutsAndComparesAsItsExpressionsDo) {
  const Formula f = x <= 1 && y * x >= 2;
  EXPECT_EQ(f.GetVariables(), (std::vector<Variable>{x, y}));
  EXPECT_EQ(f.Substitute({{x, 3 * y}}).to_string(), "3*v2 <= 1 and 3*v2^2 >= 2");
  EXPECT_TRUE(f.EqualTo(x <= 1 && y * x >= 2));
  EXPECT_FALSE(f.EqualTo(x <= 1 && y * x <= 2));
  EXPECT_FALSE(f.EqualTo(x <= 1));
  EXPECT_EQ(Said([&] { (void)f.left(); }),
            "v1 <= 1 and v2*v1 >= 2 is no comparison: it has no left side");
  EXPECT_EQ(Said([&] { (void)(x <= 1).parts(); }), "v1 <= 1 is not put together of formulas");
}

TEST(Formula, ChoosesBetweenExpressionsByAnyCondition) {
  const Formula conditions[] = {
      x<y, x <= y, x> y, x >= y,         x == y + 0,        x != y + 0,      x == y,
      x < y && x > 0,    x < y || x > 1, !(x < y || y < 1), Formula::True(), Formula::False(),
      Expression(1) < 2};
  for (const Formula& f : conditions) {
    const Expression e = if_then_else(f, x + 10, y * y - 10);
    for (const double X : {0.0, 1.0, 2.0}) {
      for (const double Y : {0.0, 1.0, 2.0}) {
        const Expression::Values at = {{x, X}, {y, Y}};
        EXPECT_EQ(e.Evaluate(at), f.Evaluate(at) ? X + 10 : Y * Y - 10) << f << " at " << X << Y;
      }
    }
  }
}

}  // namespace
}  // namespace switchyard
