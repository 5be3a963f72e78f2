// Programs without an optimum, and programs whose functions are not defined everywhere.
#include <cmath>
#include <numbers>

#include "tests/nonlinear_suite/suite.hpp"
#include "tests/nonlinear_suite/terms.hpp"

namespace switchyard::testing {
namespace {

/// x where x^2 + 1 <= 0.
ProgramPtr SquareBelowMinusOne() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(1);
  program->AddLinearCost(OneNumber(1), x);
  AddAtMost(
      *program, [](const auto& v) { return v[0] * v[0] + 1; }, 0, x, Curvature::kConvex);
  return program;
}

/// x + y in the unit discs around (0, 0) and (3, 0).
ProgramPtr DisjointDiscs() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(2);
  program->AddLinearCost(Eigen::Vector2d(1, 1), x);
  AddSquaresAtMost(*program, Eigen::Vector2d(1, 1), Eigen::Vector2d::Zero(), 1, x);
  AddSquaresAtMost(*program, Eigen::Vector2d(1, 1), Eigen::Vector2d(-6, 0), -8, x);
  return program;
}

/// x where x^2 + y^2 = 1 and x y = 2: but x y <= (x^2 + y^2) / 2.
ProgramPtr InconsistentEquations() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(2);
  program->AddLinearCost(OneNumber(1), x.head(1));
  program->AddConstraint(
      [](const auto& v) {
        return std::vector{v[0] * v[0] + v[1] * v[1], v[0] * v[1]};
      },
      Eigen::Vector2d(1, 2), Eigen::Vector2d(1, 2), x);
  return program;
}

/// x^2 + y^2 - log(x + y - 1), |x|, |y| <= 2. At x = y = t: 4 t^2 - 2 t - 1 = 0, so t is half the
/// golden ratio phi, and the value is phi^2 / 2 + log(phi).
ProgramPtr LogOfAPart() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(2);
  program->AddQuadraticCost(2 * Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero(), x);
  AddConvexCost(
      *program, [](const auto& v) { return -log(v[0] + v[1] - 1); }, x);
  program->AddBoundingBoxConstraint(-2, 2, x);
  return program;
}

/// -sqrt(x) - sqrt(y) where x + 2 y <= 3, x, y >= 0: by Cauchy and Schwarz -sqrt(9/2), at (2, 1/2).
/// At the start, 0, the derivatives are infinite.
ProgramPtr RootsAtTheirBoundary() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(2);
  AddConvexCost(
      *program, [](const auto& v) { return -sqrt(v[0]) - sqrt(v[1]); }, x);
  program->AddLinearConstraint(Eigen::RowVector2d(1, 2), -kInf, 3, x);
  program->AddBoundingBoxConstraint(0, kInf, x);
  return program;
}

/// x + 1 / x, 0 <= x <= 10: 2 at 1.
ProgramPtr Reciprocal() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(1);
  AddConvexCost(
      *program, [](const auto& v) { return v[0] + 1 / v[0]; }, x);
  program->AddBoundingBoxConstraint(0, 10, x);
  return program;
}

/// x - log(x): 1 at 1. No bound keeps a solver from x < 0.
ProgramPtr StartWithoutAValue() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(1);
  AddConvexCost(
      *program, [](const auto& v) { return v[0] - log(v[0]); }, x);
  return program;
}

/// Maximize x y where x - y <= 1.
ProgramPtr Unbounded() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(2);
  program->set_objective_sense(ObjectiveSense::kMaximize);
  program->AddCost([](const auto& v) { return v[0] * v[1]; }, x);
  program->AddLinearConstraint(Eigen::RowVector2d(1, -1), -kInf, 1, x);
  return program;
}

/// exp(x + y) + exp(-x - y): 2 wherever x + y = 0.
ProgramPtr Valley() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(2);
  AddConvexCost(
      *program, [](const auto& v) { return exp(v[0] + v[1]) + exp(-v[0] - v[1]); }, x);
  return program;
}

}  // namespace

std::vector<KnownProgram> AwkwardPrograms() {
  constexpr auto kFree = Conditions::kNone;
  constexpr auto kBounded = Conditions::kBounds;
  constexpr auto kBelow = Conditions::kInequalities;
  constexpr auto kEqual = Conditions::kEqualities;
  constexpr auto kNone = Answer::kInfeasible;
  constexpr auto kHas = Answer::kOptimum;
  constexpr double phi = std::numbers::phi;
  const double log_of_part = phi * phi / 2 + std::log(phi);
  const double roots = -std::sqrt(4.5);
  const std::string here = "elementary; see its comment";
  constexpr unsigned kOdd = kConvex | kUndefinedStart;
  constexpr unsigned kInBox = kConvex | kBox;
  return {
      {"SquareBelowMinusOne", here, kBelow, kConvex, kNone, kNoValue, {1}, SquareBelowMinusOne},
      {"DisjointDiscs", here, kBelow, kConvex, kNone, kNoValue, {1, 1}, DisjointDiscs},
      {"InconsistentEquations", here, kEqual, 0, kNone, kNoValue, {1, 1}, InconsistentEquations},
      {"LogOfAPart", here, kBounded, kInBox, kHas, log_of_part, {1.5, 1}, LogOfAPart},
      {"RootsAtTheirBoundary", here, kBelow, kOdd, kHas, roots, {0, 0}, RootsAtTheirBoundary},
      {"Reciprocal", here, kBounded, kInBox, kHas, 2, {5}, Reciprocal},
      {"StartWithoutAValue", here, kFree, kOdd, kHas, 1, {-1}, StartWithoutAValue},
      {"Unbounded", here, kBelow, 0, Answer::kUnbounded, kNoValue, {2, 1}, Unbounded},
      {"Valley", here, kFree, kConvex, kHas, 2, {1, 2}, Valley},
  };
}

}  // namespace switchyard::testing
