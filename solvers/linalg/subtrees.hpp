// solvers/linalg/subtrees.hpp - parts of a tree of fronts that threads can work on apart.
#pragma once

#include <cstddef>
#include <vector>

#include "solvers/linalg/supernodes.hpp"

namespace switchyard::linalg {

/// Parts of about equal work, and the top of the tree, which waits for them. They follow from the
/// tree alone, and so do all sums: factors are the same with any number of threads.
struct Subtrees {
  /// Whole subtrees, one behind the other. What they add to rows above them has a place of its own.
  struct Part {
    std::size_t begin = 0, end = 0;  // nodes
    Index first_place = 0;
    std::vector<Index> above;  // the row of each place, ascending
  };
  std::vector<Part> parts;
  std::vector<std::size_t> top;  // nodes that are in no part
  std::vector<Index> row;        // as Supernodes::row, but a place for what is above one's part
  Index room = 0;                // columns and places
};

Subtrees FindSubtrees(const Supernodes& tree, Index columns);

}  // namespace switchyard::linalg
