#include "solvers/linalg/supernodes.hpp"

#include <algorithm>

namespace switchyard::linalg {
namespace {

/// A supernode that may still be merged into its parent.
struct Growing {
  Index first, last;  // columns
  Index rows;         // below
  double zeros;       // among its entries, come by merging
};

double EntriesOf(double pivots, double rows) { return pivots * (pivots + 1) / 2 + pivots * rows; }

/// Of merging `child` into `parent`, which follows it: whether the zeros that come are worth it.
bool WorthMerging(const Growing& child, const Growing& parent, double& zeros) {
  const double child_pivots = child.last - child.first + 1;
  const double parent_pivots = parent.last - parent.first + 1;
  const double both = child_pivots + parent_pivots;
  const double entries = EntriesOf(both, parent.rows);
  zeros = entries - EntriesOf(child_pivots, child.rows) - EntriesOf(parent_pivots, parent.rows) +
          child.zeros + parent.zeros;
  if (both <= 4) return zeros <= 0.6 * entries;
  if (both <= 16) return zeros <= 0.3 * entries;
  if (both <= 48) return zeros <= 0.1 * entries;
  return zeros <= 0.03 * entries;
}

/// The columns in supernodes: fundamental ones, then merged with their parents where that pays.
std::vector<Growing> Partition(const Elimination& e) {
  const auto n = static_cast<Index>(e.parent.size());
  std::vector<Growing> stack;  // complete up to the column at hand
  for (Index j = 0; j < n; ++j) {
    Growing node{j, j, e.column_size[j], 0};
    // A node that ends in column j - 1 and whose parent is j may join.
    while (!stack.empty()) {
      const Growing& below = stack.back();
      if (below.last + 1 != node.first || e.parent[below.last] != node.first) break;
      // Only a node's first column can have been somebody's parent: later ones hold their own
      // child.
      double zeros = 0;
      if (!WorthMerging(below, node, zeros)) break;
      node.first = below.first;
      node.zeros = zeros;
      stack.pop_back();
    }
    stack.push_back(node);
  }
  return stack;
}

class Builder {
 public:
  explicit Builder(const Elimination& e)
      : e_(e), n_(static_cast<Index>(e.parent.size())), node_of_(n_), seen_(n_, -1), place_(n_) {}

  Supernodes Build() {
    for (const Growing& g : Partition(e_)) {
      const auto number = static_cast<Index>(made_.nodes.size());
      for (Index j = g.first; j <= g.last; ++j) node_of_[j] = number;
      Supernode& node = made_.nodes.emplace_back();
      node.first = g.first;
      node.pivots = g.last - g.first + 1;
    }
    LinkTree();
    TransposePattern();
    for (std::size_t s = 0; s < made_.nodes.size(); ++s) ListRows(static_cast<Index>(s));
    PlaceInParents();
    return std::move(made_);
  }

 private:
  void LinkTree() {
    const auto count = made_.nodes.size();
    made_.num_children.assign(count, 0);
    children_.assign(count, {});
    for (std::size_t s = 0; s < count; ++s) {
      Supernode& node = made_.nodes[s];
      const Index above = e_.parent[node.first + node.pivots - 1];
      node.parent = above < 0 ? -1 : node_of_[above];
      if (node.parent < 0) continue;
      ++made_.num_children[node.parent];
      children_[node.parent].push_back(static_cast<Index>(s));
    }
  }

  /// Entries of the lower triangle by columns: those of the upper one by rows.
  void TransposePattern() {
    const SymmetricPattern& p = e_.permuted.pattern;
    lower_start_.assign(n_ + 1, 0);
    for (const Index i : p.row) ++lower_start_[i + 1];
    for (Index j = 0; j < n_; ++j) lower_start_[j + 1] += lower_start_[j];
    lower_.resize(p.row.size());
    std::vector<Index> next(lower_start_.begin(), lower_start_.end() - 1);
    for (Index j = 0; j < n_; ++j) {
      for (Index k = p.start[j]; k < p.start[j + 1]; ++k) {
        lower_[next[p.row[k]]++] = {j, e_.permuted.entry[k]};
      }
    }
  }

  void ListRows(Index s) {
    Supernode& node = made_.nodes[s];
    const Index end = node.first + node.pivots;
    node.row_start = static_cast<std::int64_t>(made_.row.size());
    const auto take = [&](Index row) {
      if (row < end || seen_[row] == s) return;
      seen_[row] = s;
      made_.row.push_back(row);
    };
    for (Index j = node.first; j < end; ++j) {
      for (Index k = lower_start_[j]; k < lower_start_[j + 1]; ++k) take(lower_[k].row);
    }
    for (const Index child : children_[s]) {
      const Supernode& c = made_.nodes[child];
      for (Index k = 0; k < c.rows; ++k) take(made_.row[c.row_start + k]);
    }
    std::sort(made_.row.begin() + node.row_start, made_.row.end());
    node.rows = static_cast<Index>(static_cast<std::int64_t>(made_.row.size()) - node.row_start);
    ListEntries(node);
  }

  void Number(const Supernode& node) {
    for (Index k = 0; k < node.pivots; ++k) place_[node.first + k] = k;
    for (Index k = 0; k < node.rows; ++k) place_[made_.row[node.row_start + k]] = node.pivots + k;
  }

  void ListEntries(Supernode& node) {
    Number(node);
    node.entry_start = static_cast<std::int64_t>(made_.entry.size());
    for (Index c = 0; c < node.pivots; ++c) {
      const Index j = node.first + c;
      for (Index k = lower_start_[j]; k < lower_start_[j + 1]; ++k) {
        made_.entry.push_back({lower_[k].entry, place_[lower_[k].row], c});
      }
    }
  }

  void PlaceInParents() {
    made_.in_parent.resize(made_.row.size());
    for (std::size_t s = 0; s < made_.nodes.size(); ++s) {
      Number(made_.nodes[s]);
      for (const Index child : children_[s]) {
        const Supernode& c = made_.nodes[child];
        for (Index k = 0; k < c.rows; ++k) {
          made_.in_parent[c.row_start + k] = place_[made_.row[c.row_start + k]];
        }
      }
    }
  }

  struct Below {
    Index row, entry;
  };
  const Elimination& e_;
  const Index n_;
  Supernodes made_;
  std::vector<Index> node_of_;  // of each column
  std::vector<std::vector<Index>> children_;
  std::vector<Index> lower_start_;
  std::vector<Below> lower_;
  std::vector<Index> seen_, place_;
};

}  // namespace

double Supernodes::FactorSize() const {
  double size = 0;
  for (const Supernode& s : nodes) size += EntriesOf(s.pivots, s.rows);
  return size;
}

double Supernodes::Work() const {
  double work = 0;
  for (const Supernode& s : nodes) {
    const double k = s.pivots, m = s.rows;
    work += k * k * k / 6 + k * k * m / 2 + k * m * m / 2;
  }
  return work;
}

Supernodes FindSupernodes(const Elimination& elimination) { return Builder(elimination).Build(); }

}  // namespace switchyard::linalg
