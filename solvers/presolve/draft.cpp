#include "solvers/presolve/draft.hpp"

#include <algorithm>
#include <utility>

namespace switchyard::presolve {
namespace {

constexpr double kCancelled = 1e-13;  // a difference, beside what it is of: nothing but rounding

/// Both triangles of a matrix of which the upper one is given.
Csc Symmetric(const Csc& upper) {
  const Csc lower = Transpose(upper.View());
  Csc both(upper.rows, upper.cols);
  for (Index j = 0; j < upper.cols; ++j) {
    for (Index k = upper.start[j]; k < upper.start[j + 1]; ++k) {
      both.row.push_back(upper.row[k]);
      both.value.push_back(upper.value[k]);
    }
    for (Index k = lower.start[j]; k < lower.start[j + 1]; ++k) {
      if (lower.row[k] == j) continue;
      both.row.push_back(lower.row[k]);
      both.value.push_back(lower.value[k]);
    }
    both.start[j + 1] = static_cast<Index>(both.row.size());
  }
  return both;
}

}  // namespace

Draft::Draft(const ProblemData& d, const Limits& given) : Draft(d, given, SplitCones(d)) {}

Draft::Draft(const ProblemData& d, const Limits& given, ConesSplit cones_of)
    : q(d.q),
      p_shift(d.q.size(), 0.0),
      lower(d.x_lower),
      upper(d.x_upper),
      column_alive(d.q.size(), 1),
      P(Symmetric(d.P)),
      curved(d.q.size(), 0),
      offset(d.offset),
      rows(cones_of.linear.rows > 0 ? StackRows(d.A, cones_of.linear) : d.A, given.values_stay),
      row_lower(d.row_lower),
      row_upper(d.row_upper),
      rows_of_a(d.num_rows()),
      source(std::move(cones_of.source)),
      cone_rows(cones_of.conic, given.values_stay),
      g(std::move(cones_of.g)),
      cones(std::move(cones_of.cones)),
      limits(given) {
  if (lower.empty()) {
    lower.assign(q.size(), -kInfinity);
    upper.assign(q.size(), kInfinity);
  }
  row_lower.insert(row_lower.end(), cones_of.lower.begin(), cones_of.lower.end());
  row_upper.insert(row_upper.end(), cones_of.upper.begin(), cones_of.upper.end());
  row_size.assign(row_lower.size(), 1.0);
  row_alive.assign(row_lower.size(), 1);
  for (Index j = 0; j < P.cols; ++j) curved[j] = P.start[j] < P.start[j + 1] ? 1 : 0;
}

namespace {

/// Calls back with each row of a store that holds column j, and its entry. A row
/// that lost the column and got it again is told of twice.
template <class Take>
void EachHolder(const RowStore& store, Index j, Take&& take) {
  store.EachRowOf(j, [&](Index i) {
    const std::span<const Entry> row = store.Row(i);
    const auto at = std::lower_bound(
        row.begin(), row.end(), j, [](const Entry& e, Index wanted) { return e.column < wanted; });
    if (at != row.end() && at->column == j) take(i, at->value);
  });
}

}  // namespace

std::vector<Entry> Draft::Column(Index j) const {
  std::vector<Entry> column;
  Column(j, column);
  return column;
}

void Draft::Column(Index j, std::vector<Entry>& column) const {
  column.clear();
  const auto collect = [&](const RowStore& store, bool of_cones) {
    const std::size_t begin = column.size();
    EachHolder(store, j, [&](Index i, double value) {
      if (of_cones || row_alive[i] != 0) column.push_back({of_cones ? ~i : i, value});
    });
    const auto first = column.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto by_row = [](const Entry& a, const Entry& b) { return a.column < b.column; };
    const auto same = [](const Entry& a, const Entry& b) { return a.column == b.column; };
    if (of_cones) std::reverse(first, column.end());
    if (!std::is_sorted(first, column.end(), by_row)) std::sort(first, column.end(), by_row);
    column.erase(std::unique(first, column.end(), same), column.end());
  };
  collect(rows, false);
  collect(cone_rows, true);
}

int Draft::FewEntries(Index j, Entry& entry) const {
  int count = 0;
  const auto see = [&](Index row, double value) {
    if (count > 0 && entry.column == row) return;
    entry = {row, value};
    ++count;
  };
  EachHolder(rows, j, [&](Index i, double value) {
    if (count < 2 && row_alive[i] != 0) see(i, value);
  });
  if (count < 2) {
    EachHolder(cone_rows, j, [&](Index i, double value) {
      if (count < 2) see(~i, value);
    });
  }
  return std::min(count, 2);
}

void Draft::Fix(Index j, double value) {
  const std::vector<Entry> column = Column(j);
  undo.Add(FixedColumn{{j, q[j], undo.Keep(column)}, value});
  column_alive[j] = 0;
  offset += (q[j] + p_shift[j]) * value;
  for (Index e = P.start[j]; e < P.start[j + 1]; ++e) {
    const Index other = P.row[e];
    if (other == j) {
      offset += 0.5 * P.value[e] * value * value;
    } else if (column_alive[other] != 0) {
      p_shift[other] += P.value[e] * value;
    }
  }
  for (const Entry& e : column) TakeConstant(e.column, e.value * value);
}

void Draft::ReduceCost(Index j, double by) {
  const double left = q[j] - by;
  q[j] = std::abs(left) > kCancelled * std::abs(by) ? left : 0;
}

void Draft::TakeConstant(Index row, double value) {
  if (row < 0) {
    g[~row] += value;
    return;
  }
  row_lower[row] -= value;
  row_upper[row] -= value;
  row_size[row] = std::max(row_size[row], std::abs(value));
}

void Draft::SubtractFrom(Index row, double factor, std::span<const Entry> what, Index gone) {
  RowStore& store = row >= 0 ? rows : cone_rows;
  const Index i = row >= 0 ? row : ~row;
  const std::span<const Entry> old = store.Row(i);
  std::vector<Entry> sum;
  sum.reserve(old.size() + what.size());
  auto a = old.begin();
  auto b = what.begin();
  const auto add = [&](Index column, double value, double size) {
    if (column == gone || column_alive[column] == 0) return;
    if (std::abs(value) > kCancelled * size) sum.push_back({column, value});
  };
  while (a != old.end() || b != what.end()) {
    if (b == what.end() || (a != old.end() && a->column < b->column)) {
      add(a->column, a->value, 0);
      ++a;
    } else if (a == old.end() || b->column < a->column) {
      add(b->column, -factor * b->value, 0);
      ++b;
    } else {
      add(a->column, a->value - factor * b->value, std::abs(a->value));
      ++a;
      ++b;
    }
  }
  store.Replace(i, std::move(sum));
}

}  // namespace switchyard::presolve
