// Which form is predicted to be cheaper.
#include "ipopt/kkt_choice.hpp"

#include <gtest/gtest.h>

#include "switchyard/problem.hpp"

namespace switchyard::testing {
namespace {

using ipopt::KktShape;

/// `rows` inequalities of `length` variables each: consecutive ones, or every `stride`-th.
Problem WithRows(int variables, int rows, int length, int stride, bool equations = false) {
  ProblemData d;
  d.num_vars = variables;
  d.q.assign(static_cast<std::size_t>(variables), 1.0);
  d.x_lower.assign(d.q.size(), 0.0);
  d.x_upper.assign(d.q.size(), 1.0);
  std::vector<std::vector<std::int32_t>> columns(d.q.size());
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < length; ++k) {
      columns[static_cast<std::size_t>((i + k * stride) % variables)].push_back(i);
    }
    d.row_lower.push_back(equations ? 1 : -1);
    d.row_upper.push_back(1);
  }
  d.A = Csc(rows, 0);
  d.A.cols = variables;
  for (const auto& column : columns) {
    for (const std::int32_t row : column) {
      d.A.row.push_back(row);
      d.A.value.push_back(1);
    }
    d.A.start.push_back(static_cast<std::int32_t>(d.A.row.size()));
  }
  return Problem(std::move(d));
}

KktShape ShapeOf(const Problem& problem) {
  return ipopt::KktShapeOf(problem.view(), ipopt::Shape(problem.view(), true));
}

TEST(KktChoice, CondensesManyShortInequalities) {
  const KktShape shape = ShapeOf(WithRows(300, 2000, 4, 1));
  EXPECT_TRUE(shape.condensed_is_cheaper);
  EXPECT_FALSE(shape.has_dense_column);
  EXPECT_EQ(shape.counts.inequalities, 2000);
  EXPECT_EQ(shape.counts.equations, 0);
}

// J' S J of 1500 variables is dense; the augmented system has a Schur complement of order 3.
TEST(KktChoice, DoesNotCondenseLongInequalities) {
  EXPECT_FALSE(ShapeOf(WithRows(1500, 3, 1500, 1)).condensed_is_cheaper);
}

TEST(KktChoice, KeepsEquations) {
  const KktShape shape = ShapeOf(WithRows(300, 200, 4, 1, true));
  EXPECT_EQ(shape.counts.equations, 200);
  EXPECT_EQ(shape.counts.inequalities, 0);
}

// More equations than variables are loosened.
TEST(KktChoice, CountsLoosenedEquationsAsInequalities) {
  EXPECT_EQ(ShapeOf(WithRows(10, 20, 2, 1, true)).counts.inequalities, 20);
}

TEST(KktChoice, SeesAColumnThatAllRowsShare) {
  Problem problem = WithRows(401, 2000, 3, 1);
  problem.Change([](ProblemData& d) {
    Csc all(2000, 0);
    all.cols = d.A.cols;
    for (std::int32_t j = 0; j < d.A.cols; ++j) {
      const bool is_last = j + 1 == d.A.cols;
      for (std::int32_t i = 0; is_last && i < 2000; ++i) all.row.push_back(i);
      for (std::int32_t k = d.A.start[j]; !is_last && k < d.A.start[j + 1]; ++k) {
        all.row.push_back(d.A.row[k]);
      }
      all.start.push_back(static_cast<std::int32_t>(all.row.size()));
    }
    all.value.assign(all.row.size(), 1.0);
    d.A = all;
  });
  EXPECT_TRUE(ShapeOf(problem).has_dense_column);
}

}  // namespace
}  // namespace switchyard::testing
