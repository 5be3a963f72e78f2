#include "solvers/linalg/subtrees.hpp"

#include <algorithm>

namespace switchyard::linalg {
namespace {

constexpr double kWorthParting = 3e5;  // multiplications of a factorization
constexpr double kShare = 1.0 / 16;    // of them, for a part

/// Multiplications of each node's subtree.
std::vector<double> WorkBelow(const Supernodes& tree) {
  std::vector<double> work(tree.nodes.size());
  for (std::size_t s = 0; s < tree.nodes.size(); ++s) {
    const Supernode& node = tree.nodes[s];
    const double order = node.pivots + node.rows;
    work[s] += node.pivots * order * (order + 1) / 2;
    if (node.parent >= 0) work[node.parent] += work[s];
  }
  return work;
}

/// Subtrees with no more than a share, in their order; neighbours together where they have no more.
std::vector<Subtrees::Part> PartsOf(const Supernodes& tree, const std::vector<double>& work) {
  double all = 0;
  for (std::size_t s = 0; s < tree.nodes.size(); ++s) all += tree.nodes[s].parent < 0 ? work[s] : 0;
  std::vector<Subtrees::Part> parts;
  if (all < kWorthParting) return parts;
  double of_last = 0;
  std::size_t begin = 0;  // of the subtree at hand: behind the last one that was seen
  for (std::size_t s = 0; s < tree.nodes.size(); ++s) {
    const bool small = work[s] <= kShare * all;
    const bool within =
        small && tree.nodes[s].parent >= 0 && work[tree.nodes[s].parent] <= kShare * all;
    if (within) continue;
    if (small) {
      const bool joins =
          !parts.empty() && parts.back().end == begin && of_last + work[s] <= kShare * all;
      of_last = joins ? of_last + work[s] : work[s];
      if (joins) {
        parts.back().end = s + 1;
      } else {
        parts.push_back({begin, s + 1, 0, {}});
      }
    }
    begin = s + 1;
  }
  return parts;
}

}  // namespace

Subtrees FindSubtrees(const Supernodes& tree, Index columns) {
  Subtrees found;
  found.parts = PartsOf(tree, WorkBelow(tree));
  found.row = tree.row;
  found.room = columns;
  std::size_t next = 0;
  std::vector<Index> place(static_cast<std::size_t>(columns), -1);
  for (Subtrees::Part& part : found.parts) {
    for (; next < part.begin; ++next) found.top.push_back(next);
    next = part.end;
    const Supernode& last = tree.nodes[part.end - 1];
    const Index end = last.first + last.pivots;
    const auto rows_begin = found.row.begin() + tree.nodes[part.begin].row_start;
    const auto rows_end = found.row.begin() + last.row_start + last.rows;
    std::copy_if(rows_begin, rows_end, std::back_inserter(part.above),
                 [&](Index row) { return row >= end; });
    std::sort(part.above.begin(), part.above.end());
    part.above.erase(std::unique(part.above.begin(), part.above.end()), part.above.end());
    part.first_place = found.room;
    for (const Index row : part.above) place[row] = found.room++;
    std::for_each(rows_begin, rows_end, [&](Index& row) { row = row >= end ? place[row] : row; });
  }
  for (; next < tree.nodes.size(); ++next) found.top.push_back(next);
  return found;
}

}  // namespace switchyard::linalg
