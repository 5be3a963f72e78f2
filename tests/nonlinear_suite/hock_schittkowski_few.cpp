// Problems of two and three variables of W. Hock and K. Schittkowski, Test Examples for Nonlinear
// Programming Codes, Lecture Notes in Economics and Mathematical Systems 187, Springer 1981. Values
// without a closed form are those of a Newton iteration on the conditions of first order in 60
// digits.
#include <cmath>
#include <string>

#include "tests/nonlinear_suite/suite.hpp"
#include "tests/nonlinear_suite/terms.hpp"

namespace switchyard::testing {
namespace {

const auto kRosenbrock = [](const auto& x) {
  const auto t = x[1] - x[0] * x[0];
  const auto u = 1 - x[0];
  return 100 * t * t + u * u;
};

/// Rosenbrock's function where y >= 1.5. On the bound 400 x^3 - 598 x - 2 = 0, so that
/// x = 2 a cos(acos(1 / b) / 3) with a^2 = 598 / 1200, b = 400 a^3; the least root is a local
/// optimum.
ProgramPtr Hs2() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(2);
  program->AddCost(kRosenbrock, x);
  program->AddBoundingBoxConstraint(1.5, kInf, x.tail(1));
  return program;
}

/// With s = x + y and d = x - y: sin s + d^2 - 2 d + s / 2 + 1, stationary where d = 1 and
/// cos s = -1/2. In the box lie s = -2 pi / 3, the optimum -sqrt(3)/2 - pi/3, and s = 4 pi / 3.
ProgramPtr Hs5() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(2);
  program->AddCost(
      [](const auto& v) {
        const auto d = v[0] - v[1];
        return sin(v[0] + v[1]) + d * d - 1.5 * v[0] + 2.5 * v[1] + 1;
      },
      x);
  program->AddBoundingBoxConstraint(Eigen::Vector2d(-1.5, -3), Eigen::Vector2d(4, 3), x);
  return program;
}

/// (1 - x)^2 where 10 (y - x^2) = 0: 0 at (1, 1).
ProgramPtr Hs6() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(2);
  program->AddQuadraticErrorCost(1, OneNumber(1), x.head(1));
  program->AddQuadraticConstraint(Eigen::Matrix2d{{-20, 0}, {0, 0}}, Eigen::Vector2d(0, 10), 0, 0,
                                  x);
  return program;
}

/// log(1 + x^2) - y where (1 + x^2)^2 + y^2 = 4. With u = 1 + x^2 >= 1: log u - sqrt(4 - u^2)
/// grows with u, so -sqrt(3) at x = 0.
ProgramPtr Hs7() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(2);
  program->AddCost([](const auto& v) { return log(1 + v[0] * v[0]); }, x.head(1));
  program->AddLinearCost(OneNumber(-1), x.tail(1));
  AddEqual(
      *program,
      [](const auto& v) {
        const auto u = 1 + v[0] * v[0];
        return u * u + v[1] * v[1];
      },
      4, x);
  return program;
}

/// (x - 5)^2 + y^2 - 25 where x^2 <= y.
ProgramPtr Hs11() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(2);
  program->AddQuadraticCost(2 * Eigen::Matrix2d::Identity(), Eigen::Vector2d(-10, 0), x);
  AddSquaresAtMost(*program, Eigen::Vector2d(1, 0), Eigen::Vector2d(0, -1), 0, x);
  return program;
}

/// (x - 2)^2 + y^2 where (1 - x)^3 >= y and x, y >= 0: 1 at the cusp (1, 0), where the gradient of
/// the row is (0, -1) and no multipliers balance (-2, 0).
ProgramPtr Hs13() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(2);
  program->AddQuadraticErrorCost(1, Eigen::Vector2d(2, 0), x);
  AddAtLeast(
      *program,
      [](const auto& v) {
        const auto u = 1 - v[0];
        return u * u * u - v[1];
      },
      0, x);
  program->AddBoundingBoxConstraint(0, kInf, x);
  return program;
}

/// (x - 2)^2 + (y - 1)^2 where x - 2 y = -1 and x^2/4 + y^2 <= 1: at x = (sqrt(7) - 1) / 2,
/// y = (sqrt(7) + 1) / 4 it is 9 - 23 sqrt(7) / 8.
ProgramPtr Hs14() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(2);
  program->AddQuadraticErrorCost(1, Eigen::Vector2d(2, 1), x);
  program->AddLinearEqualityConstraint(Eigen::RowVector2d(1, -2), -1, x);
  AddSquaresAtMost(*program, Eigen::Vector2d(0.25, 1), Eigen::Vector2d::Zero(), 1, x);
  return program;
}

const auto kXPlusYSquared = [](const auto& v) { return v[0] + v[1] * v[1]; };

/// Rosenbrock's function where x y >= 1, x + y^2 >= 0, x <= 1/2: 306.5 at (1/2, 2), and a local
/// optimum at (-0.792, -1.262).
ProgramPtr Hs15() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(2);
  program->AddCost(kRosenbrock, x);
  program->AddQuadraticConstraint(Eigen::Matrix2d{{0, 1}, {1, 0}}, Eigen::Vector2d::Zero(), 1, kInf,
                                  x);
  AddAtLeast(*program, kXPlusYSquared, 0, x);
  program->AddBoundingBoxConstraint(-kInf, 0.5, x.head(1));
  return program;
}

/// Rosenbrock's function where x + y^2 >= 0, x^2 + y >= 0, -2 <= x <= 1/2, y <= 1: 1/4 at
/// (1/2, 1/4), and a local optimum at (-0.991, 0.995), where x + y^2 is 0.
ProgramPtr Hs16() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(2);
  program->AddCost(kRosenbrock, x);
  AddAtLeast(*program, kXPlusYSquared, 0, x);
  AddAtLeast(
      *program, [](const auto& v) { return v[0] * v[0] + v[1]; }, 0, x);
  program->AddBoundingBoxConstraint(Eigen::Vector2d(-2, -kInf), Eigen::Vector2d(0.5, 1), x);
  return program;
}

/// (x - y)^2 + (y - z)^4 where (1 + y^2) x + z^4 = 3: 0 at (1, 1, 1), where the Hessian is
/// singular, and at (a, a, a) for the other root a = -1.81
ProgramPtr Hs26() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(3);
  program->AddQuadraticCost(Eigen::Matrix2d{{2, -2}, {-2, 2}}, Eigen::Vector2d::Zero(), x.head(2));
  AddConvexCost(
      *program,
      [](const auto& v) {
        const auto d = v[0] - v[1];
        return d * d * d * d;
      },
      x.tail(2));
  AddEqual(
      *program, [](const auto& v) { return (1 + v[1] * v[1]) * v[0] + v[2] * v[2] * v[2] * v[2]; },
      3, x);
  return program;
}

/// -x y z where x^2 + 2 y^2 + 4 z^2 <= 48: by the means of 16, 16, 16 it is -16 sqrt(2), at
/// (4, 2 sqrt(2), 2) and with two signs changed.
ProgramPtr Hs29() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(3);
  program->AddCost([](const auto& v) { return -v[0] * v[1] * v[2]; }, x);
  AddSquaresAtMost(*program, Eigen::Vector3d(1, 2, 4), Eigen::Vector3d::Zero(), 48, x);
  return program;
}

/// (x - 1)(x - 2)(x - 3) + z where z^2 >= x^2 + y^2, x^2 + y^2 + z^2 >= 4, x, y >= 0, 0 <= z <= 5:
/// sqrt(2) - 6 at (0, sqrt(2), sqrt(2)); (0, 0, 2) satisfies the conditions of first order.
ProgramPtr Hs33() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(3);
  program->AddCost([](const auto& v) { return (v[0] - 1) * (v[0] - 2) * (v[0] - 3); }, x.head(1));
  program->AddLinearCost(OneNumber(1), x.tail(1));
  AddSquaresAtMost(*program, Eigen::Vector3d(1, 1, -1), Eigen::Vector3d::Zero(), 0, x);
  AddSquaresAtMost(*program, Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d::Zero(), -4, x);
  program->AddBoundingBoxConstraint(Eigen::Vector3d::Zero(), Eigen::Vector3d(kInf, kInf, 5), x);
  return program;
}

/// Beale: 9 - 8x - 6y - 4z + 2x^2 + 2y^2 + z^2 + 2xy + 2xz where x + y + 2z <= 3, all >= 0: 1/9 at
/// (4/3, 7/9, 4/9).
ProgramPtr Hs35() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(3);
  program->AddQuadraticCost(Eigen::Matrix3d{{4, 2, 2}, {2, 4, 0}, {2, 0, 2}},
                            Eigen::Vector3d(-8, -6, -4), 9, x);
  program->AddLinearConstraint(Eigen::RowVector3d(1, 1, 2), -kInf, 3, x);
  program->AddBoundingBoxConstraint(0, kInf, x);
  return program;
}

/// (x - y)^2 + (x + y - 10)^2 / 9 + (z - 5)^2 in the ball of radius sqrt(48), |x|, |y| <= 4.5,
/// |z| <= 5.
ProgramPtr Hs65() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(3);
  const Eigen::Matrix3d A{{1, -1, 0}, {1.0 / 3, 1.0 / 3, 0}, {0, 0, 1}};
  program->Add2NormSquaredCost(A, Eigen::Vector3d(0, 10.0 / 3, 5), x);
  AddSquaresAtMost(*program, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero(), 48, x);
  program->AddBoundingBoxConstraint(Eigen::Vector3d(-4.5, -4.5, -5), Eigen::Vector3d(4.5, 4.5, 5),
                                    x);
  return program;
}

std::string Number(int n) { return "Hock and Schittkowski 1981, problem " + std::to_string(n); }

}  // namespace

std::vector<KnownProgram> HockSchittkowskiOfFewVariables() {
  constexpr auto kBounded = Conditions::kBounds;
  constexpr auto kBelow = Conditions::kInequalities;
  constexpr auto kEqual = Conditions::kEqualities;
  constexpr auto kHas = Answer::kOptimum;
  return {
      {"HS2", Number(2), kBounded, 0, kHas, 0.050426187893607, {-2, 1}, Hs2, {4.9412293179892}},
      {"HS5", Number(5), kBounded, kBox, kHas, -1.9132229549810367, {0, 0}, Hs5, {1.2283696986088}},
      {"HS6", Number(6), kEqual, 0, kHas, 0, {-1.2, 1}, Hs6},
      {"HS7", Number(7), kEqual, 0, kHas, -std::sqrt(3.0), {2, 2}, Hs7},
      {"HS11", Number(11), kBelow, kConvex, kHas, -8.4984642231547, {4.9, 0.1}, Hs11},
      {"HS13", Number(13), kBelow, kNoMultipliers, kHas, 1, {-2, -2}, Hs13},
      {"HS14", Number(14), kEqual, kConvex, kHas, 9 - 2.875 * std::sqrt(7.0), {2, 2}, Hs14},
      {"HS15", Number(15), kBelow, 0, kHas, 306.5, {-2, 1}, Hs15, {360.37976717428}},
      {"HS16", Number(16), kBelow, 0, kHas, 0.25, {-2, 1}, Hs16, {3.9820604537555}},
      {"HS26", Number(26), kEqual, 0, kHas, 0, {-2.6, 2, 2}, Hs26},
      {"HS29", Number(29), kBelow, 0, kHas, -16 * std::sqrt(2.0), {1, 1, 1}, Hs29},
      {"HS33", Number(33), kBelow, 0, kHas, std::sqrt(2.0) - 6, {0, 0, 3}, Hs33, {-4}},
      {"HS35", Number(35), kBelow, kConvex, kHas, 1.0 / 9, {0.5, 0.5, 0.5}, Hs35},
      {"HS65", Number(65), kBelow, kConvex | kBox, kHas, 0.95352885680478, {-5, 5, 0}, Hs65},
  };
}

}  // namespace switchyard::testing
