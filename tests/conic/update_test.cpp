// Each kind of update: the answer is that of a fresh load.
#include <gtest/gtest.h>

#include "tests/conic/evolving.hpp"

namespace switchyard::conic {
namespace {

constexpr std::uint64_t kAll = SY_UPDATES_BOUNDS | SY_UPDATES_VECTORS | SY_UPDATES_VALUES |
                               SY_UPDATES_SWITCH | SY_UPDATES_APPEND | SY_UPDATES_REMOVE |
                               SY_UPDATES_HINTS;

class Updates : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  static constexpr unsigned kSeeds = 8;

  /// An update of programs around a point that stays feasible; `kinds` are told of at load.
  template <class Make>
  void ForSeeds(Make&& update) {
    for (unsigned seed = 0; seed < kSeeds; ++seed) {
      SCOPED_TRACE(seed);
      Evolving program(seed);
      Solver solver(program.data(), GetParam());
      ExpectOptimal(solver.data(), solver.Solve());
      update(program);
      program.Send(solver);
      program.ExpectAsFresh(solver);
    }
  }
};

TEST_P(Updates, OfAllBounds) {
  ForSeeds([](Evolving& program) { program.MoveAllBounds(); });
}
TEST_P(Updates, OfSingleBounds) {
  ForSeeds([](Evolving& program) { program.MoveSingleBounds(4); });
}
TEST_P(Updates, OfSingleBoundsToFixed) {
  ForSeeds([](Evolving& program) { program.FixVariables(2); });
}
TEST_P(Updates, OfVectors) {
  ForSeeds([](Evolving& program) { program.ChangeCosts(); });
}
TEST_P(Updates, OfValues) {
  ForSeeds([](Evolving& program) { program.ChangeValues(); });
}
TEST_P(Updates, OfConesOff) {
  ForSeeds([](Evolving& program) { program.SwitchCones(2); });
}
TEST_P(Updates, ThatRemoveRows) {
  ForSeeds([](Evolving& program) { program.RemoveRows(2); });
}
TEST_P(Updates, ThatRemoveCones) {
  ForSeeds([](Evolving& program) { program.RemoveCones(2); });
}
TEST_P(Updates, ThatAppend) {
  ForSeeds([](Evolving& program) { program.Append(); });
}
TEST_P(Updates, OfAllAtOnce) {
  ForSeeds([](Evolving& program) {
    program.MoveSingleBounds(2);
    program.SwitchCones(1);
    program.RemoveRows(1);
    program.RemoveCones(1);
    program.Append();
  });
}

INSTANTIATE_TEST_SUITE_P(ToldOf, Updates, ::testing::Values(std::uint64_t{0}, kAll),
                         [](const auto& of) { return of.param == 0 ? "none" : "all"; });

TEST(Update, OffAndOnAgainIsTheSameProgram) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    const Evolving program(seed);
    Solver solver(program.data(), kAll);
    const Found before = solver.Solve();
    const std::int32_t cone[] = {0, 2};
    for (const std::uint8_t on : {std::uint8_t{0}, std::uint8_t{1}}) {
      const std::uint8_t switched[] = {on, on};
      sy_update update = Nothing();
      update.num_cones = 2;
      update.cone = cone;
      update.cone_on = switched;
      solver.Update(update);
      const Found found = solver.Solve();
      ExpectOptimal(solver.data(), found);
      EXPECT_LE(found.result.objective, before.result.objective + 1e-6);
    }
    EXPECT_EQ(solver.Solve().at.x, before.at.x);
  }
}

/// What may follow a load that was told of it, and leaves all patterns as they are.
class SharedPhase : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(SharedPhase, IsThatOfTheLoadWhereThePatternStays) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    Evolving program(seed);
    Solver solver(program.data(), GetParam());
    EXPECT_FALSE(solver.shares());
    for (int k = 0; k < 3; ++k) {
      if (GetParam() == SY_UPDATES_VECTORS) program.ChangeCosts();
      if (GetParam() == SY_UPDATES_VALUES) program.ScaleValues();
      if (GetParam() == SY_UPDATES_BOUNDS) program.MoveFiniteBounds();
      program.Send(solver);
      EXPECT_TRUE(solver.shares());
      program.ExpectAsFresh(solver);
    }
    program.Append();
    program.Send(solver);
    EXPECT_FALSE(solver.shares()) << "after rows were appended";
    program.ExpectAsFresh(solver);
  }
}

INSTANTIATE_TEST_SUITE_P(By, SharedPhase,
                         ::testing::Values(std::uint64_t{SY_UPDATES_BOUNDS},
                                           std::uint64_t{SY_UPDATES_VECTORS},
                                           std::uint64_t{SY_UPDATES_VALUES}),
                         [](const auto& of) {
                           return of.param == SY_UPDATES_BOUNDS    ? "bounds"
                                  : of.param == SY_UPDATES_VECTORS ? "vectors"
                                                                   : "values";
                         });

TEST(Update, AfterTheSharedPhaseIsToTheLastDigitThatOfAFreshLoad) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    Evolving program(seed);
    Solver solver(program.data(), kAll);
    solver.Solve();
    program.ChangeCosts();
    program.Send(solver);
    const Found updated = solver.Solve(), fresh = Solver(program.data(), kAll).Solve();
    EXPECT_EQ(updated.at.x, fresh.at.x);
    EXPECT_EQ(updated.at.row_dual, fresh.at.row_dual);
    EXPECT_EQ(updated.result.iterations, fresh.result.iterations);
  }
}

TEST(Update, ThatDoesNotFitLeavesTheProgramAsItWas) {
  const Evolving program(3);
  Solver solver(program.data(), kAll);
  const Found before = solver.Solve();
  const std::int32_t beyond[] = {program.data().num_vars};
  const double side[] = {0};
  sy_update update = Nothing();
  update.num_x = 1;
  update.x = beyond;
  update.x_lower = update.x_upper = side;
  EXPECT_THROW(solver.Update(update), std::invalid_argument);
  EXPECT_EQ(solver.Solve().at.x, before.at.x);
}

TEST(Update, ToAContradictionAndBack) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    Evolving program(seed);
    Solver solver(program.data(), kAll);
    const Found before = solver.Solve();
    ExpectOptimal(program.data(), before);
    // The first row's sides move out of what the boxes allow it.
    const ProblemData& d = program.data();
    const std::int32_t row[] = {0};
    const double far = 1 + 1e2 * d.num_vars;
    const double lower[] = {far}, upper[] = {2 * far};
    sy_update update = Nothing();
    update.num_rows = 1;
    update.row = row;
    update.row_lower = lower;
    update.row_upper = upper;
    solver.Update(update);
    ExpectContradiction(solver.data(), solver.Solve());
    update.row_lower = &d.row_lower[0];
    update.row_upper = &d.row_upper[0];
    solver.Update(update);
    const Found after = solver.Solve();
    ExpectOptimal(program.data(), after);
    EXPECT_EQ(after.at.x, before.at.x);
  }
}

}  // namespace
}  // namespace switchyard::conic
