// Programs with little or nothing in them, and with more than is needed.
#include <gtest/gtest.h>

#include "tests/conic/programs.hpp"

namespace switchyard::conic {
namespace {

ProblemData Empty(std::int32_t vars) {
  ProblemData d;
  d.num_vars = vars;
  d.flags = SY_PROBLEM_CONVEX;
  d.P = Csc(vars, vars);
  d.A = Csc(0, vars);
  d.F = Csc(0, vars);
  d.q.assign(static_cast<std::size_t>(vars), 0.0);
  return d;
}

/// Solves with and without presolve.
template <class Check>
void Both(const ProblemData& d, Check&& check) {
  for (const int presolve : {0, 1}) {
    SCOPED_TRACE(presolve == 1 ? "with presolve" : "without presolve");
    check(Solver().Set("presolve", presolve).Load(d).Solve());
  }
}

TEST(Degenerate, NoVariablesCostTheOffset) {
  ProblemData d = Empty(0);
  d.offset = 4.5;
  Both(d, [&](const Found& found) {
    ExpectOptimal(d, found);
    EXPECT_EQ(found.result.objective, 4.5);
  });
}

TEST(Degenerate, NoVariablesAndRowsAndConesThatHold) {
  ProblemData d = Empty(0);
  d.A = Csc(2, 0);
  d.row_lower = {-1, 0};
  d.row_upper = {kInfinity, 0};
  d.F = Csc(3, 0);
  d.g = {2, 1, 1};
  d.cones = {SecondOrder(3)};
  Both(d, [&](const Found& found) { ExpectOptimal(d, found); });
}

TEST(Degenerate, NoVariablesAndARowThatDoesNotHold) {
  ProblemData d = Empty(0);
  d.A = Csc(2, 0);
  d.row_lower = {-1, 0.5};
  d.row_upper = {kInfinity, 2};
  Both(d, [&](const Found& found) { ExpectContradiction(d, found); });
}

TEST(Degenerate, NoVariablesAndAConeThatDoesNotHold) {
  for (const sy_cone& cone : {SecondOrder(3), Rotated(3), Semidefinite(2), Exponential()}) {
    SCOPED_TRACE(cone.kind);
    ProblemData d = Empty(0);
    d.F = Csc(3, 0);
    d.g = {1, -1, -1};
    d.cones = {cone};
    Both(d, [&](const Found& found) { ExpectContradiction(d, found); });
  }
}

TEST(Degenerate, FreeVariablesOfNoCost) {
  const ProblemData d = Empty(3);
  Both(d, [&](const Found& found) {
    ExpectOptimal(d, found);
    EXPECT_EQ(found.result.objective, 0);
  });
}

TEST(Degenerate, AFreeVariableOfSomeCost) {
  ProblemData d = Empty(3);
  d.q = {0, -2, 0};
  Both(d, [&](const Found& found) { ExpectRay(d, found); });
}

TEST(Degenerate, BoundsAlone) {
  ProblemData d = Empty(4);
  d.q = {1, -1, 0, 2};
  d.x_lower = {-3, -kInfinity, -kInfinity, 1};
  d.x_upper = {kInfinity, 5, kInfinity, 1};
  Both(d, [&](const Found& found) {
    ExpectOptimal(d, found);
    EXPECT_NEAR(found.result.objective, -6, 1e-6);
  });
}

TEST(Degenerate, AQuadraticObjectiveAlone) {
  Random random(3);
  testing::Shape shape{6, 0, {}};
  shape.quadratic = true;
  shape.bounds = false;
  const KnownAnswer known = testing::KnownOptimum(shape, random);
  Both(known.problem, [&](const Found& found) {
    ExpectOptimal(known.problem, found);
    ExpectSameOptimum(known.problem, found, OptimumOf(known));
  });
}

TEST(Degenerate, AllVariablesFixed) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    testing::Shape shape{7, 4, {SecondOrder(3), Exponential(), Semidefinite(2)}};
    shape.quadratic = true;
    KnownAnswer known = testing::KnownOptimum(shape, random);
    known.problem.x_lower = known.problem.x_upper = known.at.x;
    known.problem.q = random.Normals(7);
    Both(known.problem, [&](const Found& found) {
      ExpectOptimal(known.problem, found);
      ExpectSameOptimum(known.problem, found, OptimumOf(known));
    });
  }
}

TEST(Degenerate, AllVariablesFixedWhereARowForbidsIt) {
  ProblemData d = Empty(2);
  d.x_lower = d.x_upper = {1, 2};
  d.A = Csc(1, 2);
  d.A.start = {0, 1, 2};
  d.A.row = {0, 0};
  d.A.value = {1, 1};
  d.row_lower = {4};
  d.row_upper = {kInfinity};
  Both(d, [&](const Found& found) { ExpectContradiction(d, found); });
}

TEST(Degenerate, AllVariablesFixedOutsideACone) {
  ProblemData d = Empty(3);
  d.x_lower = d.x_upper = {1, 2, 0.5};
  d.F = Csc(3, 3);
  d.F.start = {0, 1, 2, 3};
  d.F.row = {0, 1, 2};
  d.F.value = {1, 1, 1};
  d.g = {0, 0, 0};
  d.cones = {SecondOrder(3)};
  Both(d, [&](const Found& found) { ExpectContradiction(d, found); });
}

/// Each row again as an equation, and sums of them, at sides that agree.
KnownAnswer WithRepeatedEquations(unsigned seed) {
  Random random(seed);
  KnownAnswer known = testing::KnownOptimum({10, 4, {SecondOrder(4)}}, random);
  ProblemData& d = known.problem;
  const Values Ax = testing::Product(d.A, known.at.x);
  Csc mixture(2, 4);
  mixture.start = {0, 1, 3, 4, 5};
  mixture.row = {0, 0, 1, 1, 1};
  mixture.value = {1, -2, 1, 3, -1};
  Csc sums(2, d.num_vars);
  for (std::int32_t j = 0; j < d.num_vars; ++j) {
    Values column(4, 0.0);
    for (std::int32_t k = d.A.start[j]; k < d.A.start[j + 1]; ++k)
      column[d.A.row[k]] = d.A.value[k];
    const Values sum = testing::Product(mixture, column);
    for (std::int32_t i = 0; i < 2; ++i) {
      sums.row.push_back(i);
      sums.value.push_back(sum[i]);
    }
    sums.start[j + 1] = static_cast<std::int32_t>(sums.row.size());
  }
  const Csc again = d.A;
  d.A = StackRows(StackRows(d.A, again), sums);
  const Values of_sums = testing::Product(mixture, Ax);
  d.row_lower = Ax;
  d.row_lower.insert(d.row_lower.end(), Ax.begin(), Ax.end());
  d.row_lower.insert(d.row_lower.end(), of_sums.begin(), of_sums.end());
  d.row_upper = d.row_lower;
  return known;
}

TEST(Degenerate, EquationsThatRepeat) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const KnownAnswer known = WithRepeatedEquations(seed);
    Both(known.problem, [&](const Found& found) {
      ExpectOptimal(known.problem, found);
      ExpectSameOptimum(known.problem, found, OptimumOf(known));
    });
  }
}

TEST(Degenerate, EquationsThatRepeatAndContradict) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    ProblemData d = WithRepeatedEquations(seed).problem;
    for (const double by : {0.5, 1e-3}) {
      SCOPED_TRACE(by);
      d.row_lower.back() += by;
      d.row_upper.back() += by;
      Both(d, [&](const Found& found) { ExpectContradiction(d, found); });
    }
  }
}

// Two rows of exact numbers.
TEST(Degenerate, TwoEquationsThatContradict) {
  for (const double room : {1.0, 10.0, kInfinity}) {
    SCOPED_TRACE(room);
    ProblemData d = Empty(2);
    d.q = {1, 2};
    d.x_lower = {-room, -room};
    d.x_upper = {room, room};
    d.A = Csc(2, 2);
    d.A.start = {0, 2, 4};
    d.A.row = {0, 1, 0, 1};
    d.A.value = {1, 1, 1, 1};
    d.row_lower = d.row_upper = {0.5, 1};
    Both(d, [&](const Found& found) {
      if (std::isinf(room) && found.result.termination == SY_UNBOUNDED) return ExpectRay(d, found);
      ExpectContradiction(d, found);
    });
  }
}

// The only feasible points are on the boundary: x_0 = x_1 in the cone x_0 >= |x_1|.
TEST(Degenerate, AConeWithoutAnInteriorPoint) {
  ProblemData d = Empty(3);
  d.q = {1, 0, 1};
  d.x_lower = {-kInfinity, 2, -4};
  d.x_upper = {kInfinity, kInfinity, 4};
  d.A = Csc(1, 3);
  d.A.start = {0, 1, 2, 2};
  d.A.row = {0, 0};
  d.A.value = {1, -1};
  d.row_lower = d.row_upper = {0};
  d.F = Csc(3, 3);
  d.F.start = {0, 1, 2, 3};
  d.F.row = {0, 1, 2};
  d.F.value = {1, 1, 1};
  d.g = {0, 0, 0};
  d.cones = {SecondOrder(3)};
  // The dual is not attained: to give up is an answer, a certificate is none.
  Both(d, [&](const Found& found) {
    if (found.result.termination != SY_NUMERICAL_TROUBLE) {
      EXPECT_EQ(found.result.termination, SY_OPTIMAL) << found.text;
    }
    EXPECT_EQ(found.result.primal, SY_FEASIBLE);
    EXPECT_NEAR(found.result.objective, 2, 1e-3);  // |x_2| is only known to the root of the error
    EXPECT_LE(testing::PrimalError(d, found.at.x), 1e-7);
    EXPECT_LE(found.result.bound, 2);
  });
}

}  // namespace
}  // namespace switchyard::conic
