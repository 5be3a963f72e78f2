// Blocks are what they say: variables that meet nobody else but in rows that join blocks.
#include "solvers/conic/blocks.hpp"

#include <gtest/gtest.h>

#include <set>

#include "solvers/linalg/block_shapes.hpp"
#include "tests/conic/blocky.hpp"

namespace switchyard::conic {
namespace {

/// What every result must be: entries of P and cones within a block or of none; rows of a block
/// hold its variables alone.
void ExpectSeparated(const Form& form, const Blocks& blocks) {
  if (blocks.empty()) return;
  ASSERT_EQ(static_cast<Index>(blocks.of_variable.size()), form.shape.vars);
  ASSERT_EQ(static_cast<Index>(blocks.of_row.size()), form.A.rows);
  std::vector<Index> size(static_cast<std::size_t>(blocks.count), 0);
  for (const Index b : blocks.of_variable) {
    ASSERT_GE(b, -1);
    ASSERT_LT(b, blocks.count);
    if (b >= 0) ++size[b];
  }
  for (const Index s : size) {
    EXPECT_GE(s, 2);
    EXPECT_LE(s, linalg::kMostColumns);
  }
  for (Index j = 0; j < form.shape.vars; ++j) {
    for (Index e = form.P.pattern.start[j]; e < form.P.pattern.start[j + 1]; ++e) {
      EXPECT_EQ(blocks.of_variable[j], blocks.of_variable[form.P.pattern.row[e]]);
    }
  }
  const auto blocks_of = [&](Index row) {
    std::set<Index> met;
    for (Index e = form.A.row_start[row]; e < form.A.row_start[row + 1]; ++e) {
      met.insert(blocks.of_variable[form.A.column[e]]);
    }
    return met;
  };
  for (Index r = 0; r < form.A.rows; ++r) {
    const std::set<Index> met = blocks_of(r);
    const bool within = met.size() == 1 && *met.begin() >= 0;
    EXPECT_EQ(blocks.of_row[r], within ? *met.begin() : -1) << r;
  }
  for (const ConeGroup& g : form.cones) {
    for (Index c = 0; c < g.layout.count; ++c) {
      std::set<Index> met;
      for (Index i = 0; i < g.layout.dim; ++i) met.merge(blocks_of(g.first + g.layout.Row(c, i)));
      EXPECT_LE(met.size(), 1u) << "a cone joins blocks";
    }
  }
}

std::vector<Index> Of(const Form& form, const std::vector<std::int32_t>& hint) {
  std::vector<Index> of_variable;
  for (const Index j : form.variable) of_variable.push_back(hint[j]);
  return of_variable;
}

TEST(GivenBlocks, AreSeparatedWhateverIsGiven) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Blocky shape{10, 5, static_cast<std::int32_t>(seed % 3), 3, 2, seed % 2 == 0};
    const Form form(BlockyOptimum(shape, random).problem);
    BlockHint hint(shape);
    ExpectSeparated(form, GivenBlocks(form, Of(form, hint.x())));
    for (std::int32_t& block : hint.x()) {
      if (random.Chance(0.3)) block = random.Below(15) - 1;
    }
    ExpectSeparated(form, GivenBlocks(form, Of(form, hint.x())));
  }
}

TEST(GivenBlocks, OfARightHintAreThose) {
  Random random(1);
  const Blocky shape{6, 5, 0, 3, 1, false};
  const Form form(BlockyOptimum(shape, random).problem);
  const BlockHint constant(shape);
  BlockHint hint(shape);
  const std::vector<Index> given = Of(form, hint.x());
  const Blocks blocks = GivenBlocks(form, given);
  EXPECT_EQ(blocks.count, 6);
  for (Index j = 0; j < form.shape.vars; ++j) {
    for (Index k = 0; k < form.shape.vars; ++k) {
      EXPECT_EQ(given[j] == given[k], blocks.of_variable[j] == blocks.of_variable[k]);
    }
  }
}

TEST(FindBlocks, AreSeparated) {
  int found = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Blocky shape{20, 4, 0, 2, 2, true};
    const Form form(BlockyOptimum(shape, random).problem);
    const Blocks blocks = FindBlocks(form);
    found += blocks.empty() ? 0 : 1;
    ExpectSeparated(form, blocks);
  }
  EXPECT_GT(found, 10);
}

TEST(FindBlocks, AreNoneWhereEverythingMeets) {
  Random random(2);
  testing::Shape shape{30, 10, {}};
  shape.quadratic = true;
  EXPECT_TRUE(FindBlocks(Form(testing::KnownOptimum(shape, random).problem)).empty());
  EXPECT_TRUE(FindBlocks(Form(testing::KnownOptimum({20, 10, {}}, random).problem)).empty());
}

}  // namespace
}  // namespace switchyard::conic
