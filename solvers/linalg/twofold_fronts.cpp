// The inner loops of a front with numbers of twice the digits: see dense_kernels.hpp.
#include <algorithm>
#include <cmath>

#include "solvers/linalg/dense_kernels.hpp"

namespace switchyard::linalg {
namespace {

using One = Twofold<double>;
using Eight = Twofold<Lanes>;

constexpr int kColumns = 4;  // that are updated together

SWITCHYARD_INLINE Eight* Rows(double* column) { return reinterpret_cast<Eight*>(column); }
SWITCHYARD_INLINE const Eight* Rows(const double* column) {
  return reinterpret_cast<const Eight*>(column);
}
SWITCHYARD_INLINE Eight Spread(const One& v) { return {Lanes{} + v.high, Lanes{} + v.low}; }

/// A number of a column.
SWITCHYARD_INLINE double* Place(double* column, Index row) {
  return column + row / kLanes * 2 * kLanes + row % kLanes;
}
SWITCHYARD_INLINE One Get(const double* column, Index row) {
  const double* at = column + row / kLanes * 2 * kLanes + row % kLanes;
  return {at[0], at[kLanes]};
}
SWITCHYARD_INLINE void Set(double* column, Index row, const One& v) {
  double* at = Place(column, row);
  at[0] = v.high;
  at[kLanes] = v.low;
}

/// c_j -= sum over p of a_p b_pj for eight rows and C columns; the low parts are added up as they
/// come, and brought back into order in the end.
template <int C>
SWITCHYARD_INLINE void SubtractTile(const Eight* a, Index a_stride, const One* b, Index depth,
                                    Eight* c, Index c_stride) {
  Lanes high[C], low[C];
  for (int j = 0; j < C; ++j) {
    high[j] = c[j * c_stride].high;
    low[j] = c[j * c_stride].low;
  }
  for (Index p = 0; p < depth; ++p) {
    const Lanes a_high = a->high, a_low = a->low;
    for (int j = 0; j < C; ++j) {
      const Lanes b_high = Lanes{} + b[j].high;
      const Eight product = Eight::Product(a_high, b_high);
      const Lanes rest = Fma(a_high, Lanes{} + b[j].low, Fma(a_low, b_high, product.low));
      const Eight sum = Eight::Sum(high[j], -product.high);
      high[j] = sum.high;
      low[j] += sum.low - rest;
    }
    a += a_stride;
    b += kColumns;
  }
  for (int j = 0; j < C; ++j) c[j * c_stride] = Eight::Sum(high[j], low[j]);
}

/// c -= a b for `groups` of eight rows and up to kColumns columns; strides in groups.
SWITCHYARD_INLINE void Subtract(const Eight* a, Index a_stride, Index groups, const One* b,
                                Index depth, Eight* c, Index c_stride, Index columns) {
  for (Index g = 0; g < groups; ++g) {
    switch (columns) {
      case 1:
        SubtractTile<1>(a + g, a_stride, b, depth, c + g, c_stride);
        break;
      case 2:
        SubtractTile<2>(a + g, a_stride, b, depth, c + g, c_stride);
        break;
      case 3:
        SubtractTile<3>(a + g, a_stride, b, depth, c + g, c_stride);
        break;
      default:
        SubtractTile<kColumns>(a + g, a_stride, b, depth, c + g, c_stride);
    }
  }
}

/// b[p][j] = l(row + j, p) pivot[p].
SWITCHYARD_INLINE void Pack(const double* l, Index stride, Index row, Index columns, Index depth,
                            const One* pivot, One* b) {
  for (Index p = 0; p < depth; ++p) {
    const double* column = l + std::ptrdiff_t{2} * p * stride;
    for (Index j = 0; j < columns; ++j) b[p * kColumns + j] = Get(column, row + j) * pivot[p];
  }
}

SWITCHYARD_INLINE void SubtractMultiple(const Eight* u, const One& factor, Index groups, Eight* v) {
  const Eight spread = Spread(factor);
  for (Index g = 0; g < groups; ++g) v[g] -= u[g] * spread;
}

SWITCHYARD_INLINE int FactorColumns(const Front& f, Index from, Index columns,
                                    const FrontPivots& pivots, const PivotRule& rule) {
  int raised = 0;
  const Index first = from / kLanes, top_groups = f.top_stride / kLanes;
  const Index below_groups = f.below_stride / kLanes;
  const auto top_of = [&](Index j) { return f.top + std::ptrdiff_t{2} * j * f.top_stride; };
  const auto below_of = [&](Index j) {
    return Rows(f.below + std::ptrdiff_t{2} * j * f.below_stride);
  };
  One* pivot = reinterpret_cast<One*>(pivots.pivot);
  One* inverse = reinterpret_cast<One*>(pivots.inverse);
  for (Index j = from; j < from + columns; ++j) {
    double* top = top_of(j);
    const One found = Get(top, j);
    const double accepted = rule.AcceptTwofold(found.high, pivots.sign[j], pivots.size[j], raised);
    pivot[j] = {accepted, accepted == found.high ? found.low : 0};
    inverse[j] = Reciprocal(pivot[j]);
    if (inverse[j].high == 0) pivot[j] = {0, 0};  // infinite: its column of L is 0
    for (Index q = j + 1; q < f.pivots; ++q) {
      const double entry = Get(top, q).high;
      pivots.size[q] += std::abs(entry * entry * inverse[j].high);
    }
    for (Index q = j + 1; q < from + columns; ++q) {
      const One factor = Get(top, q) * inverse[j];
      SubtractMultiple(Rows(top) + first, factor, top_groups - first, Rows(top_of(q)) + first);
      SubtractMultiple(below_of(j), factor, below_groups, below_of(q));
    }
    const Eight scale = Spread(inverse[j]);
    for (Index g = first; g < top_groups; ++g) Rows(top)[g] *= scale;
    for (Index g = 0; g < below_groups; ++g) below_of(j)[g] *= scale;
  }
  return raised;
}

/// 0 on and above the diagonal, so that whole groups of rows may be taken.
void ClearUpper(const Front& f) {
  for (Index j = 0; j < f.pivots; ++j) {
    double* top = f.top + std::ptrdiff_t{2} * j * f.top_stride;
    for (Index i = 0; i <= j; ++i) Set(top, i, {0, 0});
  }
}

}  // namespace

SWITCHYARD_EACH_ISA int FactorTwofoldFront(const Front& f, const FrontPivots& pivots,
                                           const PivotRule& rule, double* work) {
  int raised = 0;
  One* packed = reinterpret_cast<One*>(work);
  const One* pivot = reinterpret_cast<const One*>(pivots.pivot);
  const Index top_groups = f.top_stride / kLanes, below_groups = f.below_stride / kLanes;
  for (Index from = 0; from < f.pivots; from += kColumns) {
    const Index columns = std::min<Index>(kColumns, f.pivots - from);
    if (from > 0) {
      Pack(f.top, f.top_stride, from, columns, from, pivot, packed);
      const Index first = from / kLanes;
      Subtract(Rows(f.top) + first, top_groups, top_groups - first, packed, from,
               Rows(f.top) + std::ptrdiff_t{from} * top_groups + first, top_groups, columns);
      Subtract(Rows(f.below), below_groups, below_groups, packed, from,
               Rows(f.below) + std::ptrdiff_t{from} * below_groups, below_groups, columns);
    }
    raised += FactorColumns(f, from, columns, pivots, rule);
  }
  ClearUpper(f);
  return raised;
}

SWITCHYARD_EACH_ISA void TwofoldSizesBelow(const Front& f, const double* pivot, double* y) {
  const Index groups = f.below_stride / kLanes;
  for (Index g = 0; g < groups; ++g) {
    Lanes sum = Lanes{};
    for (Index p = 0; p < f.pivots; ++p) {
      const Lanes l = Rows(f.below)[std::ptrdiff_t{p} * groups + g].high;
      sum += l * l * std::abs(pivot[2 * p]);
    }
    LanesAt(y + g * kLanes) = sum;
  }
}

SWITCHYARD_EACH_ISA void SubtractTwofoldSquare(const Front& f, const double* pivot, double* update,
                                               double* work) {
  One* packed = reinterpret_cast<One*>(work);
  const Index groups = f.below_stride / kLanes;
  for (Index from = 0; from < f.rows; from += kColumns) {
    const Index columns = std::min<Index>(kColumns, f.rows - from);
    Pack(f.below, f.below_stride, from, columns, f.pivots, reinterpret_cast<const One*>(pivot),
         packed);
    const Index first = from / kLanes;
    Subtract(Rows(f.below) + first, groups, groups - first, packed, f.pivots,
             Rows(update) + std::ptrdiff_t{from} * groups + first, groups, columns);
  }
}

void AddTwofoldColumn(const double* from, RowRange rows, const Index* place, Index shift,
                      double* to) {
  for (Index i = rows.first; i < rows.end; ++i) {
    const Index row = place[i] - shift;
    Set(to, row, Get(to, row) + Get(from, i));
  }
}

void SubtractTwofoldRows(const double* y, Index rows, const Index* row,
                         const NumbersOf<double>& b) {
  for (Index i = 0; i < rows; ++i) {
    const One left = One{b.high[row[i]], b.low[row[i]]} - Get(y, i);
    b.high[row[i]] = left.high;
    b.low[row[i]] = left.low;
  }
}

void AddToTwofoldRows(const NumbersOf<double>& v, Index first, const std::vector<Index>& row) {
  for (const Index r : row) {
    const One sum = One{v.high[r], v.low[r]} + One{v.high[first], v.low[first]};
    v.high[r] = sum.high;
    v.low[r] = sum.low;
    ++first;
  }
}

void TakeTwofoldRows(const NumbersOf<double>& b, Index rows, const Index* row, double* y) {
  std::fill_n(y, 2 * RoundUp(rows), 0.0);
  for (Index i = 0; i < rows; ++i) Set(y, i, {b.high[row[i]], b.low[row[i]]});
}

SWITCHYARD_EACH_ISA void ForwardTwofoldFront(const Front& f, double* x, double* y) {
  const Index top_groups = f.top_stride / kLanes, below_groups = f.below_stride / kLanes;
  for (Index g = 0; g < below_groups; ++g) Rows(y)[g] = {Lanes{}, Lanes{}};
  for (Index j = 0; j < f.pivots; ++j) {
    const One at = Get(x, j);
    const Index first = j / kLanes;
    SubtractMultiple(Rows(f.top) + std::ptrdiff_t{j} * top_groups + first, at, top_groups - first,
                     Rows(x) + first);
    SubtractMultiple(Rows(f.below) + std::ptrdiff_t{j} * below_groups, -at, below_groups, Rows(y));
  }
}

SWITCHYARD_EACH_ISA void BackwardTwofoldFront(const Front& f, const double* inverse_pivot,
                                              double* x, const double* y) {
  const Index top_groups = f.top_stride / kLanes, below_groups = f.below_stride / kLanes;
  const One* inverse = reinterpret_cast<const One*>(inverse_pivot);
  for (Index j = f.pivots - 1; j >= 0; --j) {
    const Eight* below = Rows(f.below) + std::ptrdiff_t{j} * below_groups;
    const Eight* top = Rows(f.top) + std::ptrdiff_t{j} * top_groups;
    Eight sums = {Lanes{}, Lanes{}}, others = sums;  // two, as one would wait for itself
    Index g = 0;
    for (; g + 2 <= below_groups; g += 2) {
      sums += below[g] * Rows(y)[g];
      others += below[g + 1] * Rows(y)[g + 1];
    }
    for (; g < below_groups; ++g) sums += below[g] * Rows(y)[g];
    for (g = j / kLanes; g < top_groups; ++g) others += top[g] * Rows(x)[g];
    sums += others;
    One sum = Get(x, j) * inverse[j];
    for (int i = 0; i < kLanes; ++i) sum -= One{sums.high[i], sums.low[i]};
    Set(x, j, sum);
  }
}

}  // namespace switchyard::linalg
