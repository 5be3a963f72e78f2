#include "core/linalg/semidefinite_factor.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>

namespace switchyard::testing {
namespace {

Csc UpperTriangle(const Eigen::MatrixXd& P) {
  const auto n = static_cast<std::int32_t>(P.rows());
  Csc csc(n, n);
  for (std::int32_t j = 0; j < n; ++j) {
    for (std::int32_t i = 0; i <= j; ++i) {
      if (P(i, j) == 0) continue;
      csc.row.push_back(i);
      csc.value.push_back(P(i, j));
    }
    csc.start[static_cast<std::size_t>(j) + 1] = static_cast<std::int32_t>(csc.row.size());
  }
  return csc;
}

Eigen::MatrixXd Dense(const Csc& m) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(m.rows, m.cols);
  for (std::int32_t j = 0; j < m.cols; ++j) {
    for (auto k = static_cast<std::size_t>(m.start[static_cast<std::size_t>(j)]);
         k < static_cast<std::size_t>(m.start[static_cast<std::size_t>(j) + 1]); ++k) {
      dense(m.row[k], j) = m.value[k];
    }
  }
  return dense;
}

TEST(SemidefiniteFactor, MultipliesBackAtAnyRank) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 60; ++trial) {
    const int n = 1 + trial % 7;
    const int rank = trial % (n + 1);
    const Eigen::MatrixXd G = Eigen::MatrixXd::NullaryExpr(rank, n, [&] { return normal(engine); });
    const Eigen::MatrixXd P = G.transpose() * G;
    const SemidefiniteFactor factor = FactorSemidefinite(UpperTriangle(P));
    ASSERT_FALSE(factor.not_semidefinite.has_value());
    EXPECT_EQ(factor.S.rows, rank);
    const Eigen::MatrixXd S = Dense(factor.S);
    EXPECT_LE((S.transpose() * S - P).cwiseAbs().maxCoeff(), 1e-12 * (1 + P.cwiseAbs().maxCoeff()));
  }
}

TEST(SemidefiniteFactor, ShowsThePivotOfAMatrixThatIsNot) {
  Eigen::MatrixXd P = Eigen::MatrixXd::Identity(4, 4);
  P(3, 3) = -2;
  const SemidefiniteFactor factor = FactorSemidefinite(UpperTriangle(P));
  ASSERT_TRUE(factor.not_semidefinite.has_value());
  EXPECT_EQ(factor.not_semidefinite->pivot, -2);
  EXPECT_EQ(factor.not_semidefinite->column, 3);
}

TEST(SemidefiniteFactor, OfNothingHasNoRows) { EXPECT_EQ(FactorSemidefinite(Csc(3, 3)).S.rows, 0); }

}  // namespace
}  // namespace switchyard::testing
