// Duals are shadow prices: against what the optimum does when a right-hand side moves a little, for
// every class of program and every backend that gives duals for it.
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "switchyard/solve/solve.hpp"
#include "tests/nonlinear/backends.hpp"

namespace switchyard::testing {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

Eigen::VectorXd One(double value) { return Eigen::VectorXd::Constant(1, value); }

/// A program with a side to move: the derivative of its optimum by `shift` is weights'dual.
struct Moved {
  MathematicalProgram program;
  std::unique_ptr<Binding<Constraint>> constraint;
  Eigen::VectorXd weights;  // d(optimum)/d(shift) = weights'dual; of a cone -b moves
};

struct Case {
  const char* name;
  std::function<void(Moved&, double shift)> build;
};

void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

void Watch(Moved& m, const Binding<Constraint>& binding, const Eigen::VectorXd& weights) {
  m.constraint = std::make_unique<Binding<Constraint>>(binding);
  m.weights = weights;
}

void LinearRow(Moved& m, double shift) {
  const auto x = m.program.NewContinuousVariables(2, "x");
  m.program.AddBoundingBoxConstraint(0, 10, x);
  m.program.AddLinearCost(Eigen::Vector2d(2, 3), x);
  Watch(m, m.program.AddLinearConstraint(Eigen::RowVector2d(1, 2), 4 + shift, kInf, x), One(1));
}

void LinearUpperSideMaximized(Moved& m, double shift) {
  const auto x = m.program.NewContinuousVariables(2, "x");
  m.program.set_objective_sense(ObjectiveSense::kMaximize);
  m.program.AddBoundingBoxConstraint(0, 10, x);
  m.program.AddLinearCost(Eigen::Vector2d(2, 3), x);
  Watch(m, m.program.AddLinearConstraint(Eigen::RowVector2d(1, 2), -kInf, 4 + shift, x), One(1));
}

void Bound(Moved& m, double shift) {
  const auto x = m.program.NewContinuousVariables(2, "x");
  m.program.AddLinearCost(Eigen::Vector2d(2, -3), x);
  Watch(m,
        m.program.AddBoundingBoxConstraint(Eigen::Vector2d(1 + shift, 0),
                                           Eigen::Vector2d(5, 4 + shift), x),
        Eigen::Vector2d(1, 1));
}

void QuadraticCostOverAnEquation(Moved& m, double shift) {
  const auto x = m.program.NewContinuousVariables(2, "x");
  m.program.AddQuadraticCost(Eigen::Matrix2d{{2, 0.5}, {0.5, 1}}, Eigen::Vector2d(1, -1), x);
  Watch(m, m.program.AddLinearEqualityConstraint(Eigen::RowVector2d(1, 1), 2 + shift, x), One(1));
}

void LorentzCone(Moved& m, double shift) {
  const auto x = m.program.NewContinuousVariables(2, "x");
  m.program.AddLinearCost(Eigen::Vector2d(-3, -4), x);
  Eigen::MatrixXd A(3, 2);
  A << 0, 0, 1, 0, 0, 1;
  Watch(m, m.program.AddLorentzConeConstraint(A, Eigen::Vector3d(2 + shift, 0.3 * shift, 0), x),
        Eigen::Vector3d(-1, -0.3, 0));
}

void RotatedCone(Moved& m, double shift) {
  const auto x = m.program.NewContinuousVariables(3, "x");
  m.program.AddLinearCost(Eigen::Vector3d(1, 2, 0), x);
  m.program.AddLinearEqualityConstraint(Eigen::RowVector3d(0, 0, 1), 1, x);
  Watch(m,
        m.program.AddRotatedLorentzConeConstraint(Eigen::Matrix3d::Identity(),
                                                  Eigen::Vector3d(0, 0, shift), x),
        Eigen::Vector3d(0, 0, -1));
}

void QuadraticConstraintAlone(Moved& m, double shift) {
  const auto x = m.program.NewContinuousVariables(2, "x");
  m.program.AddLinearCost(Eigen::Vector2d(1, 1), x);
  Watch(m,
        m.program.AddQuadraticConstraint(Eigen::Matrix2d{{2, 0.5}, {0.5, 3}}, Eigen::Vector2d(1, 0),
                                         -kInf, 2 + shift, x),
        One(1));
}

void Semidefinite(Moved& m, double shift) {
  const auto x = m.program.NewContinuousVariables(1, "x");
  m.program.AddLinearCost(One(1), x);
  const Eigen::Matrix2d F0{{0, 1 + shift}, {1 + shift, 2}};
  const Eigen::Matrix2d F1{{1, 0}, {0, 0}};  // [x, 1; 1, 2] >= 0: x >= 1/2
  Watch(m, m.program.AddLinearMatrixInequalityConstraint({F0, F1}, x),
        Eigen::Vector4d(0, -1, -1, 0));
}

void ExponentialCone(Moved& m, double shift) {
  const auto x = m.program.NewContinuousVariables(1, "x");
  m.program.AddLinearCost(One(1), x);
  const Eigen::MatrixXd A = Eigen::Vector3d(1, 0, 0);  // x >= exp(1)
  Watch(m, m.program.AddExponentialConeConstraint(A, Eigen::Vector3d(0, 1, 1 + shift), x),
        Eigen::Vector3d(0, 0, -1));
}

void PowerCone(Moved& m, double shift) {
  const auto x = m.program.NewContinuousVariables(1, "x");
  m.program.AddLinearCost(One(1), x);
  const Eigen::MatrixXd A = Eigen::Vector3d(1, 0, 0);  // x^0.4 2^0.6 >= 3
  Watch(m, m.program.AddPowerConeConstraint(A, Eigen::Vector3d(0, 2, 3 + shift), 0.4, x),
        Eigen::Vector3d(0, 0, -1));
}

void Functions(Moved& m, double shift) {
  const auto x = m.program.NewContinuousVariables(2, "x");
  m.program.AddCost([](const auto& v) { return exp(v[0]) + exp(2 * v[1]); }, x,
                    {.is_convex = true});
  Watch(m,
        m.program.AddConstraint([](const auto& v) { return v[0] * v[0] + v[1] * v[1]; }, One(-kInf),
                                One(2 + shift), x, {.is_convex = true}),
        One(1));
}

void QuadraticRowBesideFunctions(Moved& m, double shift) {
  const auto x = m.program.NewContinuousVariables(2, "x");
  m.program.AddCost([](const auto& v) { return exp(v[0]) + exp(2 * v[1]); }, x);
  Watch(m,
        m.program.AddQuadraticConstraint(2 * Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero(),
                                         -kInf, 2 + shift, x),
        One(1));
}

void LinearRowBesideFunctions(Moved& m, double shift) {
  const auto x = m.program.NewContinuousVariables(2, "x");
  m.program.AddCost([](const auto& v) { return exp(v[0]) + exp(2 * v[1]); }, x);
  Watch(m, m.program.AddLinearConstraint(Eigen::RowVector2d(1, 1), 1 + shift, kInf, x), One(1));
}

const Case kCases[] = {
    {"LinearRow", LinearRow},
    {"LinearUpperSideMaximized", LinearUpperSideMaximized},
    {"Bound", Bound},
    {"QuadraticCostOverAnEquation", QuadraticCostOverAnEquation},
    {"LorentzCone", LorentzCone},
    {"RotatedCone", RotatedCone},
    {"QuadraticConstraintAlone", QuadraticConstraintAlone},
    {"Semidefinite", Semidefinite},
    {"ExponentialCone", ExponentialCone},
    {"PowerCone", PowerCone},
    {"Functions", Functions},
    {"QuadraticRowBesideFunctions", QuadraticRowBesideFunctions},
    {"LinearRowBesideFunctions", LinearRowBesideFunctions},
};

double Optimum(const Case& one, const SolverInterface& solver, double shift) {
  Moved moved;
  one.build(moved, shift);
  const auto result = solver.Solve(moved.program);
  EXPECT_TRUE(result.is_success()) << result.message;
  return result.objective;
}

class Dual : public ::testing::TestWithParam<std::tuple<Case, const char*>> {};

TEST_P(Dual, IsWhatTheOptimumGainsByItsSide) {
  const auto& [one, name] = GetParam();
  SKIP_WITHOUT(name);
  const SolverInterface solver(name, Built());
  if ((Built().Find(name)->facts.traits & SY_GIVES_DUALS) == 0) {
    GTEST_SKIP() << name << " gives no duals";
  }
  Moved moved;
  one.build(moved, 0);
  std::string why;
  if (!solver.Accepts(moved.program, &why)) GTEST_SKIP() << why;
  const auto result = solver.Solve(moved.program);
  ASSERT_TRUE(result.is_success()) << result.message;
  const double dual = moved.weights.dot(result.GetDualSolution(*moved.constraint));
  constexpr double kShift = 1e-3;
  const double slope =
      (Optimum(one, solver, kShift) - Optimum(one, solver, -kShift)) / (2 * kShift);
  EXPECT_NEAR(dual, slope, 2e-4 * (1 + std::abs(slope)));
  EXPECT_GT(std::abs(slope), 0.01) << "the side is not active: nothing is tested";
}

INSTANTIATE_TEST_SUITE_P(EveryClass, Dual,
                         ::testing::Combine(::testing::ValuesIn(kCases),
                                            ::testing::Values("highs", "clp", "cbc", "conic",
                                                              "clarabel", "ipopt", "nlopt")),
                         [](const auto& dual) {
                           return std::string(std::get<0>(dual.param).name) + "_" +
                                  std::get<1>(dual.param);
                         });

}  // namespace
}  // namespace switchyard::testing
