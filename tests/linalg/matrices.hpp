// tests/linalg/matrices.hpp - random symmetric matrices of every shape.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "solvers/linalg/symmetric_pattern.hpp"
#include "tests/shared_headers/random_problem.hpp"

namespace switchyard::linalg {

using testing::Random;
using Signs = std::vector<std::int8_t>;
using Pair = std::pair<Index, Index>;  // i < j
using Pairs = std::set<Pair>;

/// A symmetric matrix, and the sign of each pivot.
struct Signed {
  SymmetricPattern pattern;
  std::vector<double> value;
  Signs sign;
};

template <class T>
void Shuffle(Random& random, std::vector<T>& v) {
  for (std::size_t k = v.size(); k > 1; --k) {
    std::swap(v[k - 1], v[static_cast<std::size_t>(random.Below(static_cast<Index>(k)))]);
  }
}

inline std::vector<Index> RandomOrder(Random& random, Index n) {
  std::vector<Index> order(n);
  for (Index k = 0; k < n; ++k) order[k] = k;
  Shuffle(random, order);
  return order;
}

/// Pairs and, after them, the diagonal; then columns of entries in no order.
inline SymmetricPattern PatternOf(Random& random, Index n, const Pairs& pairs,
                                  bool diagonal = true) {
  std::vector<std::vector<Index>> rows(n);
  for (const auto& [i, j] : pairs) rows[j].push_back(i);
  SymmetricPattern p;
  p.n = n;
  for (Index j = 0; j < n; ++j) {
    if (diagonal) rows[j].push_back(j);
    Shuffle(random, rows[j]);
    p.row.insert(p.row.end(), rows[j].begin(), rows[j].end());
    p.start.push_back(static_cast<Index>(p.row.size()));
  }
  return p;
}

/// take(i, j, entry) for all entries of the upper triangle.
template <class Take>
void ForEntries(const SymmetricPattern& p, Take&& take) {
  for (Index j = 0; j < p.n; ++j) {
    for (Index e = p.start[j]; e < p.start[j + 1]; ++e) take(p.row[e], j, e);
  }
}

inline Signs RandomSigns(Random& random, Index n) {
  Signs sign(n);
  for (std::int8_t& s : sign) s = random.Chance(0.6) ? 1 : -1;
  return sign;
}

/// [H A'; A -R] with rows and columns mixed: H and R diagonally dominant, no eigenvalue below 1.
inline Signed Quasidefinite(Random& random, const Signs& sign, const Pairs& pairs) {
  const auto n = static_cast<Index>(sign.size());
  Signed k{PatternOf(random, n, pairs), {}, sign};
  k.value.resize(k.pattern.nonzeros());
  std::vector<double> dominance(n, 1.0);
  ForEntries(k.pattern, [&](Index i, Index j, Index e) {
    if (i == j) return;
    k.value[e] = random.Normal();
    if (sign[i] != sign[j]) return;
    dominance[i] += std::abs(k.value[e]);
    dominance[j] += std::abs(k.value[e]);
  });
  ForEntries(k.pattern, [&](Index i, Index j, Index e) {
    if (i == j) k.value[e] = sign[j] * dominance[j];
  });
  return k;
}

inline Eigen::MatrixXd Dense(const SymmetricPattern& p, const std::vector<double>& value) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(p.n, p.n);
  ForEntries(p, [&](Index i, Index j, Index e) { dense(i, j) = dense(j, i) = value[e]; });
  return dense;
}

inline Pairs SparsePairs(Random& random, Index n, double density) {
  Pairs pairs;
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < j; ++i) {
      if (random.Chance(density)) pairs.insert({i, j});
    }
  }
  return pairs;
}
/// One row that meets all others, first, last or between.
inline Pairs ArrowPairs(Index n, Index tip) {
  Pairs pairs;
  for (Index i = 0; i < n; ++i) {
    if (i != tip) pairs.insert(std::minmax(i, tip));
  }
  return pairs;
}
inline Pairs GridPairs(Index width, Index height) {
  Pairs pairs;
  for (Index y = 0; y < height; ++y) {
    for (Index x = 0; x < width; ++x) {
      const Index at = y * width + x;
      if (x + 1 < width) pairs.insert({at, at + 1});
      if (y + 1 < height) pairs.insert({at, at + width});
    }
  }
  return pairs;
}
inline Pairs BandPairs(Index n, Index width) {
  Pairs pairs;
  for (Index j = 0; j < n; ++j) {
    for (Index i = std::max<Index>(0, j - width); i < j; ++i) pairs.insert({i, j});
  }
  return pairs;
}

/// A shape of matrix: as many columns, and where it is not diagonal.
struct Case {
  const char* name;
  Index n;
  Pairs (*pairs)(Random&, Index n);
};

inline std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

inline std::string NameOf(const ::testing::TestParamInfo<Case>& c) { return c.param.name; }

inline const std::vector<Case>& Cases() {
  const auto none = [](Random&, Index) { return Pairs{}; };
  const auto full = [](Random& r, Index n) { return SparsePairs(r, n, 1); };
  static const std::vector<Case> cases = {
      {"nothing", 0, none},
      {"one", 1, none},
      {"two", 2, full},
      {"diagonal", 37, none},
      {"full_of_9", 9, full},
      {"full_of_70", 70, full},
      {"arrow_first", 50, [](Random&, Index n) { return ArrowPairs(n, 0); }},
      {"arrow_between", 51, [](Random&, Index n) { return ArrowPairs(n, n / 2); }},
      {"arrow_last", 52, [](Random&, Index n) { return ArrowPairs(n, n - 1); }},
      {"path", 60, [](Random&, Index n) { return BandPairs(n, 1); }},
      {"band", 120, [](Random&, Index n) { return BandPairs(n, 5); }},
      {"grid", 196, [](Random&, Index) { return GridPairs(14, 14); }},
      {"forest", 150, [](Random& r, Index n) { return SparsePairs(r, n, 0.7 / n); }},
      {"sparse_of_8", 8, [](Random& r, Index n) { return SparsePairs(r, n, 0.3); }},
      {"sparse_of_33", 33, [](Random& r, Index n) { return SparsePairs(r, n, 0.1); }},
      {"sparse_of_100", 100, [](Random& r, Index n) { return SparsePairs(r, n, 0.04); }},
      {"sparse_of_200", 200, [](Random& r, Index n) { return SparsePairs(r, n, 0.015); }},
      {"thick_of_130", 130, [](Random& r, Index n) { return SparsePairs(r, n, 0.2); }},
  };
  return cases;
}

inline Signed RandomOf(const Case& c, Random& random) {
  return Quasidefinite(random, RandomSigns(random, c.n), c.pairs(random, c.n));
}

}  // namespace switchyard::linalg
