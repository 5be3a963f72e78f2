// solvers/linalg/lane_elimination.hpp - the loops of lane_kernels.hpp, whatever a number is.
#pragma once

#include "solvers/linalg/lane_kernels.hpp"

namespace switchyard::linalg::lanes {

SWITCHYARD_INLINE double Accept(double d, std::int8_t sign, double size, const PivotRule& rule,
                                int& raised) {
  return rule.Accept(d, sign, size, raised);
}
SWITCHYARD_INLINE Lanes Accept(const Lanes& d, std::int8_t sign, const Lanes& size,
                               const PivotRule& rule, int& raised) {
  Lanes pivot;
  for (int i = 0; i < kLanes; ++i) pivot[i] = rule.Accept(d[i], sign, size[i], raised);
  return pivot;
}
SWITCHYARD_INLINE Twofold<double> Accept(const Twofold<double>& d, std::int8_t sign, double size,
                                         const PivotRule& rule, int& raised) {
  const double pivot = rule.AcceptTwofold(d.high, sign, size, raised);
  return {pivot, pivot == d.high ? d.low : 0};
}
SWITCHYARD_INLINE Twofold<Lanes> Accept(const Twofold<Lanes>& d, std::int8_t sign,
                                        const Lanes& size, const PivotRule& rule, int& raised) {
  Lanes pivot;
  for (int i = 0; i < kLanes; ++i) {
    pivot[i] = rule.AcceptTwofold(d.high[i], sign, size[i], raised);
  }
  return {pivot, pivot == d.high ? d.low : Lanes{}};
}

/// An elimination of one shape, at hand.
template <class V, class Size>
struct Elimination {
  const BlockShape& s;
  V* l;
  V* inverse_pivot;
  V* triangle;
  Size* size;

  [[nodiscard]] SWITCHYARD_INLINE V& Place(Index target) const {
    return target >= 0 ? l[target] : triangle[~target];
  }
  /// What row b of a column, by its own place in L, takes from that row's pivot counts there.
  SWITCHYARD_INLINE void Count(Index b, const V& factor) const {
    const Index row = s.row[b];
    if (row >= s.columns) return;
    const Size term = High(l[b]) * High(factor);
    size[row] += Max(term, -term);
  }
};

/// Eliminates W columns from k on, each but the last with the next ones and the last's rows as its
/// own: first in each other, then all at once in what they leave. `target`: of column k.
template <int W, class V, class Size>
SWITCHYARD_INLINE const Index* EliminatePanel(const Elimination<V, Size>& e, Index k,
                                              const PivotRule& rule, const Index* target,
                                              int& raised) {
  const BlockShape& s = e.s;
  const Index last = k + W - 1, rows = s.column_start[last + 1] - s.column_start[last] - 1;
  Index begin[W];  // of the rows that all have
  V inverse[W];
  for (int j = 0; j < W; ++j) {
    const Index diagonal = s.column_start[k + j], end = s.column_start[k + j + 1];
    inverse[j] = Reciprocal(Accept(e.l[diagonal], s.sign[k + j], e.size[k + j], rule, raised));
    e.inverse_pivot[k + j] = inverse[j];
    begin[j] = end - rows;
    for (Index b = diagonal + 1; b < begin[j]; ++b) {
      const V factor = e.l[b] * inverse[j];
      e.Count(b, factor);
      for (Index a = b; a < end; ++a) e.Place(*target++) -= e.l[a] * factor;
    }
    if (j < W - 1) target += static_cast<std::ptrdiff_t>(rows) * (rows + 1) / 2;
  }
  for (Index b = 0; b < rows; ++b) {
    V factor[W];
    for (int j = 0; j < W; ++j) {
      factor[j] = e.l[begin[j] + b] * inverse[j];
      e.Count(begin[j] + b, factor[j]);
    }
    for (Index a = b; a < rows; ++a) {
      V& place = e.Place(*target++);
      V left = place;
      for (int j = 0; j < W; ++j) left -= e.l[begin[j] + a] * factor[j];
      place = left;
    }
  }
  for (int j = 0; j < W; ++j) {
    for (Index b = s.column_start[k + j] + 1; b < s.column_start[k + j + 1]; ++b) {
      e.l[b] *= inverse[j];
    }
  }
  return target;
}

template <class V, class Size>
SWITCHYARD_INLINE int Factor(const BlockShape& s, const PivotRule& rule, V* l, V* inverse_pivot,
                             V* triangle, Size* size) {
  int raised = 0;
  const Index* target = s.target.data();
  for (Index k = 0; k < s.columns; ++k) {
    const Size at = High(l[s.column_start[k]]);
    size[k] = Max(at, -at);
  }
  const Elimination<V, Size> e{s, l, inverse_pivot, triangle, size};
  for (Index k = 0; k < s.columns; k += s.panel[k]) {
    if (s.panel[k] == 4) {
      target = EliminatePanel<4>(e, k, rule, target, raised);
    } else if (s.panel[k] == 2) {
      target = EliminatePanel<2>(e, k, rule, target, raised);
    } else {
      target = EliminatePanel<1>(e, k, rule, target, raised);
    }
  }
  return raised;
}

template <class V>
SWITCHYARD_INLINE void Forward(const BlockShape& s, const V* l, V* x) {
  for (Index k = 0; k < s.columns; ++k) {
    const V at = x[k];
    for (Index p = s.column_start[k] + 1; p < s.column_start[k + 1]; ++p) x[s.row[p]] -= l[p] * at;
  }
}

// Four sums, as one would wait for itself.
template <class V>
SWITCHYARD_INLINE void Backward(const BlockShape& s, const V* l, const V* inverse_pivot, V* x) {
  const Index* row = s.row.data();
  for (Index k = s.columns - 1; k >= 0; --k) {
    const Index end = s.column_start[k + 1];
    V sum0 = x[k] * inverse_pivot[k], sum1 = V{}, sum2 = V{}, sum3 = V{};
    Index p = s.column_start[k] + 1;
    for (; p + 4 <= end; p += 4) {
      sum0 -= l[p] * x[row[p]];
      sum1 -= l[p + 1] * x[row[p + 1]];
      sum2 -= l[p + 2] * x[row[p + 2]];
      sum3 -= l[p + 3] * x[row[p + 3]];
    }
    for (; p < end; ++p) sum1 -= l[p] * x[row[p]];
    x[k] = (sum0 + sum1) + (sum2 + sum3);
  }
}

template <class V>
SWITCHYARD_INLINE V* As(double* p) {
  return reinterpret_cast<V*>(p);
}
template <class V>
SWITCHYARD_INLINE const V* As(const double* p) {
  return reinterpret_cast<const V*>(p);
}

}  // namespace switchyard::linalg::lanes
