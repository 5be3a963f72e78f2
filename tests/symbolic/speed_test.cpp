#include <gtest/gtest.h>

#include <random>

#include "switchyard/symbolic/decompose.hpp"
#include "tests/model/cpu_time.hpp"

namespace switchyard {
namespace {

constexpr int kRows = 10000;
constexpr int kTerms = 10;
// Measured 0.012 s: below this is only what grows with the number of terms.
constexpr double kSeconds = 0.1;

VectorXDecisionVariable Variables() {
  VectorXDecisionVariable x(kRows);
  for (int i = 0; i < kRows; ++i) x[i] = Variable(1 + i);
  return x;
}

TEST(Speed, OfTenThousandRowsWrittenTermByTerm) {
  const VectorXDecisionVariable x = Variables();
  std::mt19937 random;
  const CpuClock clock;
  Eigen::VectorX<Expression> rows(kRows);
  for (auto& row : rows) {
    for (int k = 0; k < kTerms; ++k) row += 0.5 * x[random() % kRows];
    row -= 1;
  }
  const AffineForm form = DecomposeAffine(rows);
  EXPECT_TRUE(!kTimed || clock.seconds() < kSeconds) << clock.seconds();
  EXPECT_EQ(form.A.rows(), kRows);
  EXPECT_NEAR(static_cast<double>(form.A.nonZeros()), kRows * kTerms, 100);
}

TEST(Speed, OfTenThousandRowsFromProductsOfMatrices) {
  const VectorXDecisionVariable x = Variables();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(100, 200);
  for (int i = 0; i < 100; ++i) {
    for (int k = 0; k < kTerms; ++k) A(i, (7 * i + 20 * k) % 200) = 1 + k;
  }
  const CpuClock clock;
  Eigen::VectorX<Expression> rows(kRows);
  for (int block = 0; block < 100; ++block) {
    rows.segment(100 * block, 100) = A * x.segment(97 * block, 200) - Eigen::VectorXd::Ones(100);
  }
  const AffineForm form = DecomposeAffine(rows);
  EXPECT_TRUE(!kTimed || clock.seconds() < kSeconds) << clock.seconds();
  EXPECT_EQ(form.A.nonZeros(), kRows * kTerms);
}

}  // namespace
}  // namespace switchyard
