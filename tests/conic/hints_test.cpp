// The hint sy.blocks/1: it says how, not what.
#include <gtest/gtest.h>

#include "tests/conic/blocky.hpp"

namespace switchyard::conic {
namespace {

constexpr unsigned kSeeds = 8;

/// Shapes with few and many blocks, with and without what couples.
Blocky ShapeOf(unsigned seed) {
  return {seed % 2 == 0 ? 10 : 3,
          5,
          static_cast<std::int32_t>(seed % 3),
          3,
          static_cast<std::int32_t>(seed % 4),
          seed % 2 == 1};
}

void ExpectKnown(const KnownAnswer& known, const ProblemData& given, std::uint64_t updates = 0) {
  for (const int presolve : {0, 1}) {
    SCOPED_TRACE(presolve);
    const Found found = Solver().Set("presolve", presolve).Load(given, updates).Solve();
    ExpectOptimal(known.problem, found);
    ExpectSameOptimum(known.problem, found, OptimumOf(known));
  }
}

TEST(BlocksHint, WithItAndWithoutItIsTheSameOptimum) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Blocky shape = ShapeOf(seed);
    const KnownAnswer known = BlockyOptimum(shape, random);
    const BlockHint hint(shape);
    ExpectKnown(known, known.problem);
    ExpectKnown(known, hint.Given(known.problem));
    ExpectKnown(known, hint.Given(known.problem), Conic::Describe().updates);
    Solver ignoring;
    ignoring.Set("blocks", 0).Load(hint.Given(known.problem));
    ExpectOptimal(known.problem, ignoring.Solve());
  }
}

// Coupling variables put in blocks that rows of other blocks hold too, blocks torn apart, blocks
// joined, numbers that are not used: the answer does not depend on it.
TEST(BlocksHint, ThatIsWrongCostsNoAnswer) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Blocky shape = ShapeOf(seed);
    shape.coupling = 3;
    const KnownAnswer known = BlockyOptimum(shape, random);
    {
      SCOPED_TRACE("coupling variables in blocks");
      BlockHint hint(shape);
      for (std::int32_t& block : hint.x()) block = block < 0 ? random.Below(shape.blocks) : block;
      ExpectKnown(known, hint.Given(known.problem));
    }
    {
      SCOPED_TRACE("some variables elsewhere");
      BlockHint hint(shape);
      for (std::int32_t& block : hint.x()) {
        if (random.Chance(0.2)) block = random.Below(shape.blocks + 1) - 1;
      }
      ExpectKnown(known, hint.Given(known.problem));
    }
    {
      SCOPED_TRACE("one block, and none");
      for (const std::int32_t all : {0, -1}) {
        BlockHint hint(shape);
        for (std::int32_t& block : hint.x()) block = all;
        ExpectKnown(known, hint.Given(known.problem));
      }
    }
    {
      SCOPED_TRACE("each variable a block");
      BlockHint hint(shape);
      std::int32_t count = 0;
      for (std::int32_t& block : hint.x()) block = count++;
      ExpectKnown(known, hint.Given(known.problem));
    }
  }
}

TEST(BlocksHint, HoldsForVariablesThatAreAppendedAfterIt) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Blocky shape = ShapeOf(seed);
    const KnownAnswer known = Boxed(BlockyOptimum(shape, random), random);
    const BlockHint hint(shape);
    Solver solver(hint.Given(known.problem), Conic::Describe().updates);
    ExpectOptimal(known.problem, solver.Solve());
    // A new variable y <= 1 at a cost of -1, in a row with all others that keeps room for it.
    const std::int32_t vars = known.problem.num_vars + 1;
    Csc at(vars, 1);
    double activity = 0;
    for (std::int32_t j = 0; j < vars; ++j) {
      at.row.push_back(j);
      at.value.push_back(j + 1 < vars ? random.Normal() : 1);
      if (j + 1 < vars) activity += at.value.back() * known.at.x[j];
    }
    at.start = {0, vars};
    const sy_csc view = at.View();
    const double q[] = {-1}, lower[] = {-1}, upper[] = {1}, row_lower[] = {-kInfinity};
    const double row_upper[] = {activity + 1.5};
    sy_more more = {};
    more.size = sizeof more;
    more.num_vars = more.num_rows = 1;
    more.q = q;
    more.x_lower = lower;
    more.x_upper = upper;
    more.At = &view;
    more.row_lower = row_lower;
    more.row_upper = row_upper;
    sy_update update = Nothing();
    update.more = &more;
    solver.Update(update);
    const Found found = solver.Solve();
    ExpectOptimal(solver.data(), found);
    // The known optimum stays one, with y = 1 beside it: the new row has room there.
    ExpectSameOptimum(solver.data(), found, OptimumOf(known) - 1);
    Solver clone = solver.Clone();
    EXPECT_EQ(clone.Solve().at.x, found.at.x);
  }
}

// Large enough that threads share it.
TEST(BlocksHint, WithMoreThreadsIsTheSameAnswer) {
  for (const bool quadratic : {true, false}) {
    SCOPED_TRACE(quadratic);
    Random random(quadratic ? 1 : 2);
    const Blocky shape{400, 20, 2, 10, 2, quadratic};
    const KnownAnswer known = BlockyOptimum(shape, random);
    const BlockHint hint(shape);
    Solver solver(hint.Given(known.problem));
    const Found expected = solver.Solve();
    for (const int threads : {2, 3}) {
      sy_control control = Freely();
      control.threads = threads;
      const Found found = solver.Solve(control);
      ExpectOptimal(known.problem, found);
      EXPECT_EQ(found.at.x, expected.at.x);
      EXPECT_EQ(found.at.cone_dual, expected.at.cone_dual);
    }
  }
}

TEST(BlocksHint, AmongOthersThatAreNotKnown) {
  Random random(1);
  const Blocky shape;
  const KnownAnswer known = BlockyOptimum(shape, random);
  const BlockHint hint(shape);
  ProblemData d = hint.Given(known.problem);
  const sy_hint hints[] = {{"com.example.other/3", nullptr}, *d.hints, {nullptr, nullptr}};
  d.hints = hints;
  ExpectKnown(known, d);
  const sy_hint others[] = {{"com.example.other/3", nullptr}, {nullptr, nullptr}};
  d.hints = others;
  ExpectKnown(known, d);
}

}  // namespace
}  // namespace switchyard::conic
