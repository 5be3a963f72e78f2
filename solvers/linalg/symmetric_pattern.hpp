// solvers/linalg/symmetric_pattern.hpp - where a sparse symmetric matrix has entries.
#pragma once

#include <cstdint>
#include <vector>

namespace switchyard::linalg {

using Index = std::int32_t;

/// The upper triangle by columns: entry k of column j stands in row[k] <= j. Rows of a column need
/// not ascend and hold no duplicates; a diagonal entry that is absent is 0.
struct SymmetricPattern {
  Index n = 0;
  std::vector<Index> start = {0};  // n + 1
  std::vector<Index> row;

  [[nodiscard]] Index nonzeros() const { return start.back(); }
};

/// A pattern with its rows and columns in another order, entries ascending, and where they came
/// from.
struct PermutedPattern {
  SymmetricPattern pattern;
  std::vector<Index> entry;  // of the given pattern, for each entry of this one
};

/// Row and column k are those of order[k].
PermutedPattern Permuted(const SymmetricPattern& given, const std::vector<Index>& order);

/// place[order[k]] = k.
std::vector<Index> Inverse(const std::vector<Index>& order);

}  // namespace switchyard::linalg
