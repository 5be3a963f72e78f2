// tests/linalg/twofold_matrices.hpp - matrices that twofold digits see and plain ones do not.
#pragma once

#include <numeric>
#include <vector>

#include "tests/linalg/reference.hpp"

namespace switchyard::linalg {

struct TwofoldMatrix {
  SymmetricPattern pattern;
  std::vector<double> high, low;
  Signs sign;
  Index nearly_dependent = 0;  // columns

  [[nodiscard]] Numbers numbers() const { return {high.data(), low.data()}; }
  [[nodiscard]] Quad value(Index e) const { return Quad{high[e]} + low[e]; }
};

inline std::vector<Quad> Product(const TwofoldMatrix& k, const std::vector<Quad>& x) {
  std::vector<Quad> y(x.size(), 0);
  ForEntries(k.pattern, [&](Index i, Index j, Index e) {
    y[i] += k.value(e) * x[j];
    if (i != j) y[j] += k.value(e) * x[i];
  });
  return y;
}

inline double MaxAbs(const std::vector<Quad>& v) {
  Quad largest = 0;
  for (const Quad q : v) largest = std::max(largest, Abs(q));
  return static_cast<double>(largest);
}

/// A vector of twofold numbers, its parts apart.
struct TwofoldVector {
  std::vector<double> high, low;

  TwofoldVector() = default;
  explicit TwofoldVector(const std::vector<Quad>& v) {
    for (const Quad q : v) {
      high.push_back(Split(q).high);
      low.push_back(Split(q).low);
    }
  }
  [[nodiscard]] NumbersOf<double> numbers() { return {high.data(), low.data()}; }
  [[nodiscard]] std::vector<Quad> value() const {
    std::vector<Quad> v;
    for (std::size_t i = 0; i < high.size(); ++i) v.push_back(Quad{high[i]} + low[i]);
    return v;
  }
};

inline std::vector<Quad> RandomQuads(Random& random, Index n) {
  std::vector<Quad> v;
  for (Index i = 0; i < n; ++i) v.push_back(Quad{random.Normal()} + 1e-17 * random.Normal());
  return v;
}

/// k, and digits behind those of a double.
inline TwofoldMatrix WithMoreDigits(Random& random, const Signed& k) {
  TwofoldMatrix m{k.pattern, {}, {}, k.sign, 0};
  for (const double v : k.value) {
    const Twofold<double> t = Split(Quad{v} * (1 + Quad{1e-17} * random.Normal()));
    m.high.push_back(t.high);
    m.low.push_back(t.low);
  }
  return m;
}

/// The columns of sign 1 that hang together through such columns, most of all: their numbers, and
/// of each piece the first.
inline std::vector<Index> PiecesOf(const Signs& sign, const Pairs& pairs) {
  std::vector<Index> piece(sign.size());
  std::iota(piece.begin(), piece.end(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [i, j] : pairs) {
      if (sign[i] < 0 || sign[j] < 0 || piece[i] == piece[j]) continue;
      piece[i] = piece[j] = std::min(piece[i], piece[j]);
      changed = true;
    }
  }
  return piece;
}

/// [L + eps I, A'; A, -R] where L is the Laplacian of a weighted graph, but for 1 in one diagonal
/// entry of each piece other than the largest, and A has row sums of 0 over the largest: so that
/// constants on that piece, `nearly_dependent` columns, have the eigenvalue eps, and all else is
/// well conditioned.
inline TwofoldMatrix NearSingular(Random& random, const Signs& sign, const Pairs& pairs, Quad eps) {
  const auto n = static_cast<Index>(sign.size());
  const std::vector<Index> piece = PiecesOf(sign, pairs);
  std::vector<Index> size(n, 0);
  for (Index i = 0; i < n; ++i) size[piece[i]] += sign[i] > 0 ? 1 : 0;
  const auto largest =
      static_cast<Index>(std::max_element(size.begin(), size.end()) - size.begin());
  const auto of_largest = [&](Index i) { return sign[i] > 0 && piece[i] == largest; };
  std::vector<Quad> diagonal(n, eps);
  std::vector<Index> row_sum(n, 0), open(n, 0);  // of A; entries still to come
  for (Index i = 0; i < n; ++i) {
    if (sign[i] < 0 || (piece[i] == i && i != largest)) diagonal[i] = 1;
  }
  for (const auto& [i, j] : pairs) {
    if (sign[i] > sign[j] && of_largest(i)) ++open[j];
    if (sign[j] > sign[i] && of_largest(j)) ++open[i];
  }
  std::map<Pair, double> beside;
  for (const Pair& at : pairs) {
    const auto [i, j] = at;
    double& v = beside[at];
    if (sign[i] == sign[j]) {
      v = sign[i] > 0 ? -random.Uniform(0.5, 1.5) : random.Normal();
      for (const Index k : {i, j}) diagonal[k] += std::abs(v);
      continue;
    }
    const Index row = sign[i] < 0 ? i : j;
    v = random.Below(9) - 4;
    if (!of_largest(i + j - row)) continue;
    if (--open[row] == 0) v = -row_sum[row];
    row_sum[row] += static_cast<Index>(v);
  }
  TwofoldMatrix k{PatternOf(random, n, pairs), {}, {}, sign, n > 0 ? size[largest] : 0};
  ForEntries(k.pattern, [&](Index i, Index j, Index) {
    const Twofold<double> v =
        i == j ? Split(sign[j] * diagonal[j]) : Twofold<double>{beside[{i, j}], 0};
    k.high.push_back(v.high);
    k.low.push_back(v.low);
  });
  return k;
}

}  // namespace switchyard::linalg
