#include "solvers/linalg/elimination.hpp"

#include <cmath>
#include <numeric>
#include <utility>

#include "solvers/linalg/ordering.hpp"

namespace switchyard::linalg {
namespace {

/// Parents in the elimination tree: the row of the first entry below the diagonal of each column of
/// L. Paths are compressed through `ancestor` (Liu, ACM Trans. Math. Softw. 12, 1986).
std::vector<Index> TreeOf(const SymmetricPattern& p) {
  std::vector<Index> parent(p.n, -1), ancestor(p.n, -1);
  for (Index j = 0; j < p.n; ++j) {
    for (Index k = p.start[j]; k < p.start[j + 1]; ++k) {
      for (Index i = p.row[k]; i != -1 && i < j;) {
        const Index next = ancestor[i];
        ancestor[i] = j;
        if (next == -1) parent[i] = j;
        i = next;
      }
    }
  }
  return parent;
}

/// Children before parents, each subtree in one piece; children in their order.
std::vector<Index> PostorderOf(const std::vector<Index>& parent) {
  const auto n = static_cast<Index>(parent.size());
  std::vector<Index> first_child(n, -1), sibling(n, -1), order, stack;
  for (Index j = n - 1; j >= 0; --j) {
    if (parent[j] < 0) continue;
    sibling[j] = first_child[parent[j]];
    first_child[parent[j]] = j;
  }
  order.reserve(n);
  for (Index root = 0; root < n; ++root) {
    if (parent[root] >= 0) continue;
    stack.push_back(root);
    while (!stack.empty()) {
      const Index j = stack.back();
      const Index child = first_child[j];
      if (child < 0) {
        order.push_back(j);
        stack.pop_back();
      } else {
        first_child[j] = sibling[child];
        stack.push_back(child);
      }
    }
  }
  return order;
}

/// Row j of L holds the paths from the entries of column j of the upper triangle towards j in the
/// tree: each node on one counts an entry of its column.
std::vector<Index> ColumnSizes(const SymmetricPattern& p, const std::vector<Index>& parent) {
  std::vector<Index> size(p.n, 0), seen(p.n, -1);
  for (Index j = 0; j < p.n; ++j) {
    seen[j] = j;
    for (Index k = p.start[j]; k < p.start[j + 1]; ++k) {
      for (Index i = p.row[k]; seen[i] != j; i = parent[i]) {
        ++size[i];
        seen[i] = j;
      }
    }
  }
  return size;
}

}  // namespace

double Elimination::FactorSize() const {
  return std::accumulate(column_size.begin(), column_size.end(), 0.0);
}

double Elimination::Work() const {
  double work = 0;
  for (const double size : column_size) work += size * (size + 3) / 2;
  return work;
}

Elimination Eliminate(const SymmetricPattern& pattern, const std::vector<Index>& order) {
  const std::vector<Index> postorder = PostorderOf(TreeOf(Permuted(pattern, order).pattern));
  Elimination e;
  e.order.reserve(order.size());
  for (const Index k : postorder) e.order.push_back(order[k]);
  e.permuted = Permuted(pattern, e.order);
  e.parent = TreeOf(e.permuted.pattern);
  e.column_size = ColumnSizes(e.permuted.pattern, e.parent);
  return e;
}

Planned LeastWork(const SymmetricPattern& pattern, const EliminationWish& wish) {
  // Multiplications in the time that nested dissection takes, for each entry of the pattern.
  constexpr double kSearch = 4000;
  // How much more work accuracy is worth, and what is done in no time.
  constexpr double kWorth = 4, kNoTime = 1e5;
  Planned best;
  double best_cost = HUGE_VAL;
  const auto take = [&](Elimination other, bool respects) {
    const double cost = other.Work() * (respects ? 1 : kWorth) + (respects ? 0 : kNoTime);
    if (cost >= best_cost) return;
    best = {std::move(other), respects};
    best_cost = cost;
  };
  const auto try_order = [&](const std::vector<Index>& order) {
    if (order.empty()) return;
    Elimination free = Eliminate(pattern, order);
    const bool hopeless = free.Work() >= best_cost;
    if (!wish.group.empty() && !hopeless) {
      take(Eliminate(pattern, Delayed(pattern, wish.group, free.order)), true);
    }
    take(std::move(free), wish.group.empty());
  };
  try_order(MinimumDegreeOrder(pattern));
  if (best.elimination.Work() * wish.factorizations / 2 > kSearch * pattern.nonzeros()) {
    try_order(NestedDissectionOrder(pattern));
  }
  return best;
}

}  // namespace switchyard::linalg
