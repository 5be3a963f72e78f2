#include "solvers/linalg/dense_kernels.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/linalg/simd.hpp"

namespace switchyard::linalg {
namespace {

// Columns that are updated together: with 16 rows they fill the registers of AVX-512.
constexpr int kColumns = 6;

/// c -= a b for 8 R rows and C columns; b holds, for each of `depth` columns of a, C factors at a
/// distance of kColumns.
template <int R, int C>
SWITCHYARD_INLINE void SubtractTile(const double* a, Index a_stride, const double* b, Index depth,
                                    double* c, Index c_stride) {
  Lanes sum[R][C];
  for (int j = 0; j < C; ++j) {
    for (int i = 0; i < R; ++i) sum[i][j] = LanesAt(c + j * c_stride + i * kLanes);
  }
  for (Index p = 0; p < depth; ++p) {
    Lanes rows[R];
    for (int i = 0; i < R; ++i) rows[i] = LanesAt(a + i * kLanes);
    for (int j = 0; j < C; ++j) {
      const double factor = b[j];
      for (int i = 0; i < R; ++i) sum[i][j] -= rows[i] * factor;
    }
    a += a_stride;
    b += kColumns;
  }
  for (int j = 0; j < C; ++j) {
    for (int i = 0; i < R; ++i) LanesAt(c + j * c_stride + i * kLanes) = sum[i][j];
  }
}

template <int C>
SWITCHYARD_INLINE void SubtractColumns(const double* a, Index a_stride, Index rows, const double* b,
                                       Index depth, double* c, Index c_stride) {
  Index i = 0;
  for (; i + 2 * kLanes <= rows; i += 2 * kLanes) {
    SubtractTile<2, C>(a + i, a_stride, b, depth, c + i, c_stride);
  }
  if (i < rows) SubtractTile<1, C>(a + i, a_stride, b, depth, c + i, c_stride);
}

/// c -= a b for `rows` rows, a multiple of kLanes, and up to kColumns columns.
SWITCHYARD_INLINE void Subtract(const double* a, Index a_stride, Index rows, const double* b,
                                Index depth, double* c, Index c_stride, Index columns) {
  switch (columns) {
    case 1:
      return SubtractColumns<1>(a, a_stride, rows, b, depth, c, c_stride);
    case 2:
      return SubtractColumns<2>(a, a_stride, rows, b, depth, c, c_stride);
    case 3:
      return SubtractColumns<3>(a, a_stride, rows, b, depth, c, c_stride);
    case 4:
      return SubtractColumns<4>(a, a_stride, rows, b, depth, c, c_stride);
    case 5:
      return SubtractColumns<5>(a, a_stride, rows, b, depth, c, c_stride);
    default:
      return SubtractColumns<kColumns>(a, a_stride, rows, b, depth, c, c_stride);
  }
}

/// b[p][j] = l(row + j, p) pivot[p]: the factors of `columns` columns.
SWITCHYARD_INLINE void Pack(const double* l, Index stride, Index row, Index columns, Index depth,
                            const double* pivot, double* b) {
  for (Index p = 0; p < depth; ++p) {
    for (Index j = 0; j < columns; ++j) b[p * kColumns + j] = l[p * stride + row + j] * pivot[p];
  }
}

/// v -= factor u for `rows` rows, a multiple of kLanes.
SWITCHYARD_INLINE void SubtractMultiple(const double* u, double factor, Index rows, double* v) {
  for (Index i = 0; i < rows; i += kLanes) LanesAt(v + i) -= LanesAt(u + i) * factor;
}

SWITCHYARD_INLINE void Scale(double factor, Index rows, double* v) {
  for (Index i = 0; i < rows; i += kLanes) LanesAt(v + i) *= factor;
}

/// Columns [from, from + columns) by themselves, after all before them were subtracted.
SWITCHYARD_INLINE int FactorColumns(const Front& f, Index from, Index columns,
                                    const FrontPivots& pivots, const PivotRule& rule) {
  int raised = 0;
  const Index aligned = from / kLanes * kLanes;
  const Index top_rows = f.top_stride - aligned;
  for (Index j = from; j < from + columns; ++j) {
    double* top = f.top + j * f.top_stride;
    double* below = f.below + j * f.below_stride;
    const double pivot = rule.Accept(top[j], pivots.sign[j], pivots.size[j], raised);
    const double inverse = 1 / pivot;
    pivots.inverse[j] = inverse;
    pivots.pivot[j] = inverse != 0 ? pivot : 0;  // infinite: its column of L is 0
    double factor[kColumns];
    for (Index q = j + 1; q < from + columns; ++q) factor[q - from] = top[q] * inverse;
    for (Index q = j + 1; q < f.pivots; ++q) {
      pivots.size[q] += std::abs(top[q] * top[q] * inverse);
    }
    for (Index q = j + 1; q < from + columns; ++q) {
      SubtractMultiple(top + aligned, factor[q - from], top_rows,
                       f.top + q * f.top_stride + aligned);
      SubtractMultiple(below, factor[q - from], f.below_stride, f.below + q * f.below_stride);
    }
    Scale(inverse, top_rows, top + aligned);
    Scale(inverse, f.below_stride, below);
  }
  return raised;
}

// Left-looking by groups of columns: first what the columns before take away, then the group
// itself.
SWITCHYARD_EACH_ISA int FactorPlain(const Front& f, const FrontPivots& pivots,
                                    const PivotRule& rule, double* work) {
  int raised = 0;
  for (Index from = 0; from < f.pivots; from += kColumns) {
    const Index columns = std::min<Index>(kColumns, f.pivots - from);
    if (from > 0) {
      Pack(f.top, f.top_stride, from, columns, from, pivots.pivot, work);
      const Index aligned = from / kLanes * kLanes;
      Subtract(f.top + aligned, f.top_stride, f.top_stride - aligned, work, from,
               f.top + from * f.top_stride + aligned, f.top_stride, columns);
      Subtract(f.below, f.below_stride, f.below_stride, work, from, f.below + from * f.below_stride,
               f.below_stride, columns);
    }
    raised += FactorColumns(f, from, columns, pivots, rule);
  }
  return raised;
}

SWITCHYARD_EACH_ISA void PlainSizesBelow(const Front& f, const double* pivot, double* y) {
  for (Index i = 0; i < f.below_stride; i += kLanes) {
    Lanes sum = Lanes{};
    for (Index p = 0; p < f.pivots; ++p) {
      const Lanes l = LanesAt(f.below + p * f.below_stride + i);
      sum += l * l * std::abs(pivot[p]);
    }
    LanesAt(y + i) = sum;
  }
}

SWITCHYARD_EACH_ISA void SubtractPlainSquare(const Front& f, const double* pivot, double* update,
                                             double* work) {
  for (Index from = 0; from < f.rows; from += kColumns) {
    const Index columns = std::min<Index>(kColumns, f.rows - from);
    Pack(f.below, f.below_stride, from, columns, f.pivots, pivot, work);
    const Index aligned = from / kLanes * kLanes;
    Subtract(f.below + aligned, f.below_stride, f.below_stride - aligned, work, f.pivots,
             update + from * f.below_stride + aligned, f.below_stride, columns);
  }
}

// Four columns at a time: y is read and written once for them.
SWITCHYARD_EACH_ISA void ForwardPlain(const Front& f, double* x, double* y) {
  for (Index i = 0; i < f.below_stride; i += kLanes) LanesAt(y + i) = Lanes{};
  for (Index j = 0; j < f.pivots; ++j) {
    const double* top = f.top + j * f.top_stride;
    const double xj = x[j];
    for (Index i = j + 1; i < f.pivots; ++i) x[i] -= top[i] * xj;
  }
  Index j = 0;
  for (; j + 4 <= f.pivots; j += 4) {
    const double* below = f.below + j * f.below_stride;
    for (Index i = 0; i < f.below_stride; i += kLanes) {
      LanesAt(y + i) +=
          (LanesAt(below + i) * x[j] + LanesAt(below + f.below_stride + i) * x[j + 1]) +
          (LanesAt(below + 2 * f.below_stride + i) * x[j + 2] +
           LanesAt(below + 3 * f.below_stride + i) * x[j + 3]);
    }
  }
  for (; j < f.pivots; ++j)
    SubtractMultiple(f.below + j * f.below_stride, -x[j], f.below_stride, y);
}

/// sum of a[i] b[i]: two sums of eight, as one would wait for itself. b may stand anywhere.
SWITCHYARD_INLINE double Product(const double* a, const double* b, Index count) {
  const auto at = [](const double* p) { return *reinterpret_cast<const LooseLanes*>(p); };
  Lanes even = Lanes{}, odd = Lanes{};
  Index i = 0;
  for (; i + 2 * kLanes <= count; i += 2 * kLanes) {
    even += at(a + i) * at(b + i);
    odd += at(a + i + kLanes) * at(b + i + kLanes);
  }
  for (; i + kLanes <= count; i += kLanes) even += at(a + i) * at(b + i);
  even += odd;
  double sum = 0, rest = 0;
  for (; i < count; ++i) rest += a[i] * b[i];
  for (int l = 0; l < kLanes; ++l) sum += even[l];
  return sum + rest;
}

SWITCHYARD_EACH_ISA void BackwardPlain(const Front& f, const double* inverse_pivot, double* x,
                                       const double* y) {
  for (Index j = f.pivots - 1; j >= 0; --j) {
    const double below = Product(f.below + j * f.below_stride, y, f.below_stride);
    const double top = Product(f.top + j * f.top_stride + j + 1, x + j + 1, f.pivots - j - 1);
    x[j] = x[j] * inverse_pivot[j] - below - top;
  }
}

}  // namespace

int FactorFront(const Front& front, const FrontPivots& pivots, const PivotRule& rule,
                double* work) {
  return front.digits == Digits::kPlain ? FactorPlain(front, pivots, rule, work)
                                        : FactorTwofoldFront(front, pivots, rule, work);
}
void SizesBelow(const Front& front, const double* pivot, double* y) {
  front.digits == Digits::kPlain ? PlainSizesBelow(front, pivot, y)
                                 : TwofoldSizesBelow(front, pivot, y);
}
void SubtractSquare(const Front& front, const double* pivot, double* update, double* work) {
  front.digits == Digits::kPlain ? SubtractPlainSquare(front, pivot, update, work)
                                 : SubtractTwofoldSquare(front, pivot, update, work);
}
void AddColumn(Digits digits, const double* from, RowRange rows, const Index* place, Index shift,
               double* to) {
  if (digits == Digits::kTwofold) return AddTwofoldColumn(from, rows, place, shift, to);
  for (Index i = rows.first; i < rows.end; ++i) to[place[i] - shift] += from[i];
}
void SubtractRows(const double* y, Index rows, const Index* row, const NumbersOf<double>& b) {
  if (b.low != nullptr) return SubtractTwofoldRows(y, rows, row, b);
  for (Index i = 0; i < rows; ++i) b.high[row[i]] -= y[i];
}
void AddToRows(const NumbersOf<double>& v, Index first, const std::vector<Index>& row) {
  if (v.digits() == Digits::kTwofold) return AddToTwofoldRows(v, first, row);
  for (const Index r : row) v.high[r] += v.high[first++];
}

void TakeRows(const NumbersOf<double>& b, Index rows, const Index* row, double* y) {
  if (b.low != nullptr) return TakeTwofoldRows(b, rows, row, y);
  for (Index i = 0; i < rows; ++i) y[i] = b.high[row[i]];
  std::fill(y + rows, y + RoundUp(rows), 0.0);
}
void ForwardFront(const Front& front, double* x, double* y) {
  front.digits == Digits::kPlain ? ForwardPlain(front, x, y) : ForwardTwofoldFront(front, x, y);
}
void BackwardFront(const Front& front, const double* inverse_pivot, double* x, const double* y) {
  front.digits == Digits::kPlain ? BackwardPlain(front, inverse_pivot, x, y)
                                 : BackwardTwofoldFront(front, inverse_pivot, x, y);
}

}  // namespace switchyard::linalg
