#include "programs.hpp"

namespace switchyard::test {
namespace {

constexpr double kTolerance = 1e-6;

class IntegerSolver : public testing::TestWithParam<Named> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(IntegerSolver);
INSTANTIATE_TEST_SUITE_P(Plugins, IntegerSolver,
                         testing::ValuesIn(SolversOf(kLinear | SY_ACCEPTS_INTEGER)), NameOf);

/// max sum v x, sum w x <= c in each of `rows` rows, x binary: and its optimum by enumeration.
struct Knapsack {
  Knapsack(std::int32_t items, std::int32_t rows, unsigned seed) {
    std::mt19937 draw(seed);
    std::uniform_int_distribution<int> weight(5, 60);
    const auto n = static_cast<std::size_t>(items);
    std::vector<double> q(n);
    for (double& v : q) v = -weight(draw);
    std::vector<std::vector<double>> a(static_cast<std::size_t>(rows), std::vector<double>(n));
    std::vector<double> room;
    for (auto& row : a) {
      double sum = 0;
      for (double& w : row) sum += w = weight(draw);
      room.push_back(std::floor(sum / 2));
    }
    data = Linear(q, std::vector<double>(n, 0), std::vector<double>(n, 1), a,
                  std::vector<double>(a.size(), -kInfinity), room);
    data.integer.assign(n, 1);
  }
  [[nodiscard]] double Optimum() const {
    double best = 0;
    for (std::uint32_t set = 0; set < (1u << data.num_vars); ++set) {
      std::vector<double> x(data.q.size());
      for (std::size_t j = 0; j < x.size(); ++j) x[j] = (set >> j) & 1u;
      double value = 0;
      for (std::size_t j = 0; j < x.size(); ++j) value += data.q[j] * x[j];
      if (value < best && Violation(data, x) == 0) best = value;
    }
    return best;
  }
  ProblemData data;
};

sy_control Exactly() {
  sy_control control = Freely();
  control.relative_gap = 1e-9;
  control.absolute_gap = 1e-9;
  return control;
}

TEST_P(IntegerSolver, FindsWhatEnumerationFinds) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Knapsack knapsack(12, 3, seed);
    const Problem problem(knapsack.data);
    BareSolver solver(GetParam());
    solver.Load(problem.view());
    const Answer a = solver.Solve(Exactly());
    ExpectOptimal(knapsack.data, solver, a, kTolerance);
    EXPECT_NEAR(a.result.objective, knapsack.Optimum(), kTolerance);
  }
}

TEST_P(IntegerSolver, MixesGeneralIntegersAndContinuous) {
  // min -3x - 2y - z, 2x + y + z <= 7.5, x <= 2.6 integer, y <= 1.5, z integer: x = 2, y = 1.5, z =
  // 2
  ProblemData data =
      Linear({-3, -2, -1}, {0, 0, 0}, {2.6, 1.5, 9}, {{2, 1, 1}}, {-kInfinity}, {7.5});
  data.integer = {1, 0, 1};
  const Problem problem(data);
  BareSolver solver(GetParam());
  solver.Load(problem.view());
  const Answer a = solver.Solve(Exactly());
  ExpectOptimal(data, solver, a, kTolerance);
  EXPECT_NEAR(a.result.objective, -11, kTolerance);
}

TEST_P(IntegerSolver, SaysInfeasible) {
  ProblemData data = Linear({1, 1}, {0, 0}, {5, 5}, {{2, 2}}, {3}, {3});
  data.integer = {1, 1};
  const Problem problem(data);
  BareSolver solver(GetParam());
  solver.Load(problem.view());
  EXPECT_EQ(solver.Solve().result.termination, SY_INFEASIBLE);
}

TEST_P(IntegerSolver, StopsAtItsCutoffAndItsTarget) {
  const Knapsack knapsack(12, 3, 7);
  const double optimum = knapsack.Optimum();
  const Problem problem(knapsack.data);
  BareSolver solver(GetParam());
  solver.Load(problem.view());
  if (solver.Honors(SY_HONORS_CUTOFF)) {
    sy_control control = Exactly();
    control.cutoff = optimum - 5;
    const Answer cut = solver.Solve(control);
    if (cut.result.termination == SY_OPTIMAL) {  // it was done before it could be stopped
      EXPECT_NEAR(cut.result.objective, optimum, kTolerance);
    } else {
      EXPECT_EQ(cut.result.termination, SY_CUTOFF);
      EXPECT_GE(cut.result.bound, control.cutoff - kTolerance);
    }
    control.cutoff = optimum + 5;
    EXPECT_NEAR(solver.Solve(control).result.objective, optimum, kTolerance);
  }
  if (solver.Honors(SY_HONORS_TARGET)) {
    sy_control control = Exactly();
    control.target = 0;
    const Answer a = solver.Solve(control);
    EXPECT_TRUE(a.result.termination == SY_TARGET || a.result.termination == SY_OPTIMAL);
    EXPECT_EQ(a.result.primal, SY_FEASIBLE);
    EXPECT_LE(a.result.objective, kTolerance);
    EXPECT_LE(a.result.bound, optimum + kTolerance);
  }
}

TEST_P(IntegerSolver, KeepsAStartThatIsOptimal) {
  const Knapsack knapsack(12, 3, 9);
  const Problem problem(knapsack.data);
  BareSolver solver(GetParam());
  if (solver.table().warm_start == nullptr) GTEST_SKIP() << "takes no start";
  solver.Load(problem.view());
  const Answer first = solver.Solve(Exactly());
  sy_start start = {};
  start.size = sizeof start;
  start.x = first.x.data();
  solver.WarmStart(start);
  const Answer second = solver.Solve(Exactly());
  ExpectOptimal(knapsack.data, solver, second, kTolerance);
  EXPECT_NEAR(second.result.objective, first.result.objective, kTolerance);
}

TEST_P(IntegerSolver, LeavesAnIncumbentAndABoundAtALimit) {
  const Knapsack knapsack(60, 20, 3);
  const Problem problem(knapsack.data);
  BareSolver solver(GetParam());
  solver.Load(problem.view());
  sy_control control = Exactly();
  control.nodes = 5;
  const Answer a = solver.Solve(control);
  if (!solver.Honors(SY_HONORS_NODES)) GTEST_SKIP() << "counts no nodes";
  ASSERT_EQ(a.result.termination, SY_NODE_LIMIT) << a.text;
  ASSERT_EQ(a.result.primal, SY_FEASIBLE);
  EXPECT_LE(Violation(knapsack.data, a.x), 1e-5);
  EXPECT_GT(a.result.bound, -kInfinity);
  EXPECT_LE(a.result.bound, a.result.objective);
}

}  // namespace
}  // namespace switchyard::test
