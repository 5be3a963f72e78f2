// Each term of a program, lowered, against its own evaluation at random points.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "core/lower/lowering.hpp"
#include "tests/support/answer_errors.hpp"

namespace switchyard::testing {
namespace {

Eigen::VectorXd Normals(Random& random, Eigen::Index n) {
  Eigen::VectorXd v(n);
  for (double& e : v) e = random.Normal();
  return v;
}

Eigen::MatrixXd Matrix(Random& random, Eigen::Index rows, Eigen::Index cols) {
  return Normals(random, rows * cols).reshaped(rows, cols);
}

/// Three vectors of variables, so that the columns of a binding are not those of the program; and
/// a list in which one variable stands twice.
struct Fixture {
  MathematicalProgram program;
  VectorXDecisionVariable x = program.NewContinuousVariables(4, "x");
  VectorXDecisionVariable y = program.NewContinuousVariables(3, "y");
  VariableList mixed{y, x.head(2)};
  VariableList twice{x.head(2), x.head(1)};
  Random random{11};
};

Vector AsVector(const Eigen::VectorXd& x) { return Vector(x.data(), x.data() + x.size()); }

double LoweredObjective(const Lowering& lowering, const MathematicalProgram& program,
                        const Eigen::VectorXd& x) {
  const Vector all = lowering.Extend(program, x);
  const double value = Objective(lowering.problem().view(), all.data());
  return lowering.maximize() ? -value : value;
}

using Add = std::function<void(Fixture&, const VariableList&, Eigen::Index)>;

struct Term {
  const char* name;
  Add add;
};

void PrintTo(const Term& term, std::ostream* out) { *out << term.name; }

class CostTerm : public ::testing::TestWithParam<Term> {};

// The point with the epigraph variables at their least is feasible, and costs what the program
// says.
TEST_P(CostTerm, CostsWhatTheProgramSays) {
  Fixture f;
  GetParam().add(f, f.mixed, 5);
  GetParam().add(f, f.twice, 3);
  const Lowering lowering(f.program);
  for (int k = 0; k < 30; ++k) {
    const Eigen::VectorXd x = Normals(f.random, f.program.num_vars());
    const double cost = f.program.EvalCosts(x);
    if (std::isinf(cost)) continue;
    EXPECT_NEAR(LoweredObjective(lowering, f.program, x), cost, 1e-11 * (1 + std::abs(cost)));
    EXPECT_LT(PrimalError(lowering.problem().data(), lowering.Extend(f.program, x)),
              1e-11 * (1 + std::abs(cost)));
  }
}

// An epigraph variable a little below its least value is infeasible: it is the least.
TEST_P(CostTerm, HasAnEpigraphThatIsTight) {
  Fixture f;
  GetParam().add(f, f.mixed, 5);
  const Lowering lowering(f.program);
  const auto vars = static_cast<std::size_t>(f.program.num_vars());
  for (int k = 0; k < 10; ++k) {
    const Eigen::VectorXd x = Normals(f.random, f.program.num_vars());
    Vector all = lowering.Extend(f.program, x);
    for (std::size_t t = vars; t < all.size(); ++t) {
      if (!std::isfinite(all[t])) continue;
      const double kept = all[t];
      all[t] -= 1e-3 * (1 + std::abs(kept));
      EXPECT_GT(PrimalError(lowering.problem().data(), all), 1e-6);
      all[t] = kept;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Each, CostTerm,
    ::testing::Values(
        Term{"linear",
             [](Fixture& f, const VariableList& v, Eigen::Index n) {
               f.program.AddLinearCost(Normals(f.random, n), 2.5, v);
             }},
        Term{"quadratic",
             [](Fixture& f, const VariableList& v, Eigen::Index n) {
               f.program.AddQuadraticCost(Matrix(f.random, n, n), Normals(f.random, n), -1, v);
             }},
        Term{"l1",
             [](Fixture& f, const VariableList& v, Eigen::Index n) {
               f.program.AddCost(CreateBinding(
                   std::make_shared<L1NormCost>(Matrix(f.random, 4, n), Normals(f.random, 4)), v));
             }},
        Term{"l2",
             [](Fixture& f, const VariableList& v, Eigen::Index n) {
               f.program.AddL2NormCost(Matrix(f.random, 4, n), Normals(f.random, 4), v);
             }},
        Term{"linf",
             [](Fixture& f, const VariableList& v, Eigen::Index n) {
               f.program.AddCost(CreateBinding(
                   std::make_shared<LInfNormCost>(Matrix(f.random, 4, n), Normals(f.random, 4)),
                   v));
             }},
        Term{"perspective",
             [](Fixture& f, const VariableList& v, Eigen::Index n) {
               Eigen::VectorXd b = Normals(f.random, 4);
               b[0] = 3;
               f.program.AddCost(CreateBinding(
                   std::make_shared<PerspectiveQuadraticCost>(Matrix(f.random, 4, n), b), v));
             }}),
    [](const ::testing::TestParamInfo<Term>& term) { return std::string(term.param.name); });

TEST(Lowering, MaximizingIsMinimizingTheNegative) {
  Fixture f;
  f.program.AddLinearCost(Normals(f.random, 5), 1, f.mixed);
  f.program.AddQuadraticCost(Matrix(f.random, 5, 5), Normals(f.random, 5), 2, f.mixed);
  f.program.set_objective_sense(ObjectiveSense::kMaximize);
  const Lowering lowering(f.program);
  ASSERT_TRUE(lowering.maximize());
  for (int k = 0; k < 10; ++k) {
    const Eigen::VectorXd x = Normals(f.random, 7);
    EXPECT_NEAR(LoweredObjective(lowering, f.program, x), f.program.EvalCosts(x), 1e-11);
  }
}

TEST(Lowering, RefusesANormThatIsMaximized) {
  Fixture f;
  auto cost = f.program.AddL2NormCost(Matrix(f.random, 2, 5), Normals(f.random, 2), f.mixed);
  cost.evaluator()->set_description("effort");
  f.program.set_objective_sense(ObjectiveSense::kMaximize);
  try {
    const Lowering lowering(f.program);
    FAIL() << "nothing was thrown";
  } catch (const InvalidArgument& e) {
    EXPECT_STREQ(e.what(), "effort: a norm cannot be maximized; the objective is to be maximized");
  }
}

TEST(Lowering, IsConvexWhereEveryCostIsInTheSenseOfTheObjective) {
  const auto convex = [](double first, double second, ObjectiveSense sense) {
    MathematicalProgram program;
    const auto x = program.NewContinuousVariables(2);
    program.set_objective_sense(sense);
    for (const double w : {first, second}) {
      program.AddQuadraticErrorCost(w, Eigen::Vector2d::Zero(), x);
    }
    const Lowering lowering(program);
    return (lowering.problem().view().flags & SY_PROBLEM_CONVEX) != 0;
  };
  EXPECT_TRUE(convex(1, 2, ObjectiveSense::kMinimize));
  EXPECT_FALSE(convex(1, -2, ObjectiveSense::kMinimize));
  EXPECT_FALSE(convex(1, 2, ObjectiveSense::kMaximize));
  EXPECT_TRUE(convex(-1, -2, ObjectiveSense::kMaximize));
}

TEST(Lowering, RowsHaveTheValuesAndSidesOfTheirConstraints) {
  Fixture f;
  const Eigen::Vector3d lower(-1, -kInfinity, 2);
  const Eigen::Vector3d upper(1, 5, kInfinity);
  const auto a = f.program.AddLinearConstraint(Matrix(f.random, 3, 5), lower, upper, f.mixed);
  f.program.AddL2NormCost(Matrix(f.random, 2, 3), Normals(f.random, 2), f.twice);
  const auto b =
      f.program.AddLinearEqualityConstraint(Matrix(f.random, 2, 3), Normals(f.random, 2), f.twice);
  const Lowering lowering(f.program);
  const ProblemData& d = lowering.problem().data();
  EXPECT_EQ(Vector(d.row_lower.begin(), d.row_lower.begin() + 3), AsVector(lower));
  EXPECT_EQ(Vector(d.row_upper.begin(), d.row_upper.begin() + 3), AsVector(upper));
  EXPECT_EQ(Vector(d.row_lower.begin() + 3, d.row_lower.end()),
            AsVector(b.evaluator()->lower_bound()));
  const Eigen::VectorXd x = Normals(f.random, 7);
  const Vector rows = Product(d.A, lowering.Extend(f.program, x));
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(lowering.FirstRow(0), 0);
  EXPECT_EQ(lowering.FirstRow(1), 3);
  const Eigen::VectorXd ya = f.program.EvalBinding(a, x);
  const Eigen::VectorXd yb = f.program.EvalBinding(b, x);
  for (Eigen::Index i = 0; i < 3; ++i) EXPECT_NEAR(rows[static_cast<std::size_t>(i)], ya[i], 1e-12);
  for (Eigen::Index i = 0; i < 2; ++i) {
    EXPECT_NEAR(rows[static_cast<std::size_t>(i) + 3], yb[i], 1e-12);
  }
}

/// Every kind of cone, on five variables or, a matrix of variables, on symmetric ones.
struct Cones : Fixture {
  Cones() {
    const auto affine = [&](int rows) { return Matrix(random, rows, 5); };
    program.AddLorentzConeConstraint(affine(4), Normals(random, 4), mixed);
    program.AddRotatedLorentzConeConstraint(affine(4), Normals(random, 4), mixed);
    program.AddExponentialConeConstraint(affine(3), Normals(random, 3), mixed);
    program.AddPowerConeConstraint(affine(3), Normals(random, 3), 0.3, mixed);
    program.AddPositiveSemidefiniteConstraint(program.NewSymmetricContinuousVariables(3, "S"));
    std::vector<Eigen::MatrixXd> F;
    for (int k = 0; k < 6; ++k) {
      const Eigen::MatrixXd G = Matrix(random, 3, 3);
      F.push_back(G + G.transpose());
    }
    program.AddLinearMatrixInequalityConstraint(F, mixed);
  }
};

TEST(Lowering, ConesAreAsFarFromAPointAsTheProgramSays) {
  Cones f;
  const Lowering lowering(f.program);
  const ProblemData& d = lowering.problem().data();
  ASSERT_EQ(d.cones.size(), 6u);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::VectorXd x = Normals(f.random, f.program.num_vars());
    Vector s = Product(d.F, lowering.Extend(f.program, x));
    for (std::size_t i = 0; i < s.size(); ++i) s[i] += d.g[i];
    for (std::size_t k = 0; k < d.cones.size(); ++k) {
      const auto& binding = f.program.cone_constraints()[k];
      const auto first = static_cast<std::size_t>(lowering.FirstConeRow(k));
      const double violation =
          FactsOf(d.cones[k].kind).violation(&s[first], d.cones[k].dim, d.cones[k].parameter);
      const Eigen::VectorXd values = f.program.ValuesOf(binding.variables(), x);
      EXPECT_NEAR(violation, binding.evaluator()->Violation(values), 1e-10);
    }
  }
}

// A dual in the user's coordinates has the pairing that it has in the ABI's: <y, z> = <zeta, s>.
TEST(Lowering, DualsOfConesKeepTheirPairing) {
  Cones f;
  const Lowering lowering(f.program);
  const ProblemData& d = lowering.problem().data();
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::VectorXd x = Normals(f.random, f.program.num_vars());
    Vector s = Product(d.F, lowering.Extend(f.program, x));
    for (std::size_t i = 0; i < s.size(); ++i) s[i] += d.g[i];
    for (std::size_t k = 0; k < d.cones.size(); ++k) {
      const auto& binding = f.program.cone_constraints()[k];
      const Eigen::VectorXd zeta = Normals(f.random, d.cones[k].dim);
      const auto first = static_cast<std::size_t>(lowering.FirstConeRow(k));
      const double paired = zeta.dot(Eigen::Map<const Eigen::VectorXd>(&s[first], zeta.size()));
      EXPECT_NEAR(binding.evaluator()->DualInUserFrame(zeta).dot(f.program.EvalBinding(binding, x)),
                  paired, 1e-10);
    }
  }
}

TEST(Lowering, BoundsAreWhatAllBoxesLeave) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(3);
  const auto b = program.NewBinaryVariables(1);
  program.NewIntegerVariables(1);
  program.AddBoundingBoxConstraint(0, 5, x);
  program.AddBoundingBoxConstraint(1, kInfinity, VariableList{x[1]});
  program.AddBoundingBoxConstraint(Eigen::Vector3d(2, -1, 3), Eigen::Vector3d(9, 4, 8),
                                   VariableList{x[2], x[0], x[2]});  // one variable twice
  program.AddBoundingBoxConstraint(-3, 0.5, VariableList{b[0]});
  const Lowering lowering(program);
  const ProblemData& d = lowering.problem().data();
  EXPECT_EQ(d.x_lower, (Vector{0, 1, 3, 0, -kInfinity}));
  EXPECT_EQ(d.x_upper, (Vector{4, 5, 5, 0.5, kInfinity}));
  EXPECT_EQ(d.integer, (std::vector<std::uint8_t>{0, 0, 0, 1, 1}));
  EXPECT_EQ(lowering.crossed_variable(), -1);
}

TEST(Lowering, NamesTheFirstVariableWhoseBoundsExcludeEachOther) {
  MathematicalProgram program;
  const auto x = program.NewContinuousVariables(3);
  program.AddBoundingBoxConstraint(0, 1, x);
  program.AddBoundingBoxConstraint(2, 3, x.tail(2));
  EXPECT_EQ(Lowering(program).crossed_variable(), 1);
}

TEST(Lowering, AStartIsUnknownWhereThePointIsAndWhereAnEpigraphIsInfinite) {
  Fixture f;
  f.program.AddL2NormCost(Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero(), f.x.head(2));
  f.program.AddCost(CreateBinding(
      std::make_shared<L1NormCost>(Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero()),
      f.x.head(2)));
  f.program.AddCost(CreateBinding(std::make_shared<PerspectiveQuadraticCost>(
                                      Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero()),
                                  f.y.head(2)));
  const Lowering lowering(f.program);
  Eigen::VectorXd x = Eigen::VectorXd::Constant(7, 3);
  x[1] = std::nan("");
  x[4] = -1;  // y_0 < 0: outside the domain of the perspective
  const Vector all = lowering.Extend(f.program, x);
  ASSERT_EQ(all.size(), 7u + 1 + 2 + 1);
  EXPECT_EQ(all[0], 3);
  EXPECT_TRUE(std::isnan(all[1]));
  EXPECT_TRUE(std::isnan(all[7])) << "|(3, NaN)|";
  EXPECT_EQ(all[8], 3);
  EXPECT_TRUE(std::isnan(all[9]));
  EXPECT_TRUE(std::isnan(all[10])) << "an infinite perspective is no start";
}

}  // namespace
}  // namespace switchyard::testing
