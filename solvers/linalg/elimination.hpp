// solvers/linalg/elimination.hpp - what happens to a pattern when it is eliminated in an order.
#pragma once

#include <vector>

#include "solvers/linalg/symmetric_pattern.hpp"

namespace switchyard::linalg {

/// A pattern in an order that is a postorder of its elimination tree: the columns of every subtree
/// are consecutive.
struct Elimination {
  std::vector<Index> order;        // k-th to go, of the given pattern
  PermutedPattern permuted;        // in that order
  std::vector<Index> parent;       // of each column in the elimination tree; -1: a root
  std::vector<Index> column_size;  // entries of each column of L, the diagonal not counted

  /// Entries of L, the diagonal not counted.
  [[nodiscard]] double FactorSize() const;
  /// Multiplications of a factorization.
  [[nodiscard]] double Work() const;
};

/// `order` made a postorder, and what follows from it.
Elimination Eliminate(const SymmetricPattern& pattern, const std::vector<Index>& order);

/// How a pattern is to be eliminated.
struct EliminationWish {
  /// 0 or 1 for each column: one of 1 should go after its neighbours of 0, for accuracy's sake.
  /// Empty: as it likes.
  std::vector<Index> group;
  int factorizations = 20;  // to come
};

/// The order with the least predicted work that respects the groups, or one that does not where it
/// saves most of the work.
struct Planned {
  Elimination elimination;
  bool respects_groups = true;
};
Planned LeastWork(const SymmetricPattern& pattern, const EliminationWish& wish);

}  // namespace switchyard::linalg
