// tests/linalg/reference.hpp - dense LDL', in numbers of any kind, without a thought of speed.
#pragma once

#include <cmath>
#include <vector>

#include "solvers/linalg/pivots.hpp"
#include "solvers/linalg/symmetric_pattern.hpp"
#include "solvers/linalg/twofold.hpp"
#include "tests/linalg/matrices.hpp"

namespace switchyard::linalg {

/// 113 bits.
__extension__ using Quad = __float128;

inline Quad Abs(Quad q) { return q < 0 ? -q : q; }
inline Quad Value(const Twofold<double>& v) { return Quad{v.high} + v.low; }
inline Twofold<double> Split(Quad q) {
  const auto high = static_cast<double>(q);
  return {high, static_cast<double>(q - high)};
}

/// Square, by rows.
template <class N>
struct Square {
  Index n = 0;
  std::vector<N> value;

  explicit Square(Index size)
      : n(size), value(static_cast<std::size_t>(size) * static_cast<std::size_t>(size)) {}
  N& operator()(Index i, Index j) { return value[static_cast<std::size_t>(i) * n + j]; }
  const N& operator()(Index i, Index j) const { return value[static_cast<std::size_t>(i) * n + j]; }
};

/// Row and column k are those of order[k].
template <class N>
Square<N> Ordered(const Square<N>& given, const std::vector<Index>& order) {
  Square<N> a(given.n);
  for (Index i = 0; i < a.n; ++i) {
    for (Index j = 0; j < a.n; ++j) a(i, j) = given(order[i], order[j]);
  }
  return a;
}

template <class N>
struct DenseLdl {
  Square<N> l;  // below the diagonal
  std::vector<N> pivot;
  int raised = 0;

  DenseLdl(Square<N> a, const Signs& sign, const PivotRule& rule) : l(std::move(a)) {
    for (Index k = 0; k < l.n; ++k) {
      double size = std::abs(static_cast<double>(l(k, k)));
      N d = l(k, k);
      for (Index p = 0; p < k; ++p) {
        const N term = l(k, p) * l(k, p) * pivot[p];
        d -= term;
        size += std::abs(static_cast<double>(term));
      }
      const auto rounded = static_cast<double>(d);
      const double accepted = rule.Accept(rounded, sign[k], size, raised);
      pivot.push_back(accepted == rounded ? d : N{accepted});
      for (Index i = k + 1; i < l.n; ++i) {
        N sum = l(i, k);
        for (Index p = 0; p < k; ++p) sum -= l(i, p) * pivot[p] * l(k, p);
        l(i, k) = sum / pivot[k];
      }
    }
  }

  [[nodiscard]] std::vector<N> Solve(std::vector<N> b) const {
    for (Index j = 0; j < l.n; ++j) {
      for (Index i = j + 1; i < l.n; ++i) b[i] -= l(i, j) * b[j];
    }
    for (Index j = l.n - 1; j >= 0; --j) {
      b[j] /= pivot[j];
      for (Index i = j + 1; i < l.n; ++i) b[j] -= l(i, j) * b[i];
    }
    return b;
  }
};

template <class N>
Square<N> SquareOf(const Signed& k) {
  Square<N> a(k.pattern.n);
  ForEntries(k.pattern, [&](Index i, Index j, Index e) { a(i, j) = a(j, i) = k.value[e]; });
  return a;
}

/// Which entries an elimination in the given order fills: each column takes the rows of the ones
/// before that hold an entry in it.
inline Square<char> Filled(const SymmetricPattern& p, const std::vector<Index>& order) {
  Square<char> given(p.n);
  ForEntries(p, [&](Index i, Index j, Index) { given(i, j) = given(j, i) = 1; });
  Square<char> l = Ordered(given, order);
  for (Index k = 0; k < p.n; ++k) {
    for (Index i = k + 1; i < p.n; ++i) {
      for (Index j = k + 1; j < p.n; ++j) {
        if (l(i, k) != 0 && l(j, k) != 0) l(i, j) = 1;
      }
    }
  }
  return l;
}

}  // namespace switchyard::linalg
