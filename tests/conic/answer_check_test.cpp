// The judges of answers, held against answers that were made up: good ones and bad ones.
#include "solvers/conic/answer_check.hpp"

#include <gtest/gtest.h>

#include "tests/conic/programs.hpp"

namespace switchyard::conic {
namespace {

using presolve::Answer;
using presolve::Meaning;

constexpr unsigned kSeeds = 20;

Answer AnswerOf(const Vectors& v, Meaning meaning, const ProblemData& d) {
  Answer a{v.x, v.x_dual, v.row_dual, v.cone_dual, meaning};
  a.x.resize(static_cast<std::size_t>(d.num_vars), 0.0);
  a.x_dual.resize(a.x.size(), 0.0);
  a.row_dual.resize(d.row_lower.size(), 0.0);
  a.cone_dual.resize(d.g.size(), 0.0);
  return a;
}

void Scale(Answer& a, double factor) {
  for (auto* v : {&a.x, &a.x_dual, &a.row_dual, &a.cone_dual}) {
    for (double& e : *v) e *= factor;
  }
}

testing::Shape ShapeOf(unsigned seed) {
  testing::Shape shape{14, 6, {SecondOrder(4), Semidefinite(3), Exponential(), Rotated(3)}};
  if (seed % 2 == 0) shape.cones.push_back(Power(0.3));
  if (seed % 3 == 0) shape.cones.push_back({SY_CONE_ZERO, 2, 0});
  return shape;
}

TEST(IsContradiction, TakesGoodOnesOfAnySize) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    Random random(seed);
    const KnownAnswer known = testing::KnownContradiction(ShapeOf(seed), random);
    for (const double unit : {1.0, 1e-6, 1e8}) {
      Answer a = AnswerOf(known.at, Meaning::kContradiction, known.problem);
      Scale(a, unit);
      EXPECT_TRUE(IsContradiction(known.problem, a)) << "seed " << seed << " times " << unit;
    }
  }
}

TEST(IsContradiction, TakesNoneThatIsWrongInOneWay) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const KnownAnswer known = testing::KnownContradiction(ShapeOf(seed), random);
    const Answer good = AnswerOf(known.at, Meaning::kContradiction, known.problem);
    Answer zero = good;
    Scale(zero, 0);
    EXPECT_FALSE(IsContradiction(known.problem, zero)) << "zero";
    Answer negative = good;
    Scale(negative, -1);
    EXPECT_FALSE(IsContradiction(known.problem, negative)) << "signs";
    {  // sides that no longer add up to more than 0
      ProblemData d = known.problem;
      (good.row_dual[0] > 0 ? d.row_lower[0] : d.row_upper[0]) -= 1.001 / good.row_dual[0];
      EXPECT_FALSE(IsContradiction(d, good)) << "sum";
    }
    {  // a side that the certificate stands on is not there
      ProblemData d = known.problem;
      std::size_t j = 0;
      while (good.x_dual[j] == 0) ++j;
      (good.x_dual[j] > 0 ? d.x_lower[j] : d.x_upper[j]) =
          good.x_dual[j] > 0 ? -kInfinity : kInfinity;
      EXPECT_FALSE(IsContradiction(d, good)) << "bound";
    }
    {  // a point of the program, whatever the duals say
      Random other(seed);
      const KnownAnswer feasible = testing::KnownOptimum(ShapeOf(seed), other);
      EXPECT_FALSE(IsContradiction(
          feasible.problem, AnswerOf(feasible.at, Meaning::kContradiction, feasible.problem)));
    }
  }
}

TEST(IsContradiction, TakesNoneOfAProgramWithAPoint) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const KnownAnswer known = testing::KnownOptimum(ShapeOf(seed), random);
    Vectors v;
    v.x_dual = random.Normals(known.problem.num_vars);
    v.row_dual = random.Normals(known.problem.num_rows());
    v.cone_dual = random.Normals(known.problem.num_cone_rows());
    Answer a = AnswerOf(v, Meaning::kContradiction, known.problem);
    CloseStationarity(known.problem, a);
    EXPECT_FALSE(IsContradiction(known.problem, a)) << seed;
  }
}

/// x >= 1 and x - small y <= 0, y free: points from y = 1 / small on.
ProblemData FarAway(double small) {
  ProblemData d;
  d.num_vars = 2;
  d.P = Csc(2, 2);
  d.F = Csc(0, 2);
  d.q = {0, 0};
  d.A = Csc(2, 2);
  d.A.start = {0, 2, 3};
  d.A.row = {0, 1, 1};
  d.A.value = {1, 1, -small};
  d.row_lower = {1, -kInfinity};
  d.row_upper = {kInfinity, 0};
  return d;
}

TEST(IsContradiction, KnowsOfPointsThatAreFarAway) {
  const Answer a{{0, 0}, {0, 0}, {1, -1}, {}, Meaning::kContradiction};
  for (const double small : {1.0, 1e-3, 1e-6, 1e-8}) {
    EXPECT_FALSE(IsContradiction(FarAway(small), a)) << small;
  }
  EXPECT_TRUE(IsContradiction(FarAway(0), a));
}

TEST(IsContradiction, TakesNoInfinityOrNaN) {
  Random random(1);
  const KnownAnswer known = testing::KnownContradiction(ShapeOf(1), random);
  for (const double wrong : {kInfinity, kNaN}) {
    Answer a = AnswerOf(known.at, Meaning::kContradiction, known.problem);
    a.row_dual[0] = wrong;
    EXPECT_FALSE(IsContradiction(known.problem, a)) << wrong;
  }
}

KnownAnswer SomeRay(unsigned seed, Random& random) {
  testing::Shape shape = ShapeOf(seed);
  shape.quadratic = seed % 2 == 0;
  return testing::KnownRay(shape, random);
}

TEST(IsRay, TakesGoodOnesOfAnySize) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    Random random(seed);
    const KnownAnswer known = SomeRay(seed, random);
    for (const double unit : {1.0, 1e-6, 1e8}) {
      Answer a = AnswerOf(known.at, Meaning::kRay, known.problem);
      Scale(a, unit);
      EXPECT_TRUE(IsRay(known.problem, a)) << "seed " << seed << " times " << unit;
    }
  }
}

TEST(IsRay, TakesNoneThatIsWrongInOneWay) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const KnownAnswer known = SomeRay(seed, random);
    const Answer good = AnswerOf(known.at, Meaning::kRay, known.problem);
    for (const double factor : {0.0, -1.0, kNaN, kInfinity}) {
      Answer a = good;
      Scale(a, factor);
      EXPECT_FALSE(IsRay(known.problem, a)) << "times " << factor;
    }
    const std::size_t last = good.x.size() - 1;  // where it is 1
    {
      ProblemData d = known.problem;
      d.x_upper[last] = 1e3;
      EXPECT_FALSE(IsRay(d, good)) << "a bound stops it";
    }
    {
      ProblemData d = known.problem;
      std::size_t row = 0;
      while (std::abs(testing::Product(d.A, good.x)[row]) < 1e-3) ++row;
      d.row_lower[row] = -1e3;
      d.row_upper[row] = 1e3;
      EXPECT_FALSE(IsRay(d, good)) << "a row stops it";
    }
    {
      ProblemData d = known.problem;
      d.q[last] += 1;
      EXPECT_FALSE(IsRay(d, good)) << "it gains nothing";
    }
    {
      ProblemData d = known.problem;
      for (std::size_t i = 0; i < 4; ++i) d.F.value[d.F.start[last] + i] -= i == 0 ? 1e-2 : 0;
      EXPECT_FALSE(IsRay(d, good)) << "it leaves a cone";
    }
    {
      ProblemData d = known.problem;
      Csc unit(d.num_vars, d.num_vars);
      for (std::int32_t j = 0; j < d.num_vars; ++j) {
        unit.row.push_back(j);
        unit.value.push_back(1e-2);
        unit.start[static_cast<std::size_t>(j) + 1] = j + 1;
      }
      d.P = unit;
      EXPECT_FALSE(IsRay(d, good)) << "a curvature stops it";
    }
  }
}

TEST(ErrorsOf, AreNothingAtAKnownOptimumAndItsObjectivesAreThose) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    testing::Shape shape = ShapeOf(seed);
    shape.quadratic = seed % 2 == 0;
    const KnownAnswer known = testing::KnownOptimum(shape, random);
    const AnswerErrors errors =
        ErrorsOf(known.problem, AnswerOf(known.at, Meaning::kOptimum, known.problem));
    const double size = 1 + SizeOf(known.problem, known.at);
    EXPECT_LE(errors.Worst(), 1e-12 * size);
    EXPECT_NEAR(errors.objective, OptimumOf(known), 1e-12 * size * size);
    EXPECT_NEAR(errors.dual_objective, OptimumOf(known), 1e-12 * size * size);
  }
}

TEST(ErrorsOf, SeeEachThingThatIsWrong) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const KnownAnswer known = testing::KnownOptimum(ShapeOf(seed), random);
    const ProblemData& d = known.problem;
    const Answer good = AnswerOf(known.at, Meaning::kOptimum, d);
    const double relative = 1e-2 / (1 + SizeOf(d, known.at) * 4);
    for (const double by : {1e-2, -1e-2}) {
      Answer moved = good;
      for (double& x : moved.x) x += by;
      Vectors point;
      point.x = moved.x;
      const double primal = ErrorsOf(d, moved).primal;
      EXPECT_GE(primal * (1 + 4 * SizeOf(d, point) * d.num_vars),
                testing::PrimalError(d, moved.x) * 0.99);
      EXPECT_LE(primal, testing::PrimalError(d, moved.x));
      Answer dual = good;
      dual.x_dual[3] += by;
      EXPECT_GE(ErrorsOf(d, dual).dual, relative) << "stationarity";
    }
    Answer out = good;
    out.cone_dual[0] -= 1;  // of the second-order cone
    EXPECT_GE(ErrorsOf(d, out).dual, relative) << "dual cone";
    Answer worth = good;
    ProblemData other = d;
    other.offset += 7;
    EXPECT_NEAR(ErrorsOf(other, worth).objective - ErrorsOf(d, worth).objective, 7, 1e-9);
    EXPECT_LE(ErrorsOf(other, worth).gap, 1e-9 * SizeOf(d, known.at)) << "the offset is no gap";
  }
}

TEST(ErrorsOf, AreInfiniteWhereAnEntryIsNaN) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const KnownAnswer known = testing::KnownOptimum(ShapeOf(seed), random);
    Answer a = AnswerOf(known.at, Meaning::kOptimum, known.problem);
    int which = 0;
    for (auto* v : {&a.x, &a.x_dual, &a.row_dual, &a.cone_dual}) {
      const double before = (*v)[1];
      (*v)[1] = kNaN;
      EXPECT_EQ(ErrorsOf(known.problem, a).Worst(), kInfinity) << "vector " << which;
      (*v)[1] = before;
      ++which;
    }
  }
}

TEST(ErrorsOf, LookPastConesThatAreOff) {
  Random random(5);
  KnownAnswer known = testing::KnownOptimum(ShapeOf(1), random);
  Answer a = AnswerOf(known.at, Meaning::kOptimum, known.problem);
  known.problem.g[0] -= 100;
  EXPECT_GT(ErrorsOf(known.problem, a).primal, 1e-2);
  known.problem.cone_on.assign(known.problem.cones.size(), 1);
  known.problem.cone_on[0] = 0;
  EXPECT_LE(ErrorsOf(known.problem, a).primal, 1e-12);
}

TEST(CloseStationarity, LeavesNothingOfItAndADualObjectiveBelowTheOptimum) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    testing::Shape shape = ShapeOf(seed);
    shape.quadratic = true;
    const KnownAnswer known = Boxed(testing::KnownOptimum(shape, random), random);
    const ProblemData& d = known.problem;
    Answer a = AnswerOf(known.at, Meaning::kOptimum, d);
    for (double& x : a.x) x += 0.1 * random.Normal();
    for (double& y : a.row_dual) y *= random.Uniform(0.8, 1.2);
    for (double& z : a.cone_dual) z *= 1.1;  // stays in the dual cone
    a.x_dual.assign(a.x.size(), kNaN);
    CloseStationarity(d, a);
    const AnswerErrors errors = ErrorsOf(d, a);
    EXPECT_LE(errors.dual, 1e-12);
    EXPECT_LE(errors.dual_objective, OptimumOf(known) + 1e-9);
  }
}

}  // namespace
}  // namespace switchyard::conic
