// Matrices written entry by entry, and problems collected from them.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "core/problem/builder.hpp"
#include "tests/shared_headers/random_problem.hpp"

namespace switchyard::testing {
namespace {

struct Entry {
  std::int32_t row;
  std::int32_t col;
  double value;
};

std::vector<Entry> RandomEntries(Random& random, std::int32_t rows, std::int32_t cols, int count) {
  std::vector<Entry> entries;
  for (int k = 0; k < count; ++k) {
    entries.push_back({random.Below(rows), random.Below(cols), random.Normal()});
  }
  return entries;
}

void Write(const std::vector<Entry>& entries, TripletMatrix& out) {
  for (const Entry& e : entries) out.Add(e.row, e.col, e.value);
}

Eigen::MatrixXd Dense(const Csc& a) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(a.rows, a.cols);
  for (std::int32_t j = 0; j < a.cols; ++j) {
    for (auto k = a.start[static_cast<std::size_t>(j)];
         k < a.start[static_cast<std::size_t>(j) + 1]; ++k) {
      dense(a.row[static_cast<std::size_t>(k)], j) += a.value[static_cast<std::size_t>(k)];
    }
  }
  return dense;
}

Eigen::MatrixXd Sum(const std::vector<Entry>& entries, std::int32_t rows, std::int32_t cols) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(rows, cols);
  for (const Entry& e : entries) sum(e.row, e.col) += e.value;
  return sum;
}

TEST(TripletMatrix, IsTheSumOfItsEntriesWithRowsAscending) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const auto entries = RandomEntries(random, 7, 5, 40);
    TripletMatrix matrix;
    Write(entries, matrix);
    const Csc& a = matrix.Seal(7, 5);
    EXPECT_LT((Dense(a) - Sum(entries, 7, 5)).cwiseAbs().maxCoeff(), 1e-14);
    for (std::size_t j = 0; j < 5; ++j) {
      for (auto k = static_cast<std::size_t>(a.start[j]) + 1;
           k < static_cast<std::size_t>(a.start[j + 1]); ++k) {
        EXPECT_LT(a.row[k - 1], a.row[k]);
      }
    }
  }
}

TEST(TripletMatrix, TakesOtherNumbersInTheSameOrder) {
  Random random(1);
  auto entries = RandomEntries(random, 7, 5, 40);
  TripletMatrix matrix;
  Write(entries, matrix);
  matrix.Seal(7, 5);
  for (int k = 0; k < 3; ++k) {
    for (Entry& e : entries) e.value = random.Normal();
    matrix.Rewrite();
    Write(entries, matrix);
    EXPECT_TRUE(matrix.same());
    EXPECT_LT((Dense(matrix.Seal(7, 5)) - Sum(entries, 7, 5)).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(TripletMatrix, SeesAnotherPattern) {
  const std::vector<Entry> entries = {{0, 0, 1}, {1, 1, 2}, {2, 0, 3}};
  const auto same = [&](const std::vector<Entry>& second) {
    TripletMatrix matrix;
    Write(entries, matrix);
    matrix.Seal(3, 2);
    matrix.Rewrite();
    Write(second, matrix);
    return matrix.same();
  };
  EXPECT_TRUE(same({{0, 0, 0}, {1, 1, 0}, {2, 0, 0}}));
  EXPECT_FALSE(same({{0, 0, 1}, {1, 1, 2}}));
  EXPECT_FALSE(same({{0, 0, 1}, {1, 1, 2}, {2, 1, 3}}));
  EXPECT_FALSE(same({{0, 0, 1}, {1, 1, 2}, {2, 0, 3}, {2, 1, 4}}));
}

TEST(ProblemBuilder, LeavesOutSectionsInWhichNothingWasSaid) {
  ProblemBuilder builder;
  EXPECT_EQ(builder.AddVariables(2), 0);
  EXPECT_EQ(builder.AddVariables(1), 2);
  const ProblemData d = builder.Finish();
  EXPECT_EQ(d.num_vars, 3);
  EXPECT_TRUE(d.x_lower.empty());
  EXPECT_TRUE(d.integer.empty());
  const Problem problem(d);
  EXPECT_EQ(problem.view().P, nullptr);
  EXPECT_EQ(problem.view().A, nullptr);
  EXPECT_EQ(problem.view().F, nullptr);
}

TEST(ProblemBuilder, SaysWhereWhatItAddedBegins) {
  ProblemBuilder builder;
  builder.AddVariables(2);
  EXPECT_EQ(builder.AddRows(3), 0);
  EXPECT_EQ(builder.AddRows(1), 3);
  EXPECT_EQ(builder.AddCone({SY_CONE_SECOND_ORDER, 3, 0}), 0);
  EXPECT_EQ(builder.AddCone({SY_CONE_ZERO, 1, 0}), 3);
  builder.x_upper[1] = 4;
  builder.integer[0] = 1;
  const ProblemData d = builder.Finish();
  EXPECT_EQ(d.row_lower, Vector(4, -kInfinity));
  EXPECT_EQ(d.x_lower, Vector(2, -kInfinity));
  EXPECT_EQ(d.x_upper, (Vector{kInfinity, 4}));
  EXPECT_EQ(d.integer, (std::vector<std::uint8_t>{1, 0}));
  EXPECT_EQ(d.num_cone_rows(), 4);
}

}  // namespace
}  // namespace switchyard::testing
