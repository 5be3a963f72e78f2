#include "solvers/mip/implied_integers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/shared_headers/random_problem.hpp"

namespace switchyard::testing {
namespace {

using mip::ImpliedInteger;
using mip::ImpliedIntegers;
using mip::VariablesOf;

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Equalities, most of them, over integers and continuous variables; coefficients often whole.
ProblemData RandomEqualities(Random& random) {
  ProblemData d;
  d.num_vars = 3 + random.Below(6);
  const std::int32_t rows = 1 + random.Below(5);
  d.A = Csc(rows, d.num_vars);
  for (std::int32_t j = 0; j < d.num_vars; ++j) {
    d.integer.push_back(random.Chance(0.5));
    const bool fixed = random.Chance(0.1);
    d.x_lower.push_back(fixed ? 2 : -5);
    d.x_upper.push_back(fixed ? 2 : 5);
    for (std::int32_t i = 0; i < rows; ++i) {
      if (random.Chance(0.6)) continue;
      d.A.row.push_back(i);
      d.A.value.push_back(random.Chance(0.05) ? 0 : 0.5 * (random.Below(9) - 4));
    }
    d.A.start[At(j) + 1] = static_cast<std::int32_t>(d.A.row.size());
  }
  for (std::int32_t i = 0; i < rows; ++i) {
    d.row_lower.push_back(0.5 * random.Below(5));
    d.row_upper.push_back(d.row_lower.back() + (random.Chance(0.2) ? 1 : 0));
  }
  d.q.assign(At(d.num_vars), 0.0);
  return d;
}

struct RowTerms {
  Vector coefficient;                 // of every variable
  std::vector<std::int32_t> unknown;  // variables that are not known to be integers
};

RowTerms TermsOf(const ProblemData& d, std::int32_t row, const std::vector<bool>& known) {
  RowTerms terms{Vector(At(d.num_vars), 0.0), {}};
  for (std::int32_t j = 0; j < d.num_vars; ++j) {
    for (auto k = At(d.A.start[At(j)]); k < At(d.A.start[At(j) + 1]); ++k) {
      if (d.A.row[k] == row) terms.coefficient[At(j)] = d.A.value[k];
    }
    if (terms.coefficient[At(j)] != 0 && !known[At(j)]) terms.unknown.push_back(j);
  }
  return terms;
}

/// Is x_j, of the row's equality, an integer at all integers of the others? At 0 and at each unit,
/// which is where an affine function shows it.
bool IsAlwaysInteger(const ProblemData& d, std::int32_t row, const RowTerms& terms,
                     std::int32_t j) {
  const double own = terms.coefficient[At(j)];
  const auto is_integer = [](double v) { return v == std::round(v); };
  bool all = is_integer(d.row_lower[At(row)] / own);
  for (std::int32_t k = 0; k < d.num_vars; ++k) {
    if (k != j) all = all && is_integer((d.row_lower[At(row)] - terms.coefficient[At(k)]) / own);
  }
  return all;
}

std::vector<bool> KnownFromTheStart(const ProblemData& d) {
  std::vector<bool> known;
  for (std::size_t j = 0; j < d.integer.size(); ++j) {
    known.push_back(d.integer[j] != 0 || d.x_lower[j] == d.x_upper[j]);
  }
  return known;
}

TEST(ImpliedIntegers, FollowFromTheirRowsInTheOrderOfTheList) {
  std::size_t found = 0;
  for (unsigned seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const ProblemData d = RandomEqualities(random);
    std::vector<bool> known = KnownFromTheStart(d);
    for (const ImpliedInteger& implied : ImpliedIntegers(Problem(d).view())) {
      const RowTerms terms = TermsOf(d, implied.row, known);
      EXPECT_EQ(terms.unknown, std::vector<std::int32_t>{implied.variable});
      EXPECT_EQ(d.row_lower[At(implied.row)], d.row_upper[At(implied.row)]);
      EXPECT_TRUE(IsAlwaysInteger(d, implied.row, terms, implied.variable));
      known[At(implied.variable)] = true;
      ++found;
    }
  }
  EXPECT_GT(found, 500U);
}

TEST(ImpliedIntegers, AreAllThatASingleRowShows) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const ProblemData d = RandomEqualities(random);
    std::vector<bool> known = KnownFromTheStart(d);
    for (const std::int32_t j : VariablesOf(ImpliedIntegers(Problem(d).view()))) {
      known[At(j)] = true;
    }
    for (std::int32_t i = 0; i < d.num_rows(); ++i) {
      const RowTerms terms = TermsOf(d, i, known);
      if (terms.unknown.size() != 1 || d.row_lower[At(i)] != d.row_upper[At(i)]) continue;
      EXPECT_FALSE(IsAlwaysInteger(d, i, terms, terms.unknown[0])) << "row " << i;
    }
  }
}

TEST(ImpliedIntegers, AreNoneWithoutRows) {
  ProblemData d;
  d.num_vars = 2;
  d.q = {0, 0};
  d.integer = {1, 0};
  EXPECT_TRUE(ImpliedIntegers(Problem(d).view()).empty());
}

}  // namespace
}  // namespace switchyard::testing
