#include "solvers/linalg/block_shapes.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "solvers/linalg/ordering.hpp"

namespace switchyard::linalg {
namespace {

/// A block by itself: entries with own columns and border rows numbered from 0.
struct Local {
  struct Place {
    Index row, column;  // row < columns: own; else border
    bool operator==(const Place&) const = default;
    auto operator<=>(const Place&) const = default;
  };
  std::vector<Index> column, border;  // of the whole matrix
  std::vector<Place> place;
  std::vector<Index> entry;
  std::vector<std::int8_t> sign;
};

/// Orders blocks such that those of one shape are equal.
struct ByShape {
  bool operator()(const Local* a, const Local* b) const {
    const auto sizes = [](const Local* l) { return std::pair(l->column.size(), l->border.size()); };
    if (sizes(a) != sizes(b)) return sizes(a) < sizes(b);
    if (a->sign != b->sign) return a->sign < b->sign;
    return a->place < b->place;
  }
};

/// An entry that joins an own column to a row of the border.
struct Joint {
  Index outside, own, entry;
};

/// Numbers the rows of the border by which own columns they meet: those that meet the same may
/// change places without a change of shape.
void AddBorder(std::vector<Joint>& joints, Local& l) {
  std::sort(joints.begin(), joints.end(), [](const Joint& a, const Joint& b) {
    return a.outside != b.outside ? a.outside < b.outside : a.own < b.own;
  });
  struct Row {
    std::size_t first, count;
  };
  std::vector<Row> rows;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    if (k == 0 || joints[k].outside != joints[k - 1].outside) rows.push_back({k, 0});
    ++rows.back().count;
  }
  std::stable_sort(rows.begin(), rows.end(), [&](const Row& a, const Row& b) {
    const auto of = [&](const Row& row) {
      return joints.begin() + static_cast<std::ptrdiff_t>(row.first);
    };
    return std::lexicographical_compare(
        of(a), of(a) + static_cast<std::ptrdiff_t>(a.count), of(b),
        of(b) + static_cast<std::ptrdiff_t>(b.count),
        [](const Joint& x, const Joint& y) { return x.own < y.own; });
  });
  const auto columns = static_cast<Index>(l.column.size());
  for (const Row& row : rows) {
    const Index number = columns + static_cast<Index>(l.border.size());
    l.border.push_back(joints[row.first].outside);
    for (std::size_t k = row.first; k < row.first + row.count; ++k) {
      l.place.push_back({number, joints[k].own});
      l.entry.push_back(joints[k].entry);
    }
  }
}

/// As much as each block needs, at once.
void MakeRoom(const SymmetricPattern& p, const std::vector<Index>& block, std::vector<Local>& local,
              std::vector<std::vector<Joint>>& joints) {
  struct Count {
    std::size_t columns = 0, own = 0, joints = 0;
  };
  std::vector<Count> count(local.size());
  for (Index j = 0; j < p.n; ++j) {
    if (block[j] >= 0) ++count[block[j]].columns;
    for (Index e = p.start[j]; e < p.start[j + 1]; ++e) {
      const Index a = block[p.row[e]], b = block[j];
      if (a >= 0 && b >= 0) {
        ++count[b].own;
      } else if (a >= 0 || b >= 0) {
        ++count[std::max(a, b)].joints;
      }
    }
  }
  for (std::size_t b = 0; b < local.size(); ++b) {
    local[b].column.reserve(count[b].columns);
    local[b].sign.reserve(count[b].columns);
    local[b].place.reserve(count[b].own + count[b].joints);
    local[b].entry.reserve(count[b].own + count[b].joints);
    joints[b].reserve(count[b].joints);
  }
}

std::vector<Local> Separate(const SymmetricPattern& p, const std::vector<std::int8_t>& sign,
                            const std::vector<Index>& block, Index count) {
  std::vector<Local> local(count);
  std::vector<Index> own(p.n, -1);
  std::vector<std::vector<Joint>> joints(count);
  MakeRoom(p, block, local, joints);
  for (Index j = 0; j < p.n; ++j) {
    if (block[j] < 0) continue;
    Local& l = local[block[j]];
    own[j] = static_cast<Index>(l.column.size());
    l.column.push_back(j);
    l.sign.push_back(sign[j]);
  }
  for (Index j = 0; j < p.n; ++j) {
    for (Index e = p.start[j]; e < p.start[j + 1]; ++e) {
      const Index i = p.row[e];
      if (block[i] >= 0 && block[j] >= 0) {
        Local& l = local[block[j]];
        l.place.push_back({std::max(own[i], own[j]), std::min(own[i], own[j])});
        l.entry.push_back(e);
      } else if (block[i] >= 0) {
        joints[block[i]].push_back({j, own[i], e});
      } else if (block[j] >= 0) {
        joints[block[j]].push_back({i, own[j], e});
      }
    }
  }
  for (Index b = 0; b < count; ++b) AddBorder(joints[b], local[b]);
  return local;
}

/// Entries in one order, so that equal shapes are equal lists.
void Sort(Local& l) {
  if (std::is_sorted(l.place.begin(), l.place.end())) return;
  std::vector<Index> order(l.place.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return l.place[a] < l.place[b]; });
  std::vector<Local::Place> place;
  std::vector<Index> entry;
  place.reserve(order.size());
  entry.reserve(order.size());
  for (const Index k : order) {
    place.push_back(l.place[k]);
    entry.push_back(l.entry[k]);
  }
  l.place = std::move(place);
  l.entry = std::move(entry);
}

/// Own columns by minimum degree, one of negative sign after its neighbours of positive sign.
std::vector<Index> LocalOrder(const Local& l) {
  SymmetricPattern own;
  own.n = static_cast<Index>(l.column.size());
  std::vector<std::vector<Index>> rows(own.n);
  for (const Local::Place& at : l.place) {
    if (at.row < own.n) rows[at.row].push_back(at.column);
  }
  own.start = {0};
  for (Index j = 0; j < own.n; ++j) {
    std::sort(rows[j].begin(), rows[j].end());
    own.row.insert(own.row.end(), rows[j].begin(), rows[j].end());
    own.start.push_back(static_cast<Index>(own.row.size()));
  }
  std::vector<Index> group(own.n);
  for (Index j = 0; j < own.n; ++j) group[j] = l.sign[j] > 0 ? 0 : 1;
  return Delayed(own, group, MinimumDegreeOrder(own));
}

class ShapeBuilder {
 public:
  explicit ShapeBuilder(const Local& l)
      : l_(l),
        n_(static_cast<Index>(l.column.size())),
        m_(static_cast<Index>(l.border.size())),
        order_(LocalOrder(l)) {}

  [[nodiscard]] const std::vector<Index>& order() const { return order_; }

  BlockShape Build() {
    BlockShape s;
    s.columns = n_;
    s.border = m_;
    const std::vector<Index> place = Inverse(order_);
    const auto at = [&](Index row) { return row < n_ ? place[row] : row; };
    // Rows of each column of L, filled in by what is eliminated before.
    std::vector<std::vector<Index>> rows(n_);
    for (const Local::Place& p : l_.place) {
      const Index a = at(p.row), b = at(p.column);
      if (a != b) rows[std::min(a, b)].push_back(std::max(a, b));
    }
    for (Index k = 0; k < n_; ++k) {
      std::sort(rows[k].begin(), rows[k].end());
      rows[k].erase(std::unique(rows[k].begin(), rows[k].end()), rows[k].end());
      if (rows[k].empty() || rows[k][0] >= n_) continue;
      std::vector<Index>& above = rows[rows[k][0]];  // the parent takes all of it
      above.insert(above.end(), rows[k].begin() + 1, rows[k].end());
    }
    s.panel = MakePanels(rows);
    s.column_start = {0};
    position_.assign(static_cast<std::size_t>(n_) * (n_ + m_), -1);
    for (Index k = 0; k < n_; ++k) {
      s.sign.push_back(l_.sign[order_[k]]);
      s.row.push_back(k);
      s.row.insert(s.row.end(), rows[k].begin(), rows[k].end());
      for (auto p = s.column_start[k]; p < static_cast<Index>(s.row.size()); ++p) {
        Position(s.row[p], k) = p;
      }
      s.column_start.push_back(static_cast<Index>(s.row.size()));
    }
    for (const Local::Place& p : l_.place) {
      const Index a = at(p.row), b = at(p.column);
      s.entry_position.push_back(Position(std::max(a, b), std::min(a, b)));
    }
    for (Index k = 0; k < n_; ++k) {
      for (std::size_t b = 0; b < rows[k].size(); ++b) {
        for (std::size_t a = b; a < rows[k].size(); ++a)
          s.target.push_back(Target(rows[k][a], rows[k][b]));
      }
    }
    return s;
  }

 private:
  /// Chooses which columns to eliminate together; where they have not quite the same rows, they get
  /// them, a few zeros.
  [[nodiscard]] std::vector<Index> MakePanels(std::vector<std::vector<Index>>& rows) const {
    std::vector<Index> panel(n_, 1);
    for (Index k = 0; k < n_; k += panel[k]) {
      panel[k] = Joins(rows, k, 4) ? 4 : Joins(rows, k, 2) ? 2 : 1;
      const Index last = k + panel[k] - 1;
      for (Index j = last - 1; j >= k; --j) {
        rows[j] = rows[j + 1];
        rows[j].insert(rows[j].begin(), j + 1);
      }
    }
    return panel;
  }
  // A column's rows below the first are its parent's, too: the last of a chain has all of them.
  static bool Joins(const std::vector<std::vector<Index>>& rows, Index k, Index width) {
    constexpr double kZeros = 0.12;  // a share of the entries
    if (k + width > static_cast<Index>(rows.size())) return false;
    const Index last = k + width - 1;
    std::size_t entries = 0, all = 0;
    for (Index j = k; j < last; ++j) {
      if (rows[j].empty() || rows[j][0] != j + 1) return false;
      entries += rows[j].size();
      all += rows[last].size() + static_cast<std::size_t>(last - j);
    }
    return static_cast<double>(all - entries) <= kZeros * static_cast<double>(all);
  }
  Index& Position(Index row, Index column) {
    return position_[static_cast<std::size_t>(column) * (n_ + m_) + row];
  }
  Index Target(Index a, Index b) {
    if (b < n_) return Position(a, b);
    const Index i = a - n_, j = b - n_;
    return ~(i * (i + 1) / 2 + j);
  }

  const Local& l_;
  const Index n_, m_;
  const std::vector<Index> order_;
  std::vector<Index> position_;
};

}  // namespace

std::vector<BlockClass> ClassifyBlocks(const SymmetricPattern& pattern,
                                       const std::vector<std::int8_t>& sign,
                                       const std::vector<Index>& block, Index count) {
  std::vector<Local> local = Separate(pattern, sign, block, count);
  std::map<const Local*, std::vector<Index>, ByShape> alike;
  for (Index b = 0; b < count; ++b) {
    Sort(local[b]);
    alike[&local[b]].push_back(b);
  }
  std::vector<BlockClass> classes;
  for (const auto& [key, members] : alike) {
    ShapeBuilder builder(local[members[0]]);
    BlockClass& c = classes.emplace_back();
    c.shape = builder.Build();
    c.count = static_cast<Index>(members.size());
    for (const Index b : members) {
      for (const Index j : builder.order()) c.column.push_back(local[b].column[j]);
      c.border.insert(c.border.end(), local[b].border.begin(), local[b].border.end());
      c.entry.insert(c.entry.end(), local[b].entry.begin(), local[b].entry.end());
    }
  }
  return classes;
}

}  // namespace switchyard::linalg
