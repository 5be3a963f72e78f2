#include "programs.hpp"
#include "switchyard/problem_update.hpp"

namespace switchyard::test {
namespace {

constexpr double kTolerance = 1e-6;

class UpdatingSolver : public testing::TestWithParam<Named> {
 protected:
  /// The updated instance and a fresh load of the updated problem agree, from where the last solve
  /// ended and from the beginning.
  void ExpectAsFresh(std::uint64_t kind, const ProblemData& before, const sy_update& update) {
    if ((GetParam().table->updates & kind) == 0) GTEST_SKIP() << "not declared";
    const Problem loaded(before);
    Problem updated(before);
    updated.Apply(update);
    BareSolver solver(GetParam());
    solver.Load(loaded.view(), GetParam().table->updates);
    ExpectOptimal(before, solver, solver.Solve(), kTolerance);
    solver.Update(update);
    BareSolver fresh(GetParam());
    fresh.Load(updated.view());
    const Answer expected = fresh.Solve();
    ExpectOptimal(updated.data(), fresh, expected, kTolerance);
    for (const std::uint32_t flags : {std::uint32_t{SY_CONTINUE}, std::uint32_t{0}}) {
      sy_control control = Freely();
      control.flags = flags;
      const Answer a = solver.Solve(control);
      ExpectOptimal(updated.data(), solver, a, kTolerance);
      EXPECT_NEAR(a.result.objective, expected.result.objective,
                  kTolerance * (1 + std::abs(expected.result.objective)));
    }
  }
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(UpdatingSolver);
INSTANTIATE_TEST_SUITE_P(Plugins, UpdatingSolver, testing::ValuesIn(SolversOf(kLinear)), NameOf);

sy_update Nothing() {
  sy_update update = {};
  update.size = sizeof update;
  return update;
}

TEST_P(UpdatingSolver, TakesAllBounds) {
  ProblemData other = Corner();
  other.x_upper = {kInfinity, 0.5};
  other.row_upper = {3.5, kInfinity};
  const Problem problem(other);
  sy_update update = Nothing();
  update.whole = SY_UPDATES_BOUNDS;
  update.problem = &problem.view();
  ExpectAsFresh(SY_UPDATES_BOUNDS, Corner(), update);
}

TEST_P(UpdatingSolver, TakesSingleBounds) {
  const std::int32_t x[] = {1, 0};
  const double x_lower[] = {0.25, -1};
  const double x_upper[] = {0.75, 2};
  const std::int32_t row[] = {0};
  const double row_lower[] = {-kInfinity};
  const double row_upper[] = {2.5};
  sy_update update = Nothing();
  update.num_x = 2;
  update.x = x;
  update.x_lower = x_lower;
  update.x_upper = x_upper;
  update.num_rows = 1;
  update.row = row;
  update.row_lower = row_lower;
  update.row_upper = row_upper;
  ExpectAsFresh(SY_UPDATES_BOUNDS, Corner(), update);
}

TEST_P(UpdatingSolver, TakesCosts) {
  ProblemData other = Corner();
  other.q = {-4, 1};
  other.offset = -3;
  const Problem problem(other);
  sy_update update = Nothing();
  update.whole = SY_UPDATES_VECTORS;
  update.problem = &problem.view();
  ExpectAsFresh(SY_UPDATES_VECTORS, Corner(), update);
}

TEST_P(UpdatingSolver, TakesAFewValuesAndAll) {
  for (const bool all : {false, true}) {
    const ProblemData before = Random(30, 20, 3);
    ProblemData other = before;
    for (double& value : other.A.value) {
      value *= all ? 1.25 : 1;
    }
    other.A.value[7] += 0.125;
    const Problem problem(other);
    sy_update update = Nothing();
    update.whole = SY_UPDATES_VALUES;
    update.problem = &problem.view();
    // Feasibility is no longer by construction: the rows relax with the values.
    ProblemData relaxed = before;
    relaxed.row_lower.assign(relaxed.row_lower.size(), 1);
    relaxed.q.assign(relaxed.q.size(), 1);
    other.row_lower = relaxed.row_lower;
    other.q = relaxed.q;
    const Problem again(other);
    update.problem = &again.view();
    ExpectAsFresh(SY_UPDATES_VALUES, relaxed, update);
  }
}

TEST_P(UpdatingSolver, RemovesRows) {
  const std::int32_t gone[] = {0};
  sy_update update = Nothing();
  update.num_gone_rows = 1;
  update.gone_row = gone;
  ExpectAsFresh(SY_UPDATES_REMOVE, Corner(), update);
}

TEST_P(UpdatingSolver, AppendsVariablesAndRows) {
  const Csc at = Dense({{1, 0}, {0, 1}, {1, -1}}, 2);  // x0 + z <= 2.5, x1 - z >= -1
  const sy_csc view = at.View();
  const double q[] = {-1};
  const double lower[] = {0};
  const double upper[] = {kInfinity};
  const double row_lower[] = {-kInfinity, -1};
  const double row_upper[] = {2.5, kInfinity};
  sy_more more = {};
  more.size = sizeof more;
  more.num_vars = 1;
  more.num_rows = 2;
  more.q = q;
  more.x_lower = lower;
  more.x_upper = upper;
  more.At = &view;
  more.row_lower = row_lower;
  more.row_upper = row_upper;
  sy_update update = Nothing();
  update.more = &more;
  ExpectAsFresh(SY_UPDATES_APPEND, Corner(), update);
}

TEST_P(UpdatingSolver, ResolvesFromItsOwnBasisInFewSteps) {
  const Problem problem(Random(120, 80, 5));
  BareSolver solver(GetParam());
  if (!solver.Has(SY_GIVES_BASIS)) GTEST_SKIP() << "gives no basis";
  solver.Load(problem.view(), SY_UPDATES_BOUNDS);
  const Answer cold = solver.Solve();
  ExpectOptimal(problem.data(), solver, cold, kTolerance);
  ASSERT_GT(cold.result.iterations, 10);
  sy_start start = {};
  start.size = sizeof start;
  start.x_basis = cold.x_basis.data();
  start.row_basis = cold.row_basis.data();
  BareSolver warm(GetParam());
  warm.Load(problem.view());
  warm.WarmStart(start);
  const Answer a = warm.Solve();
  ExpectOptimal(problem.data(), warm, a, kTolerance);
  EXPECT_LE(a.result.iterations, 2);
}

TEST_P(UpdatingSolver, DependsOnNothingItWasNotGiven) {
  const Problem problem(Random(120, 80, 6));
  BareSolver solver(GetParam());
  solver.Load(problem.view());
  const Answer first = solver.Solve();
  const Answer second = solver.Solve();
  EXPECT_EQ(first.x, second.x);
  EXPECT_EQ(first.result.iterations, second.result.iterations);
}

}  // namespace
}  // namespace switchyard::test
