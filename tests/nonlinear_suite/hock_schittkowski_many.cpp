// Problems of four to ten variables of W. Hock and K. Schittkowski, Test Examples for Nonlinear
// Programming Codes, Lecture Notes in Economics and Mathematical Systems 187, Springer 1981. Values
// without a closed form are those of a Newton iteration on the conditions of first order in 60
// digits.
#include <cmath>
#include <string>

#include "tests/nonlinear_suite/suite.hpp"
#include "tests/nonlinear_suite/terms.hpp"

namespace switchyard::testing {
namespace {

using Vector = Eigen::VectorXd;

/// Colville 4, Wood's function: 0 at (1, 1, 1, 1), in the box of +-10.
ProgramPtr Hs38() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(4);
  const auto banana = [](double weight) {
    return [weight](const auto& v) {
      const auto t = v[1] - v[0] * v[0];
      const auto u = 1 - v[0];
      return weight * t * t + u * u;
    };
  };
  program->AddCost(banana(100), x.head(2));
  program->AddCost(banana(90), x.tail(2));
  program->AddCost(
      [](const auto& v) {
        const auto a = v[0] - 1;
        const auto b = v[1] - 1;
        return 10.1 * (a * a + b * b) + 19.8 * a * b;
      },
      VariableList{x[1], x[3]});
  program->AddBoundingBoxConstraint(-10, 10, x);
  return program;
}

/// -x where y = x^3 + z^2 and x^2 = y + t^2: then x^3 <= x^2, so -1 at (1, 1, 0, 0).
ProgramPtr Hs39() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(4);
  program->AddLinearCost(OneNumber(-1), x.head(1));
  AddEqual(
      *program, [](const auto& v) { return v[1] - v[0] * v[0] * v[0] - v[2] * v[2]; }, 0,
      x.head(3));
  AddEqual(
      *program, [](const auto& v) { return v[0] * v[0] - v[1] - v[2] * v[2]; }, 0,
      VariableList{x[0], x[1], x[3]});
  return program;
}

/// -x y z t where x^3 + y^2 = 1, x^2 t = z, t^2 = y: by x^3 and y^2 it is -x^3 y^2, so -1/4 where
/// both are 1/2.
ProgramPtr Hs40() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(4);
  program->AddCost([](const auto& v) { return -v[0] * v[1] * v[2] * v[3]; }, x);
  program->AddConstraint(
      [](const auto& v) {
        return std::vector{v[0] * v[0] * v[0] + v[1] * v[1], v[0] * v[0] * v[3] - v[2],
                           v[3] * v[3] - v[1]};
      },
      Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1, 0, 0), x);
  return program;
}

/// Rosen and Suzuki: -44 at (0, 1, 2, -1), convex quadratics throughout.
ProgramPtr Hs43() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(4);
  program->AddQuadraticCost(Eigen::Matrix4d(Eigen::Vector4d(2, 2, 4, 2).asDiagonal()),
                            Eigen::Vector4d(-5, -5, -21, 7), x);
  AddSquaresAtMost(*program, Eigen::Vector4d(1, 1, 1, 1), Eigen::Vector4d(1, -1, 1, -1), 8, x);
  AddSquaresAtMost(*program, Eigen::Vector4d(1, 2, 1, 2), Eigen::Vector4d(-1, 0, 0, -1), 10, x);
  AddSquaresAtMost(*program, Eigen::Vector4d(2, 1, 1, 0), Eigen::Vector4d(2, -1, 0, -1), 5, x);
  return program;
}

/// An indefinite quadratic over a polytope: -15 at the vertex (0, 3, 0, 4), and a local optimum
/// -13 at (3, 0, 4, 0).
ProgramPtr Hs44() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(4);
  program->AddQuadraticCost(
      Eigen::Matrix4d{{0, 0, -1, 1}, {0, 0, 1, -1}, {-1, 1, 0, 0}, {1, -1, 0, 0}},
      Eigen::Vector4d(1, -1, -1, 0), x);
  const Eigen::MatrixXd A{{1, 2, 0, 0}, {4, 1, 0, 0}, {3, 4, 0, 0},
                          {0, 0, 2, 1}, {0, 0, 1, 2}, {0, 0, 1, 1}};
  program->AddLinearConstraint(A, Vector::Constant(6, -kInf), Vector{{8, 12, 12, 8, 8, 5}}, x);
  program->AddBoundingBoxConstraint(0, kInf, x);
  return program;
}

/// |Ax - b|^2 where Cx = 0: 1859/349, a rational number since all data are integers.
ProgramPtr Hs52() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(5);
  const Eigen::MatrixXd A{{4, -1, 0, 0, 0}, {0, 1, 1, 0, 0}, {0, 0, 0, 1, 0}, {0, 0, 0, 0, 1}};
  program->Add2NormSquaredCost(A, Eigen::Vector4d(0, 2, 1, 1), x);
  const Eigen::MatrixXd C{{1, 3, 0, 0, 0}, {0, 0, 1, 1, -2}, {0, 1, 0, 0, -1}};
  program->AddLinearEqualityConstraint(C, Eigen::Vector3d::Zero(), x);
  return program;
}

/// x t (x + y + z) + z where x y z t >= 25, the squares sum to 40, all within [1, 5].
ProgramPtr Hs71() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(4);
  program->AddCost([](const auto& v) { return v[0] * v[3] * (v[0] + v[1] + v[2]) + v[2]; }, x);
  AddAtLeast(
      *program, [](const auto& v) { return v[0] * v[1] * v[2] * v[3]; }, 25, x);
  program->AddQuadraticConstraint(2 * Eigen::Matrix4d::Identity(), Eigen::Vector4d::Zero(), 40, 40,
                                  x);
  program->AddBoundingBoxConstraint(1, 5, x);
  return program;
}

/// Cattle feed (Biggs): cost of a mixture of barley, oats, sesame and groundnut meal, with oil at
/// least and protein at least with probability 95%: a mean less 1.645 standard deviations, concave.
ProgramPtr Hs73() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(4);
  program->AddLinearCost(Eigen::Vector4d(24.55, 26.75, 39, 40.5), x);
  program->AddLinearConstraint(Eigen::RowVector4d(2.3, 5.6, 11.1, 1.3), 5, kInf, x);
  AddAtLeast(
      *program,
      [](const auto& v) {
        return 12 * v[0] + 11.9 * v[1] + 41.8 * v[2] + 52.1 * v[3] -
               1.645 * sqrt(0.28 * v[0] * v[0] + 0.19 * v[1] * v[1] + 20.5 * v[2] * v[2] +
                            0.62 * v[3] * v[3]);
      },
      21, x, Curvature::kConvex);
  program->AddLinearEqualityConstraint(Eigen::RowVector4d::Ones(), 1, x);
  program->AddBoundingBoxConstraint(0, kInf, x);
  return program;
}

/// Two transcendental equations in five variables.
ProgramPtr Hs77() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(5);
  program->AddCost(
      [](const auto& v) {
        const auto a = v[0] - 1;
        const auto b = v[0] - v[1];
        const auto c = v[2] - 1;
        return a * a + b * b + c * c + pow(v[3] - 1, 4) + pow(v[4] - 1, 6);
      },
      x);
  AddEqual(
      *program, [](const auto& v) { return v[0] * v[0] * v[1] + sin(v[1] - v[2]); },
      2 * std::sqrt(2.0), VariableList{x[0], x[3], x[4]});
  AddEqual(
      *program, [](const auto& v) { return v[0] + pow(v[1], 4) * v[2] * v[2]; }, 8 + std::sqrt(2.0),
      x.segment(1, 3));
  return program;
}

/// exp(x y z t u) on the intersection of a sphere and two surfaces (Powell).
ProgramPtr Hs80() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(5);
  program->AddCost([](const auto& v) { return exp(v[0] * v[1] * v[2] * v[3] * v[4]); }, x);
  program->AddConstraint(
      [](const auto& v) {
        return std::vector{
            v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3] + v[4] * v[4],
            v[1] * v[2] - 5 * v[3] * v[4],
            v[0] * v[0] * v[0] + v[1] * v[1] * v[1],
        };
      },
      Eigen::Vector3d(10, 0, -1), Eigen::Vector3d(10, 0, -1), x);
  const Vector side{{2.3, 2.3, 3.2, 3.2, 3.2}};
  program->AddBoundingBoxConstraint(-side, side, x);
  return program;
}

/// Transformer design (Bartholomew-Biggs): products of up to six dimensions.
ProgramPtr Hs93() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(6);
  const auto sum = [](const auto& v, double a, double b, double a2, double b2) {
    const auto iron = v[0] * v[3] * (v[0] + v[1] + v[2]);
    const auto copper = v[1] * v[2] * (v[0] + 1.57 * v[1] + v[3]);
    return a * iron + b * copper + a2 * iron * v[4] * v[4] + b2 * copper * v[5] * v[5];
  };
  program->AddCost([sum](const auto& v) { return sum(v, 0.0204, 0.0187, 0.0607, 0.0437); }, x);
  AddAtLeast(
      *program, [](const auto& v) { return 0.001 * v[0] * v[1] * v[2] * v[3] * v[4] * v[5]; }, 2.07,
      x);
  AddAtMost(
      *program, [sum](const auto& v) { return sum(v, 0, 0, 0.00062, 0.00058); }, 1, x);
  program->AddBoundingBoxConstraint(0, kInf, x);
  return program;
}

/// Seven variables, polynomials of degree up to 6.
ProgramPtr Hs100() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(7);
  program->AddQuadraticErrorCost(Eigen::Matrix3d(Eigen::Vector3d(1, 5, 3).asDiagonal()),
                                 Eigen::Vector3d(10, 12, 11), VariableList{x[0], x[1], x[3]});
  program->AddCost(
      [](const auto& v) {
        return pow(v[2], 4) + 10 * pow(v[4], 6) + 7 * v[5] * v[5] + pow(v[6], 4) - 4 * v[5] * v[6] -
               10 * v[5] - 8 * v[6];
      },
      x);
  AddAtMost(
      *program,
      [](const auto& v) {
        return 2 * v[0] * v[0] + 3 * pow(v[1], 4) + v[2] + 4 * v[3] * v[3] + 5 * v[4];
      },
      127, x.head(5), Curvature::kConvex);
  AddSquaresAtMost(*program, Vector{{0, 0, 10, 0, 0}}, Vector{{7, 3, 0, 1, -1}}, 282, x.head(5));
  AddSquaresAtMost(*program, Vector{{0, 1, 0, 0, 0, 6, 0}}, Vector{{23, 0, 0, 0, 0, 0, -8}}, 196,
                   x);
  AddAtMost(
      *program,
      [](const auto& v) {
        return 4 * v[0] * v[0] + v[1] * v[1] - 3 * v[0] * v[1] + 2 * v[2] * v[2] + 5 * v[5] -
               11 * v[6];
      },
      0, x, Curvature::kConvex);
  return program;
}

/// Optimal design of two reactors: posynomials but for -x - y, whose sum stays in [0.1, 4.2].
ProgramPtr Hs104() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(8);
  const auto objective = [](const auto& v) {
    return 0.4 * pow(v[0] / v[2], 0.67) + 0.4 * pow(v[1] / v[3], 0.67) + 10 - v[0] - v[1];
  };
  const VariableList in_objective{x[0], x[1], x[6], x[7]};
  program->AddCost(objective, in_objective);
  program->AddConstraint(objective, OneNumber(0.1), OneNumber(4.2), in_objective);
  AddAtMost(
      *program, [](const auto& v) { return 0.0588 * v[0] * v[1] + 0.1 * v[2]; }, 1,
      VariableList{x[4], x[6], x[0]});
  AddAtMost(
      *program, [](const auto& v) { return 0.0588 * v[0] * v[1] + 0.1 * (v[2] + v[3]); }, 1,
      VariableList{x[5], x[7], x[0], x[1]});
  const auto stage = [](const auto& v) {
    return (4 * v[0] + 2 * pow(v[0], -0.71)) / v[1] + 0.0588 * pow(v[0], -1.3) * v[2];
  };
  AddAtMost(*program, stage, 1, VariableList{x[2], x[4], x[6]});
  AddAtMost(*program, stage, 1, VariableList{x[3], x[5], x[7]});
  program->AddBoundingBoxConstraint(0.1, 10, x);
  return program;
}

/// Chemical equilibrium of ten species of three elements (White, Johnson and Dantzig 1958): free
/// energy sum_j x_j (c_j + log(x_j / sum x)), a sum of relative entropies.
ProgramPtr Hs112() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(10);
  AddConvexCost(
      *program,
      [](const auto& v) {
        constexpr double c[] = {-6.089,  -17.164, -34.054, -5.914,  -24.721,
                                -14.986, -24.100, -10.708, -26.662, -22.179};
        auto total = v[0];
        for (int j = 1; j < 10; ++j) total += v[j];
        auto energy = 0 * v[0];
        for (int j = 0; j < 10; ++j) energy += v[j] * (c[j] + log(v[j] / total));
        return energy;
      },
      x);
  const Eigen::MatrixXd atoms{{1, 2, 2, 0, 0, 1, 0, 0, 0, 1},
                              {0, 0, 0, 1, 2, 1, 1, 0, 0, 0},
                              {0, 0, 1, 0, 0, 0, 1, 1, 2, 1}};
  program->AddLinearEqualityConstraint(atoms, Eigen::Vector3d(2, 1, 1), x);
  program->AddBoundingBoxConstraint(1e-6, kInf, x);
  return program;
}

Eigen::MatrixXd Diagonal(const Vector& entries) { return entries.asDiagonal(); }

/// Wong 2: convex quadratics in ten variables, three linear rows.
ProgramPtr Hs113() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(10);
  program->AddQuadraticCost(Eigen::Matrix2d{{2, 1}, {1, 2}}, Eigen::Vector2d(-14, -16), 45,
                            x.head(2));
  program->AddQuadraticErrorCost(Diagonal(Vector{{1, 4, 1, 2, 5, 7, 2, 1}}),
                                 Vector{{10, 5, 3, 1, 0, 11, 10, 7}}, x.tail(8));
  const Eigen::MatrixXd A{{4, 5, 0, 0, 0, 0, -3, 9, 0, 0},
                          {10, -8, 0, 0, 0, 0, -17, 2, 0, 0},
                          {-8, 2, 0, 0, 0, 0, 0, 0, 5, -2}};
  program->AddLinearConstraint(A, Vector::Constant(3, -kInf), Eigen::Vector3d(105, 0, 12), x);
  // 3(x1 - 2)^2 + 4(x2 - 3)^2 + 2 x3^2 - 7 x4 <= 120
  AddSquaresAtMost(*program, Eigen::Vector4d(3, 4, 2, 0), Eigen::Vector4d(-12, -24, 0, -7), 72,
                   x.head(4));
  // 5 x1^2 + 8 x2 + (x3 - 6)^2 - 2 x4 <= 40
  AddSquaresAtMost(*program, Eigen::Vector4d(5, 0, 1, 0), Eigen::Vector4d(0, 8, -12, -2), 4,
                   x.head(4));
  // (x1 - 8)^2 / 2 + 2(x2 - 4)^2 + 3 x5^2 - x6 <= 30
  const VariableList tail{x[0], x[1], x[4], x[5]};
  AddSquaresAtMost(*program, Eigen::Vector4d(0.5, 2, 3, 0), Eigen::Vector4d(-8, -16, 0, -1), -34,
                   tail);
  // x1^2 + 2(x2 - 2)^2 - 2 x1 x2 + 14 x5 - 6 x6 <= 0
  program->AddQuadraticConstraint(
      Eigen::Matrix4d{{2, -2, 0, 0}, {-2, 4, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}},
      Eigen::Vector4d(0, -8, 14, -6), -kInf, -8, tail);
  // -3 x1 + 6 x2 + 12(x9 - 8)^2 - 7 x10 <= 0
  AddSquaresAtMost(*program, Eigen::Vector4d(0, 0, 12, 0), Eigen::Vector4d(-3, 6, -192, -7), -768,
                   VariableList{x[0], x[1], x[8], x[9]});
  return program;
}

std::string Number(int n) { return "Hock and Schittkowski 1981, problem " + std::to_string(n); }

}  // namespace

std::vector<KnownProgram> HockSchittkowskiOfManyVariables() {
  constexpr auto kBounded = Conditions::kBounds;
  constexpr auto kBelow = Conditions::kInequalities;
  constexpr auto kEqual = Conditions::kEqualities;
  constexpr auto kHas = Answer::kOptimum;
  const std::vector<double> transformer = {5.54, 4.4, 12.02, 11.82, 0.702, 0.852};
  const std::vector<double> reactors = {6, 3, 0.4, 0.2, 6, 6, 1, 0.5};
  const std::vector<double> equilibrium(10, 0.1);
  const std::vector<double> wong = {2, 3, 5, 5, 1, 2, 7, 3, 6, 10};
  return {
      {"HS38", Number(38), kBounded, kBox, kHas, 0, {-3, -1, -3, -1}, Hs38},
      {"HS39", Number(39), kEqual, 0, kHas, -1, {2, 2, 2, 2}, Hs39},
      {"HS40", Number(40), kEqual, 0, kHas, -0.25, {0.8, 0.8, 0.8, 0.8}, Hs40},
      {"HS43", Number(43), kBelow, kConvex, kHas, -44, {0, 0, 0, 0}, Hs43},
      {"HS44", Number(44), kBelow, 0, kHas, -15, {0, 0, 0, 0}, Hs44, {-13}},
      {"HS52", Number(52), kEqual, kConvex, kHas, 1859.0 / 349, {2, 2, 2, 2, 2}, Hs52},
      {"HS71", Number(71), kEqual, kBox, kHas, 17.014017289156, {1, 5, 5, 1}, Hs71},
      {"HS73", Number(73), kEqual, kConvex, kHas, 29.894378159143, {1, 1, 1, 1}, Hs73},
      {"HS77", Number(77), kEqual, 0, kHas, 0.24150512879018, {2, 2, 2, 2, 2}, Hs77},
      {"HS80", Number(80), kEqual, kBox, kHas, 0.053949847770272, {-2, 2, 2, -1, -1}, Hs80},
      {"HS93", Number(93), kBelow, 0, kHas, 135.07596282915, transformer, Hs93},
      {"HS100", Number(100), kBelow, 0, kHas, 680.6300573744, {1, 2, 0, 4, 0, 1, 1}, Hs100},
      {"HS104", Number(104), kBelow, kBox, kHas, 3.9511634401034, reactors, Hs104},
      {"HS112", Number(112), kEqual, kConvex, kHas, -47.761090859366, equilibrium, Hs112},
      {"HS113", Number(113), kBelow, kConvex, kHas, 24.30620906818, wong, Hs113},
  };
}

}  // namespace switchyard::testing
