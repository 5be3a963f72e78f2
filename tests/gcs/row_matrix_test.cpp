// A matrix written row by row against a dense one.
#include "core/problem/row_matrix.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <random>

namespace switchyard::testing {
namespace {

Eigen::MatrixXd Dense(const Csc& m) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(m.rows, m.cols);
  for (std::int32_t j = 0; j < m.cols; ++j) {
    for (auto k = static_cast<std::size_t>(m.start[static_cast<std::size_t>(j)]);
         k < static_cast<std::size_t>(m.start[static_cast<std::size_t>(j) + 1]); ++k) {
      dense(m.row[k], j) += m.value[k];
    }
  }
  return dense;
}

TEST(RowMatrix, SumsAndDropsAsADenseOneDoes) {
  std::mt19937_64 engine(3);
  const auto draw = [&](int n) { return static_cast<int>(engine() % static_cast<unsigned>(n)); };
  for (int round = 0; round < 200; ++round) {
    const int columns = 1 + draw(12);
    RowMatrix matrix;
    std::vector<Eigen::VectorXd> kept;
    for (int i = draw(15); i > 0; --i) {
      EXPECT_EQ(matrix.Begin(), static_cast<std::int32_t>(kept.size()));
      kept.emplace_back(Eigen::VectorXd::Zero(columns));
      for (int k = draw(2 * columns); k > 0; --k) {
        const int j = draw(columns), value = draw(7) - 3;
        matrix.Add(j, value);
        kept.back()[j] += value;
      }
      Eigen::VectorXd seen = Eigen::VectorXd::Zero(columns);
      std::vector<int> times(static_cast<std::size_t>(columns), 0);
      for (std::size_t k = 0; k < matrix.Columns().size(); ++k) {
        seen[matrix.Columns()[k]] = matrix.Values()[k];
        EXPECT_EQ(++times[static_cast<std::size_t>(matrix.Columns()[k])], 1);
      }
      EXPECT_EQ(seen, kept.back());
      if (draw(3) > 0) continue;
      matrix.Drop();
      kept.pop_back();
    }
    EXPECT_EQ(matrix.rows(), static_cast<std::int32_t>(kept.size()));
    const Csc taken = matrix.Take(columns);
    ASSERT_EQ(taken.rows, static_cast<std::int32_t>(kept.size()));
    ASSERT_EQ(taken.cols, columns);
    EXPECT_EQ(taken.value.size(), taken.row.size());
    const Eigen::MatrixXd dense = Dense(taken);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      EXPECT_EQ(Eigen::VectorXd(dense.row(static_cast<Eigen::Index>(i))), kept[i]);
    }
    for (std::int32_t j = 0; j < columns; ++j) {
      const auto at = static_cast<std::size_t>(j);
      EXPECT_TRUE(std::is_sorted(taken.row.begin() + taken.start[at],
                                 taken.row.begin() + taken.start[at + 1]));
    }
    EXPECT_EQ(matrix.rows(), 0);
  }
}

TEST(RowMatrix, WithoutEntriesHasItsShape) {
  RowMatrix matrix;
  EXPECT_EQ(matrix.Take(4).cols, 4);
  matrix.Begin();
  matrix.Add(2, 0.0);
  const Csc taken = matrix.Take(3);
  EXPECT_EQ(taken.rows, 1);
  EXPECT_EQ(taken.nonzeros(), 0);
}

TEST(RowMatrix, IsWrittenAgainAfterItWasTaken) {
  RowMatrix matrix;
  matrix.Begin();
  matrix.Add(5, 1);
  matrix.Take(6);
  EXPECT_EQ(matrix.Begin(), 0);
  matrix.Add(5, 2);
  EXPECT_EQ(Dense(matrix.Take(6))(0, 5), 2);
}

}  // namespace
}  // namespace switchyard::testing
