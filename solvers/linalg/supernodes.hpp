// solvers/linalg/supernodes.hpp - columns of L that are eliminated together, as one dense front.
#pragma once

#include <cstdint>
#include <vector>

#include "solvers/linalg/elimination.hpp"

namespace switchyard::linalg {

/// Consecutive columns whose rows below are (nearly) the same.
struct Supernode {
  Index first = 0;   // column
  Index pivots = 0;  // columns
  Index rows = 0;    // below the pivots
  Index parent = -1;
  std::int64_t row_start = 0;    // of its rows, and of their places in the parent's front
  std::int64_t entry_start = 0;  // of its entries of the matrix
};

/// An entry of the matrix and where it goes: row `row` of the front (pivots first), column
/// `column`.
struct FrontEntry {
  Index entry;
  Index row;
  Index column;
};

/// The tree of fronts, children before parents.
struct Supernodes {
  std::vector<Supernode> nodes;
  std::vector<Index> row;        // column numbers, ascending within a node
  std::vector<Index> in_parent;  // of each row: its place in the parent's front, pivots first
  std::vector<FrontEntry> entry;
  std::vector<Index> num_children;

  /// Entries of all fronts' columns, zeros that came by merging counted.
  [[nodiscard]] double FactorSize() const;
  [[nodiscard]] double Work() const;
};

/// A column joins its parent's where that adds few zeros: fronts that are too small cost more than
/// the zeros do.
Supernodes FindSupernodes(const Elimination& elimination);

}  // namespace switchyard::linalg
