#include "switchyard/problem.hpp"

#include <gtest/gtest.h>

#include "tests/shared_headers/random_problem.hpp"

namespace switchyard::testing {
namespace {

Eigen::MatrixXd Dense(const Csc& a) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(a.rows, a.cols);
  for (std::int32_t j = 0; j < a.cols; ++j) {
    for (auto k = static_cast<std::size_t>(a.start[static_cast<std::size_t>(j)]);
         k < static_cast<std::size_t>(a.start[static_cast<std::size_t>(j) + 1]); ++k) {
      dense(a.row[k], j) = a.value[k];
    }
  }
  return dense;
}

Csc UpperTriangle(Csc a) {
  for (std::int32_t j = 0; j < a.cols; ++j) {
    for (auto k = static_cast<std::size_t>(a.start[static_cast<std::size_t>(j)]);
         k < static_cast<std::size_t>(a.start[static_cast<std::size_t>(j) + 1]); ++k) {
      if (a.row[k] > j) a.value[k] = 0;
    }
  }
  return a;
}

Eigen::Map<const Eigen::VectorXd> AsVector(const Vector& v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

TEST(Csc, IsTransposedLikeADenseMatrix) {
  Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Csc a = random.Sparse(random.Below(7), random.Below(7), 0.4);
    const Csc t = Transpose(a.View().value != nullptr ? a.View() : Csc(a.rows, a.cols).View());
    EXPECT_EQ(Dense(t), Dense(a).transpose());
    for (std::size_t j = 0; j < static_cast<std::size_t>(t.cols); ++j) {
      EXPECT_TRUE(std::is_sorted(t.row.begin() + t.start[j], t.row.begin() + t.start[j + 1]));
    }
    const Csc back = Transpose(t.View());
    EXPECT_EQ(back.row, a.row);
    EXPECT_EQ(back.value, a.value);
    EXPECT_EQ(back.start, a.start);
  }
}

TEST(Csc, MultipliesLikeADenseMatrix) {
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Csc a = random.Sparse(5, 4, 0.5);
    const Csc p = UpperTriangle(random.Sparse(4, 4, 0.6));
    const Vector x = random.Normals(4), y = random.Normals(5);
    Vector into_y = random.Normals(5), into_x = random.Normals(4), px(4, 0.0);
    const Eigen::VectorXd ax = AsVector(into_y) - 2.0 * Dense(a) * AsVector(x);
    const Eigen::VectorXd aty = AsVector(into_x) + 3.0 * Dense(a).transpose() * AsVector(y);
    MultiplyAdd(a.View(), -2, x.data(), into_y.data());
    TransposedMultiplyAdd(a.View(), 3, y.data(), into_x.data());
    SymmetricMultiplyAdd(p.View(), 1, x.data(), px.data());
    EXPECT_LT((AsVector(into_y) - ax).norm(), 1e-13);
    EXPECT_LT((AsVector(into_x) - aty).norm(), 1e-13);
    const Eigen::MatrixXd symmetric = Dense(p).selfadjointView<Eigen::Upper>();
    EXPECT_LT((AsVector(px) - symmetric * AsVector(x)).norm(), 1e-13);
    EXPECT_NEAR(QuadraticForm(p.View(), x.data()), AsVector(x).dot(symmetric * AsVector(x)), 1e-12);
  }
}

TEST(Csc, StacksAndKeepsRows) {
  Random random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const Csc top = random.Sparse(3, 4, 0.5), bottom = random.Sparse(2, 4, 0.5);
    const Csc both = StackRows(top, bottom);
    EXPECT_EQ(Dense(KeepRows(both, {1, 1, 1, 0, 0})), Dense(top));
    EXPECT_EQ(Dense(KeepRows(both, {0, 0, 0, 1, 1})), Dense(bottom));
  }
  EXPECT_THROW(StackRows(Csc(1, 2), Csc(1, 3)), std::invalid_argument);
}

TEST(Problem, OwnsWhatItsViewPointsTo) {
  ProblemData data;
  data.num_vars = 2;
  data.q = {1, 2};
  data.offset = 3;
  data.A = Csc(1, 2);
  data.row_lower = {0};
  data.row_upper = {1};
  Problem copy;
  {
    const Problem first{data};
    copy = first;
  }
  const Problem moved = std::move(copy);
  EXPECT_EQ(moved.view().q[1], 2);
  EXPECT_EQ(moved.view().A, &*moved.view().A);
  EXPECT_EQ(moved.view().num_rows, 1);
  EXPECT_EQ(moved.view().P, nullptr);
  EXPECT_EQ(moved.view().x_lower, nullptr);
  const double x[] = {1, 1};
  EXPECT_EQ(Objective(moved.view(), x), 6);
}

TEST(Problem, FillsInWhatAProblemLeavesOut) {
  const double upper[] = {1, 2};
  sy_problem given{};
  given.size = sizeof given;
  given.num_vars = 2;
  given.num_rows = 1;
  given.x_upper = upper;
  const ProblemData data(given);
  EXPECT_EQ(data.x_lower, Vector({-kInfinity, -kInfinity}));
  EXPECT_EQ(data.x_upper, Vector({1, 2}));
  EXPECT_EQ(data.q, Vector({0, 0}));
  EXPECT_EQ(data.row_lower, Vector({-kInfinity}));
  EXPECT_EQ(data.A.rows, 1);
  EXPECT_EQ(data.A.cols, 2);
}

}  // namespace
}  // namespace switchyard::testing
