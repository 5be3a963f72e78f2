// solvers/linalg/block_shapes.hpp - blocks of a bordered block-diagonal matrix, those alike
// together.
#pragma once

#include <vector>

#include "solvers/linalg/symmetric_pattern.hpp"

namespace switchyard::linalg {

/// Columns of a block, at most.
inline constexpr Index kMostColumns = 256;

/// What blocks of one shape have in common: a matrix of `columns` columns of their own and `border`
/// rows of the rest, and its elimination. Positions count the entries of L, by columns in the order
/// of elimination: the diagonal, then what is below it, own rows before the border's.
struct BlockShape {
  Index columns = 0;
  Index border = 0;
  std::vector<std::int8_t> sign;    // in the order of elimination
  std::vector<Index> column_start;  // columns + 1, of positions
  std::vector<Index> row;  // of each position: own in the order of elimination, then border
  std::vector<Index> entry_position;  // of each given entry
  /// Elimination of column k takes, from the pairs (a, b), b <= a, of its rows, in the order
  /// b = first row, ..., a = b, ...: the position in L, or for two of the border ~ the place in the
  /// triangle of the border (a (a + 1) / 2 + b).
  std::vector<Index> target;
  /// Columns eliminated together with column k, where they begin with it: 4, 2 or 1, each but the
  /// last with the next one and that one's rows as its own.
  std::vector<Index> panel;

  [[nodiscard]] Index positions() const { return column_start.back(); }
  [[nodiscard]] Index border_pairs() const { return border * (border + 1) / 2; }
};

/// Blocks of a shape: what each one's columns, border rows and entries are in the whole matrix.
struct BlockClass {
  BlockShape shape;
  Index count = 0;
  // Block by block.
  std::vector<Index> column;  // in the order of elimination
  std::vector<Index> border;
  std::vector<Index> entry;
};

/// Sorts blocks by shape. `block`: of each column; -1: of the rest. An entry between two blocks is
/// a mistake of the caller's.
std::vector<BlockClass> ClassifyBlocks(const SymmetricPattern& pattern,
                                       const std::vector<std::int8_t>& sign,
                                       const std::vector<Index>& block, Index count);

}  // namespace switchyard::linalg
