// tests/linalg/bordered.hpp - random bordered block-diagonal matrices.
#pragma once

#include <vector>

#include "tests/linalg/matrices.hpp"

namespace switchyard::linalg {

/// Equal blocks: as many columns, rows of the border that each meets, entries of them.
struct BlockKind {
  Index columns, border, count;
  double density;
};

struct Bordered {
  Signs sign;
  Pairs pairs;
  std::vector<Index> block;  // of each column; -1: of the rest
  Index count = 0;           // of blocks
};

/// Columns of all blocks and of the rest stand in any order, but those of a block as in all of its
/// kind.
inline Bordered RandomBordered(Random& random, const std::vector<BlockKind>& kinds, Index rest,
                               double rest_density) {
  Bordered b;
  std::vector<Index> kind_of;  // of each block
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    kind_of.insert(kind_of.end(), kinds[k].count, static_cast<Index>(k));
  }
  b.count = static_cast<Index>(kind_of.size());
  Shuffle(random, kind_of);
  for (Index i = 0; i < b.count; ++i) b.block.insert(b.block.end(), kinds[kind_of[i]].columns, i);
  b.block.insert(b.block.end(), rest, -1);
  Shuffle(random, b.block);
  std::vector<std::vector<Index>> own(b.count);
  std::vector<Index> outside;
  for (Index j = 0; j < static_cast<Index>(b.block.size()); ++j) {
    (b.block[j] < 0 ? outside : own[b.block[j]]).push_back(j);
  }
  b.sign = RandomSigns(random, static_cast<Index>(b.block.size()));
  for (const auto& [i, j] : SparsePairs(random, rest, rest_density)) {
    b.pairs.insert({outside[i], outside[j]});
  }
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const BlockKind& kind = kinds[k];
    const Signs sign = RandomSigns(random, kind.columns);
    const Pairs inside = SparsePairs(random, kind.columns, kind.density);
    Pairs joints;  // own, row of the border
    for (Index r = 0; r < kind.border; ++r) {
      joints.insert({random.Below(kind.columns), r});
      for (Index c = 0; c < kind.columns; ++c) {
        if (random.Chance(kind.density)) joints.insert({c, r});
      }
    }
    for (Index i = 0; i < b.count; ++i) {
      if (kind_of[i] != static_cast<Index>(k)) continue;
      for (Index c = 0; c < kind.columns; ++c) b.sign[own[i][c]] = sign[c];
      for (const auto& [r, c] : inside) b.pairs.insert({own[i][r], own[i][c]});
      std::vector<Index> border = outside;
      Shuffle(random, border);
      for (const auto& [c, r] : joints) b.pairs.insert(std::minmax(own[i][c], border[r]));
    }
  }
  return b;
}

struct BorderedCase {
  const char* name;
  std::vector<BlockKind> kinds;
  Index rest;
  double rest_density;
};

inline std::ostream& operator<<(std::ostream& out, const BorderedCase& c) { return out << c.name; }

inline std::string NameOfBordered(const ::testing::TestParamInfo<BorderedCase>& c) {
  return c.param.name;
}

/// Kinds of one case differ in their columns.
inline const std::vector<BorderedCase>& BorderedCases() {
  static const std::vector<BorderedCase> cases = {
      {"nothing", {}, 0, 0},
      {"no_blocks", {}, 30, 0.2},
      {"one_block_alone", {{6, 0, 1, 0.5}}, 0, 0},
      {"blocks_alone", {{5, 0, 19, 0.4}}, 0, 0},
      {"blocks_that_meet_nothing", {{5, 0, 11, 0.4}}, 12, 0.3},
      {"blocks_without_columns", {{0, 0, 10, 0}}, 5, 0.5},
      {"single_columns", {{1, 2, 23, 0.5}}, 9, 0.2},
      {"fewer_than_a_batch", {{4, 3, 5, 0.5}}, 8, 0.2},
      {"one_batch", {{4, 3, 8, 0.5}}, 8, 0.2},
      {"more_than_a_batch", {{6, 4, 21, 0.4}}, 10, 0.1},
      {"diagonal_blocks", {{7, 3, 17, 0}}, 10, 0.1},
      {"full_blocks", {{9, 8, 10, 1}}, 8, 1},
      {"several_shapes", {{3, 2, 17, 0.5}, {8, 5, 9, 0.3}, {20, 6, 3, 0.2}, {2, 0, 8, 1}}, 12, 0.1},
      {"blocks_of_many_columns", {{90, 10, 2, 0.05}}, 15, 0.2},
      {"border_of_one", {{5, 1, 33, 0.5}}, 1, 0},
  };
  return cases;
}

inline Bordered RandomOf(const BorderedCase& c, Random& random) {
  return RandomBordered(random, c.kinds, c.rest, c.rest_density);
}

}  // namespace switchyard::linalg
