// Programs of the literature beside Hock and Schittkowski's.
#include <cmath>

#include "switchyard/functions/make_function.hpp"
#include "tests/nonlinear_suite/suite.hpp"
#include "tests/nonlinear_suite/terms.hpp"

namespace switchyard::testing {
namespace {

/// sum_i 100 (x_{i+1} - x_i^2)^2 + (1 - x_i)^2: 0 where all are 1. From n = 4 on there is a local
/// optimum near (-1, 1, ..., 1).
template <int n>
ProgramPtr RosenbrockChain() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(n);
  const auto link = std::make_shared<FunctionCost>(MakeFunction(2, [](const auto& v) {
    const auto t = v[1] - v[0] * v[0];
    const auto u = 1 - v[0];
    return 100 * t * t + u * u;
  }));
  for (int i = 0; i + 1 < n; ++i) program->AddCost(link, x.segment(i, 2));
  return program;
}

std::vector<double> ChainStart(std::size_t n) {
  std::vector<double> start(n, 1);
  for (std::size_t i = 0; i < n; i += 2) start[i] = -1.2;
  return start;
}

/// (x + 10 y)^2 + 5 (z - t)^2 + (y - 2 z)^4 + 10 (x - t)^4: convex, 0 at 0, where the Hessian has
/// rank 2.
ProgramPtr PowellSingular() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(4);
  const double root = std::sqrt(5.0);
  program->Add2NormSquaredCost(Eigen::MatrixXd{{1, 10, 0, 0}, {0, 0, root, -root}},
                               Eigen::Vector2d::Zero(), x);
  AddConvexCost(
      *program, [](const auto& v) { return pow(v[1] - 2 * v[2], 4) + 10 * pow(v[0] - v[3], 4); },
      x);
  return program;
}

/// The largest of x^2 + y^4, (2 - x)^2 + (2 - y)^2 and 2 exp(y - x), as an epigraph. The last is
/// below the others at the optimum; its value is a Newton iteration's on the conditions of first
/// order.
ProgramPtr Cb2() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(3);
  program->AddLinearCost(OneNumber(1), x.tail(1));
  program->AddConstraint(
      [](const auto& v) {
        const auto a = 2 - v[0];
        const auto b = 2 - v[1];
        return std::vector{
            v[0] * v[0] + pow(v[1], 4) - v[2],
            a * a + b * b - v[2],
            2 * exp(v[1] - v[0]) - v[2],
        };
      },
      Eigen::Vector3d::Constant(-kInf), Eigen::Vector3d::Zero(), x, {.is_convex = true});
  return program;
}

/// Jaynes' die: the negative entropy sum p log p of the faces 1, ..., 6 where their mean is 4.5. It
/// is least for p_k = t^k / sum_j t^j, and the mean says t = 1.4492539953607.
ProgramPtr JaynesDie() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto p = program->NewContinuousVariables(6, "p");
  for (const Variable& p_k : p) {
    AddConvexCost(
        *program, [](const auto& v) { return v[0] * log(v[0]); }, p_k);
  }
  program->AddLinearEqualityConstraint(Eigen::MatrixXd{{1, 1, 1, 1, 1, 1}, {1, 2, 3, 4, 5, 6}},
                                       Eigen::Vector2d(1, 4.5), p);
  program->AddBoundingBoxConstraint(0, 1, p);
  return program;
}

/// The logarithm of their example: log(exp(x + 3 y - 0.1) + exp(x - 3 y - 0.1) + exp(-x - 0.1)):
/// least at y = 0 and 2 exp(x) = exp(-x), where it is 3/2 log 2 - 0.1.
ProgramPtr LogSumExp() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(2);
  AddConvexCost(
      *program,
      [](const auto& v) {
        return log(exp(v[0] + 3 * v[1] - 0.1) + exp(v[0] - 3 * v[1] - 0.1) + exp(-v[0] - 0.1));
      },
      x);
  return program;
}

/// A tutorial on geometric programming: the largest box, by the logarithms h, w, d of its height,
/// width and depth: maximize h + w + d where its walls 2 (exp(h + w) + exp(h + d)) are 100 and its
/// floor exp(w + d) 10 at the most. With a square floor all is used: a volume of 100 sqrt(10) / 4.
ProgramPtr LargestBox() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(3);
  program->set_objective_sense(ObjectiveSense::kMaximize);
  program->AddLinearCost(Eigen::Vector3d::Ones(), x);
  AddAtMost(
      *program, [](const auto& v) { return log(2 * exp(v[0] + v[1]) + 2 * exp(v[0] + v[2])); },
      std::log(100.0), x, Curvature::kConvex);
  program->AddLinearConstraint(Eigen::RowVector2d(1, 1), -kInf, std::log(10.0), x.tail(2));
  return program;
}

constexpr int kLinks = 20;

/// A chain of m links of length 0.1 hangs between two nails at (0, 0) and (1, 0), its inner nodes
/// of weight 1: least sum of heights where |link| <= 0.1. At rest the tension of link k is (H, V_k)
/// with V_k = k - (m - 1) / 2, so it is 0.1 (H, V_k) / |(H, V_k)|, and the widths that sum to 1 say
/// H: 2.2956676322354865 for m = 20.
ProgramPtr HangingChain() {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(kLinks + 1, "x");
  const auto y = program->NewContinuousVariables(kLinks + 1, "y");
  program->AddLinearCost(Eigen::VectorXd::Ones(kLinks - 1), y.segment(1, kLinks - 1));
  const auto squared = MakeFunction(4, [](const auto& v) {
    const auto dx = v[1] - v[0];
    const auto dy = v[3] - v[2];
    return dx * dx + dy * dy;
  });
  const auto link =
      std::make_shared<FunctionConstraint>(squared, OneNumber(-kInf), OneNumber(0.01), true);
  for (int k = 0; k < kLinks; ++k) {
    program->AddConstraint(link, VariableList{x.segment(k, 2), y.segment(k, 2)});
  }
  const VariableList nails{x[0], y[0], x[kLinks], y[kLinks]};
  program->AddBoundingBoxConstraint(Eigen::Vector4d(0, 0, 1, 0), Eigen::Vector4d(0, 0, 1, 0),
                                    nails);
  return program;
}

std::vector<double> Straight() {
  std::vector<double> start(2 * (kLinks + 1), 0);
  for (int k = 0; k <= kLinks; ++k) start[static_cast<std::size_t>(k)] = double(k) / kLinks;
  return start;
}

}  // namespace

std::vector<KnownProgram> Classics() {
  constexpr auto kFree = Conditions::kNone;
  constexpr auto kBelow = Conditions::kInequalities;
  constexpr auto kEqual = Conditions::kEqualities;
  constexpr auto kHas = Answer::kOptimum;
  const std::string chained = "Rosenbrock 1960, chained";
  const std::string boyd = "Boyd, Vandenberghe 2004 (9.20)";
  const std::string geometric = "Boyd et al. 2007";
  const std::string catenary = "Huygens, Leibniz, Bernoulli 1691";
  const std::vector<double> sixths(6, 1.0 / 6);
  const std::vector<double> ten = ChainStart(10);
  const std::vector<double> hundred = ChainStart(100);
  const double lse = 1.5 * std::log(2.0) - 0.1;
  const double box = std::log(25 * std::sqrt(10.0));
  constexpr double kDie = -1.61358109815383;
  constexpr double kCb2 = 1.95222449387066;
  constexpr double kHanging = -9.1039623281607;
  constexpr unsigned kRows = kConvex | kManyRows;
  return {
      {"Rosenbrock2", "Rosenbrock 1960", kFree, 0, kHas, 0, {-1.2, 1}, RosenbrockChain<2>},
      {"Rosenbrock10", chained, kFree, 0, kHas, 0, ten, RosenbrockChain<10>, {3.986579112347}},
      {"Rosenbrock100", chained, kFree, 0, kHas, 0, hundred, RosenbrockChain<100>, {3.9866238543}},
      {"PowellSingular", "Powell 1962", kFree, kConvex, kHas, 0, {3, -1, 0, 1}, PowellSingular},
      {"CB2", "Charalambous, Bandler 1976", kBelow, kConvex, kHas, kCb2, {2, 2, 20}, Cb2},
      {"JaynesDie", "Jaynes 1963", kEqual, kConvex | kBox, kHas, kDie, sixths, JaynesDie},
      {"LogSumExp", boyd, kFree, kConvex, kHas, lse, {1, 1}, LogSumExp},
      {"LargestBox", geometric, kBelow, kConvex, kHas, box, {0, 0, 0}, LargestBox},
      {"HangingChain", catenary, kBelow, kRows, kHas, kHanging, Straight(), HangingChain},
  };
}

}  // namespace switchyard::testing
