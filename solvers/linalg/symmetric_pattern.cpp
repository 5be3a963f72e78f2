#include "solvers/linalg/symmetric_pattern.hpp"

#include <algorithm>
#include <numeric>

namespace switchyard::linalg {

std::vector<Index> Inverse(const std::vector<Index>& order) {
  std::vector<Index> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = static_cast<Index>(k);
  return place;
}

// Two passes of bucket sort, by row and then by column, leave rows ascending in each column.
PermutedPattern Permuted(const SymmetricPattern& given, const std::vector<Index>& order) {
  const std::vector<Index> place = Inverse(order);
  const Index n = given.n, count = given.nonzeros();
  std::vector<Index> row(count), column(count), by_row(n + 1, 0);
  PermutedPattern made;
  SymmetricPattern& p = made.pattern;
  p.n = n;
  p.start.assign(n + 1, 0);
  for (Index j = 0; j < n; ++j) {
    for (Index k = given.start[j]; k < given.start[j + 1]; ++k) {
      const auto [low, high] = std::minmax(place[given.row[k]], place[j]);
      row[k] = low;
      column[k] = high;
      ++by_row[low + 1];
      ++p.start[high + 1];
    }
  }
  std::partial_sum(by_row.begin(), by_row.end(), by_row.begin());
  std::partial_sum(p.start.begin(), p.start.end(), p.start.begin());
  std::vector<Index> sorted(count), next(p.start.begin(), p.start.end() - 1);
  for (Index k = 0; k < count; ++k) sorted[by_row[row[k]]++] = k;
  p.row.resize(count);
  made.entry.resize(count);
  for (const Index k : sorted) {
    const Index to = next[column[k]]++;
    p.row[to] = row[k];
    made.entry[to] = k;
  }
  return made;
}

}  // namespace switchyard::linalg
