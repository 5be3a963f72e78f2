// What branch and bound keeps beside its optimum: limits, cutoff and target, starts, progress, the
// same tree for any number of threads, and its words for what it does not take.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "switchyard/error.hpp"
#include "switchyard/model/program.hpp"
#include "switchyard/solve/solve.hpp"
#include "tests/mip/enumerate.hpp"
#include "tests/mip/random_program.hpp"
#include "tests/nonlinear/backends.hpp"

namespace switchyard::testing {
namespace {

using ::testing::HasSubstr;

constexpr const char* kBackend = "branch-and-bound";

/// min risk - return over n assets of which at most k are held: |C x| <= t, sum x = 1, x <= z.
Problem Portfolio(int n, int k, unsigned seed) {
  MathematicalProgram prog;
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  const auto x = prog.NewContinuousVariables(n, "x");
  const auto z = prog.NewBinaryVariables(n, "z");
  const auto t = prog.NewContinuousVariables(1, "t");
  Eigen::MatrixXd C(n, n);
  for (double& c : C.reshaped()) c = normal(engine);
  ProblemData d;
  const int all = 2 * n + 1;
  d.num_vars = all;
  d.flags = SY_PROBLEM_CONVEX;
  d.P = Csc(all, all);
  d.q.assign(static_cast<std::size_t>(all), 0.0);
  for (int j = 0; j < n; ++j) d.q[static_cast<std::size_t>(j)] = -0.1 * normal(engine);
  d.q.back() = 1;
  d.x_lower.assign(static_cast<std::size_t>(all), 0.0);
  d.x_upper.assign(static_cast<std::size_t>(all), 1.0);
  d.x_upper.back() = kInfinity;
  d.integer.assign(static_cast<std::size_t>(all), 0);
  for (int j = n; j < 2 * n; ++j) d.integer[static_cast<std::size_t>(j)] = 1;
  // Rows: the sum, how many are held, and x <= z for each.
  d.row_lower.assign(static_cast<std::size_t>(n) + 2, -kInfinity);
  d.row_upper.assign(static_cast<std::size_t>(n) + 2, 0.0);
  d.row_lower[0] = d.row_upper[0] = 1;
  d.row_upper[1] = k;
  d.A = Csc(n + 2, all);
  const auto put = [](Csc& m, int row, double value) {
    m.row.push_back(row);
    m.value.push_back(value);
  };
  d.F = Csc(n + 1, all);
  for (int j = 0; j < all; ++j) {
    if (j < n) {
      put(d.A, 0, 1);
      put(d.A, 2 + j, 1);
      for (int i = 0; i < n; ++i) put(d.F, 1 + i, C(i, j));
    } else if (j < 2 * n) {
      put(d.A, 1, 1);
      put(d.A, 2 + j - n, -1);
    } else {
      put(d.F, 0, 1);
    }
    d.A.start[static_cast<std::size_t>(j) + 1] = static_cast<std::int32_t>(d.A.row.size());
    d.F.start[static_cast<std::size_t>(j) + 1] = static_cast<std::int32_t>(d.F.row.size());
  }
  d.g.assign(static_cast<std::size_t>(n) + 1, 0.0);
  d.cones = {{SY_CONE_SECOND_ORDER, n + 1, 0}};
  return Problem(std::move(d));
}

BackendAnswer Answer(const Problem& problem, const sy_control& control,
                     const std::vector<std::string>& options = {}) {
  return SolveThroughHost(Built(), kBackend, problem.view(), control, options);
}

TEST(BranchAndBound, HasTheSameTreeForAnyNumberOfThreadsWhereThatIsAsked) {
  SKIP_WITHOUT(kBackend);
  const Problem problem = Portfolio(14, 4, 3);
  const BackendAnswer one = Answer(problem, Unlimited(1), {"deterministic=1"});
  const BackendAnswer two = Answer(problem, Unlimited(2), {"deterministic=1"});
  ASSERT_EQ(one.result.termination, SY_OPTIMAL) << one.text;
  EXPECT_EQ(one.result.nodes, two.result.nodes);
  EXPECT_GT(one.result.nodes, 8);
  EXPECT_EQ(one.result.objective, two.result.objective);
  EXPECT_EQ(one.result.bound, two.result.bound);
  EXPECT_EQ(one.x, two.x);
}

TEST(BranchAndBound, BothEnginesAndAllNumbersOfThreadsAgree) {
  SKIP_WITHOUT(kBackend);
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Problem problem = Portfolio(12, 3, seed);
    std::vector<double> objectives;
    for (const char* engine : {"engine=conic", "engine=outer"}) {
      for (const int threads : {1, 3}) {
        sy_control control = Unlimited(threads);
        control.relative_gap = 1e-6;
        const BackendAnswer answer = Answer(problem, control, {engine});
        ASSERT_EQ(answer.result.termination, SY_OPTIMAL) << engine << ": " << answer.text;
        objectives.push_back(answer.result.objective);
        EXPECT_LE(answer.result.bound, answer.result.objective);
      }
    }
    for (const double objective : objectives) EXPECT_NEAR(objective, objectives[0], 2e-6);
  }
}

/// min sum c_i k_i + d_i / k_i over n integers k_i with sum w_i k_i <= b, 1 / k_i by cones
/// 2 k_i t_i >= 1; with binaries z_i that switch y_i <= z_i on, and their squares below s_i.
Problem Allocation(int n, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> uniform(0.5, 1.5);
  ProblemData d;
  const int all = 5 * n;  // k, t, z, y, s
  d.num_vars = all;
  d.flags = SY_PROBLEM_CONVEX;
  d.P = Csc(all, all);
  d.A = Csc(n + 2, all);
  d.F = Csc(6 * n, all);
  const auto put = [](Csc& m, int row, double value) {
    m.row.push_back(row);
    m.value.push_back(value);
  };
  for (int j = 0; j < all; ++j) {
    const int kind = j / n, i = j % n;
    const double cost[] = {uniform(engine), 30 * uniform(engine), 0.3 * uniform(engine),
                           -1.5 * uniform(engine), 1};
    d.q.push_back(cost[kind]);
    d.x_lower.push_back(0);
    d.x_upper.push_back(kind == 0 ? 20 : kind == 2 || kind == 3 ? 1 : kInfinity);
    d.integer.push_back(kind == 0 || kind == 2 ? 1 : 0);
    if (kind == 0) put(d.A, 0, uniform(engine));
    if (kind == 2) put(d.A, 1, uniform(engine));
    if (kind == 2) put(d.A, 2 + i, -1);
    if (kind == 3) put(d.A, 2 + i, 1);
    const int row[] = {3 * i, 3 * i + 1, -1, 3 * n + 3 * i + 2, 3 * n + 3 * i};
    if (row[kind] >= 0) put(d.F, row[kind], 1);
    d.A.start[static_cast<std::size_t>(j) + 1] = static_cast<std::int32_t>(d.A.row.size());
    d.F.start[static_cast<std::size_t>(j) + 1] = static_cast<std::int32_t>(d.F.row.size());
  }
  d.row_lower.assign(static_cast<std::size_t>(n) + 2, -kInfinity);
  d.row_upper.assign(static_cast<std::size_t>(n) + 2, 0.0);
  d.row_upper[0] = 2.6 * n;
  d.row_upper[1] = 0.5 * n;
  for (int i = 0; i < n; ++i) {
    d.g.insert(d.g.begin() + 3 * i, {0, 0, 1});
    d.g.insert(d.g.end(), {0, 0.5, 0});
  }
  d.cones.assign(2 * static_cast<std::size_t>(n), {SY_CONE_ROTATED, 3, 0});
  return Problem(std::move(d));
}

/// max c'z over n binaries with w_k'z + 2 t_k <= b_k and |(a_ki z_i)| <= t_k for m knapsacks whose
/// weights are uncertain, most of them 0.
Problem UncertainKnapsacks(int n, int m, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::uniform_int_distribution<int> whole(5, 40);
  ProblemData d;
  const int all = n + m, dim = n + 1;
  d.num_vars = all;
  d.flags = SY_PROBLEM_CONVEX;
  d.P = Csc(all, all);
  d.A = Csc(m, all);
  d.F = Csc(m * dim, all);
  d.row_lower.assign(static_cast<std::size_t>(m), -kInfinity);
  d.row_upper.assign(static_cast<std::size_t>(m), 0.0);
  const auto put = [](Csc& a, int row, double value) {
    a.row.push_back(row);
    a.value.push_back(value);
  };
  for (int j = 0; j < all; ++j) {
    const bool binary = j < n;
    d.q.push_back(binary ? -whole(engine) : 0);
    d.x_lower.push_back(0);
    d.x_upper.push_back(binary ? 1 : kInfinity);
    d.integer.push_back(binary ? 1 : 0);
    for (int k = 0; k < m; ++k) {
      const bool absent = binary ? whole(engine) > 15 : k != j - n;
      if (absent) continue;
      const double weight = binary ? whole(engine) : 2;
      put(d.A, k, weight);
      put(d.F, k * dim + (binary ? 1 + j : 0), binary ? 0.3 * whole(engine) : 1);
      if (binary) d.row_upper[static_cast<std::size_t>(k)] += 0.5 * weight;
    }
    d.A.start[static_cast<std::size_t>(j) + 1] = static_cast<std::int32_t>(d.A.row.size());
    d.F.start[static_cast<std::size_t>(j) + 1] = static_cast<std::int32_t>(d.F.row.size());
  }
  d.g.assign(static_cast<std::size_t>(m * dim), 0.0);
  d.cones.assign(static_cast<std::size_t>(m), {SY_CONE_SECOND_ORDER, dim, 0});
  return Problem(std::move(d));
}

void ExpectAFractionOfTheNodes(const std::vector<Problem>& problems, std::int64_t fraction) {
  std::int64_t with = 0, without = 0;
  for (const Problem& problem : problems) {
    sy_control control = Unlimited(1);
    control.relative_gap = 1e-6;
    const BackendAnswer tight = Answer(problem, control);
    const BackendAnswer plain = Answer(problem, control, {"strengthening=0"});
    ASSERT_EQ(tight.result.termination, SY_OPTIMAL) << tight.text;
    ASSERT_EQ(plain.result.termination, SY_OPTIMAL) << plain.text;
    const double slack = 2e-6 * std::abs(plain.result.objective);
    EXPECT_NEAR(tight.result.objective, plain.result.objective, slack);
    EXPECT_LE(tight.result.bound, plain.result.objective + slack);
    with += tight.result.nodes;
    without += plain.result.nodes;
  }
  EXPECT_LT(fraction * with, without);
}

TEST(BranchAndBound, TightensConesOfIntegersAndSwitchedOnes) {
  SKIP_WITHOUT(kBackend);
  ExpectAFractionOfTheNodes({Allocation(8, 1), Allocation(8, 2), Allocation(8, 3)}, 4);
}

TEST(BranchAndBound, RoundsRowsOfBinariesBelowARoot) {
  SKIP_WITHOUT(kBackend);
  std::vector<Problem> problems;
  for (unsigned seed = 1; seed <= 3; ++seed) problems.push_back(UncertainKnapsacks(30, 8, seed));
  ExpectAFractionOfTheNodes(problems, 2);
}

TEST(BranchAndBound, StopsAtNodesWithABound) {
  SKIP_WITHOUT(kBackend);
  const Problem problem = Portfolio(18, 4, 1);
  sy_control control = Unlimited(1);
  control.nodes = 5;
  const BackendAnswer answer = Answer(problem, control);
  EXPECT_EQ(answer.result.termination, SY_NODE_LIMIT) << answer.text;
  EXPECT_LE(answer.result.nodes, 6);
  EXPECT_TRUE(std::isfinite(answer.result.bound));
  sy_control free = Unlimited(2);
  free.seconds = 20;
  EXPECT_LE(answer.result.bound, Answer(problem, free).result.objective + 1e-9);
}

TEST(BranchAndBound, ProvesACutoffAndStopsAtATarget) {
  SKIP_WITHOUT(kBackend);
  const Problem problem = Portfolio(12, 3, 2);
  const double optimum = Answer(problem, Unlimited(1)).result.objective;
  sy_control control = Unlimited(1);
  control.cutoff = optimum - 0.01;
  const BackendAnswer none = Answer(problem, control);
  EXPECT_EQ(none.result.termination, SY_CUTOFF) << none.text;
  EXPECT_EQ(none.result.primal, SY_NO_POINT);
  control = Unlimited(1);
  control.target = optimum + 0.5;
  const BackendAnswer early = Answer(problem, control);
  EXPECT_TRUE(early.result.termination == SY_TARGET || early.result.termination == SY_OPTIMAL);
  EXPECT_LE(early.result.objective, optimum + 0.5);
}

TEST(BranchAndBound, TellsBoundsThatRiseAndPointsThatImprove) {
  SKIP_WITHOUT(kBackend);
  struct Heard {
    std::vector<double> bounds, objectives;
    std::int64_t nodes = 0;
  } heard;
  sy_control control = Unlimited(1);
  control.context = &heard;
  control.progress = [](void* context, const sy_progress* told) noexcept -> std::int32_t {
    auto& all = *static_cast<Heard*>(context);
    if (std::isfinite(told->bound)) all.bounds.push_back(told->bound);
    if (told->incumbent != nullptr) all.objectives.push_back(told->objective);
    all.nodes = std::max(all.nodes, told->nodes);
    return 0;
  };
  const BackendAnswer answer = Answer(Portfolio(16, 4, 5), control);
  ASSERT_EQ(answer.result.termination, SY_OPTIMAL);
  ASSERT_FALSE(heard.objectives.empty());
  EXPECT_TRUE(std::is_sorted(heard.bounds.begin(), heard.bounds.end()));
  EXPECT_TRUE(std::is_sorted(heard.objectives.rbegin(), heard.objectives.rend()));
  EXPECT_EQ(heard.objectives.back(), answer.result.objective);
}

TEST(BranchAndBound, BeginsWithTheUsersIntegers) {
  SKIP_WITHOUT(kBackend);
  const Problem problem = Portfolio(12, 3, 4);
  const BackendAnswer best = Answer(problem, Unlimited(1));
  ASSERT_EQ(best.result.termination, SY_OPTIMAL);
  MathematicalProgram prog;  // the same by the program's interface: integers known, the rest not
  const auto z = prog.NewBinaryVariables(2, "z");
  const auto y = prog.NewContinuousVariables(1, "y");
  prog.AddLinearCost(z[0] + 2 * z[1] + y[0]);
  prog.AddConstraint(z[0] + z[1] >= 1);
  prog.AddBoundingBoxConstraint(0.25, 3, y[0]);
  SolverOptions options;
  options.options["org.switchyard.branch-and-bound"]["dives"] = 0;
  Eigen::VectorXd start(3);
  start << 0, 1, std::nan("");
  const auto result = SolverInterface(kBackend, Built()).Solve(prog, start, options);
  EXPECT_EQ(result.termination, Termination::kOptimal);
  EXPECT_NEAR(result.objective, 1.25, 1e-6);
}

TEST(BranchAndBound, SaysWhyAnEngineDoesNotServe) {
  SKIP_WITHOUT(kBackend);
  const ProblemData d = RandomProgram(ProgramClass::kSemidefinite, 1);
  const BackendAnswer answer = Answer(Problem(d), Unlimited(1), {"engine=outer"});
  EXPECT_EQ(answer.status, SY_E_UNSUPPORTED);
  EXPECT_THAT(answer.error,
              HasSubstr("engine outer takes linear objectives, rows and second-order cones, and "
                        "cone[0] is positive semidefinite"));
}

TEST(BranchAndBound, ServesProgramsWithIntegersAndConesUnnamed) {
  SKIP_WITHOUT(kBackend);
  const Problem problem = Portfolio(6, 2, 1);
  const auto ranked = Built().Rank(problem.view());
  ASSERT_FALSE(ranked.empty());
  EXPECT_TRUE(ranked[0].suitable);
  EXPECT_EQ(ranked[0].backend->short_name, kBackend);
  const auto linear = Built().Rank(Problem(RandomProgram(ProgramClass::kLinear, 1)).view());
  if (IsThere("highs")) {
    EXPECT_NE(linear[0].backend->short_name, kBackend);
  }
}

// A quadratic objective comes over a bridge, and so do the points of the pool, on their way back.
TEST(BranchAndBound, GivesWhatElseItFound) {
  SKIP_WITHOUT(kBackend);
  MathematicalProgram prog;
  const auto x = prog.NewBinaryVariables(8, "x");
  const Eigen::VectorXd wish = Eigen::VectorXd::LinSpaced(8, -0.2, 1.3);
  prog.AddQuadraticErrorCost(Eigen::MatrixXd::Identity(8, 8), wish, x);
  prog.AddLinearConstraint(Eigen::RowVectorXd::LinSpaced(8, 3, 10), 12, 14, x);
  const MathematicalProgramResult result = SolverInterface(kBackend, Built()).Solve(prog);
  ASSERT_TRUE(result.is_success()) << result.message;
  ASSERT_GT(result.num_suboptimal_solution(), 0);
  double before = result.objective;
  Eigen::VectorXd last = result.GetSolution(x);
  for (int k = 0; k < result.num_suboptimal_solution(); ++k) {
    const Eigen::VectorXd other = result.GetSuboptimalSolution(x, k);
    EXPECT_NE(other, last);
    EXPECT_EQ(other[3], result.GetSuboptimalSolution(x[3], k));
    EXPECT_NEAR(result.get_suboptimal_objective(k), (other - wish).squaredNorm(), 1e-9);
    EXPECT_GE(result.get_suboptimal_objective(k), before - 1e-9);
    for (const double v : other) EXPECT_EQ(v, std::round(v));
    const double sum = Eigen::RowVectorXd::LinSpaced(8, 3, 10) * other;
    EXPECT_TRUE(sum >= 12 && sum <= 14) << sum;
    before = result.get_suboptimal_objective(k);
    last = other;
  }
  try {
    static_cast<void>(result.get_suboptimal_objective(result.num_suboptimal_solution()));
    ADD_FAILURE() << "a solution behind the last";
  } catch (const InvalidArgument& e) {
    EXPECT_THAT(e.what(), HasSubstr("suboptimal solutions, and number"));
  }
}

}  // namespace
}  // namespace switchyard::testing
