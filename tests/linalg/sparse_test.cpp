// Products with sparse matrices and sums over long vectors, against dense ones.
#include "solvers/linalg/sparse.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "solvers/linalg/vector.hpp"
#include "tests/linalg/matrices.hpp"

namespace switchyard::linalg {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Eigen::VectorXd RandomVector(Random& random, Index n) {
  return Eigen::VectorXd::NullaryExpr(n, [&] { return random.Normal(); });
}

SparseMatrix RandomSparse(Random& random, Index rows, Index cols, double density) {
  SparseMatrix a;
  a.rows = rows;
  a.cols = cols;
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < cols; ++j) {
      if (!random.Chance(density)) continue;
      a.column.push_back(j);
      a.by_row.push_back(random.Normal());
    }
    a.row_start.push_back(static_cast<Index>(a.column.size()));
  }
  a.IndexColumns();
  return a;
}

Eigen::MatrixXd Dense(const SparseMatrix& a) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(a.rows, a.cols);
  for (Index i = 0; i < a.rows; ++i) {
    for (Index k = a.row_start[i]; k < a.row_start[i + 1]; ++k) dense(i, a.column[k]) = a.by_row[k];
  }
  return dense;
}

const std::vector<std::pair<Index, Index>> kSizes = {{0, 0},  {0, 5},  {5, 0},  {1, 1},
                                                     {3, 40}, {40, 3}, {70, 90}};

TEST(SparseMatrix, IsTheSameByColumns) {
  Random random(25);
  for (const auto& [rows, cols] : kSizes) {
    for (const double density : {0.0, 0.1, 1.0}) {
      const SparseMatrix a = RandomSparse(random, rows, cols, density);
      const Eigen::MatrixXd dense = Dense(a);
      ASSERT_EQ(static_cast<Index>(a.column_start.size()), cols + 1);
      EXPECT_EQ(a.column_start.back(), a.nonzeros());
      for (Index j = 0; j < cols; ++j) {
        for (Index k = a.column_start[j]; k < a.column_start[j + 1]; ++k) {
          EXPECT_EQ(a.by_column[k], dense(a.row[k], j));
          if (k > a.column_start[j]) {
            EXPECT_LT(a.row[k - 1], a.row[k]);
          }
        }
      }
    }
  }
}

TEST(SparseMatrix, MultipliesFromBothSidesAsADenseOneDoes) {
  Random random(26);
  for (const auto& [rows, cols] : kSizes) {
    SparseMatrix a = RandomSparse(random, rows, cols, 0.2);
    for (const double scale : {1.0, -3.0}) {
      for (double& v : a.by_row) v *= scale;
      a.CopyToColumns();
      const Eigen::MatrixXd dense = Dense(a);
      const Eigen::VectorXd x = RandomVector(random, cols), z = RandomVector(random, rows);
      Eigen::VectorXd y = RandomVector(random, rows), w = RandomVector(random, cols);
      Multiply(a, x.data(), y.data());
      EXPECT_LE((y - dense * x).norm(), 1e-13 * (1 + y.norm()));
      const Eigen::VectorXd expected = w + 0.7 * dense.transpose() * z;
      AddTransposed(a, 0.7, z.data(), w.data());
      EXPECT_LE((w - expected).norm(), 1e-13 * (1 + w.norm()));
    }
  }
}

class SymmetricProducts : public ::testing::TestWithParam<Case> {};

TEST_P(SymmetricProducts, AreThoseOfADenseMatrix) {
  Random random(27);
  for (const bool diagonal : {true, false}) {
    const Index n = GetParam().n;
    SymmetricMatrix p{PatternOf(random, n, GetParam().pairs(random, n), diagonal), {}};
    p.value = random.Normals(p.pattern.nonzeros());
    const Eigen::VectorXd x = RandomVector(random, n);
    Eigen::VectorXd y = RandomVector(random, n);
    const Eigen::VectorXd expected = y - 1.3 * Dense(p.pattern, p.value) * x;
    AddProduct(p, -1.3, x.data(), y.data());
    EXPECT_LE((y - expected).norm(), 1e-13 * (1 + y.norm()));
  }
}

INSTANTIATE_TEST_SUITE_P(Every, SymmetricProducts, ::testing::ValuesIn(Cases()), NameOf);

TEST(VectorSums, AreThoseOfTheirTermsAtEveryLengthAndAlignment) {
  Random random(28);
  for (Index n = 0; n < 70; ++n) {
    for (const Index shift : {0, 3}) {
      const Eigen::VectorXd all = RandomVector(random, n + shift);
      const double* a = all.data() + shift;
      const Eigen::VectorXd at = all.tail(n), b = RandomVector(random, n);
      EXPECT_NEAR(Dot(a, b.data(), n), at.dot(b), 1e-13 * (1 + n));
      EXPECT_EQ(MaxAbs(a, n), n == 0 ? 0 : at.cwiseAbs().maxCoeff());
      Eigen::VectorXd y = b;
      AddMultiple(-0.3, a, n, y.data());
      EXPECT_LE((y - (b - 0.3 * at)).norm(), 1e-14 * (1 + n));
    }
  }
}

TEST(MaxAbs, IsNanWhereOneNumberIsNotFinite) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    for (std::size_t n = 1; n < 40; ++n) {
      for (std::size_t at = 0; at < n; ++at) {
        Vector v(n, 1.0);
        v[at] = bad;
        EXPECT_TRUE(std::isnan(MaxAbs(v)));
      }
    }
  }
}

TEST(Simd, IsTheSameEightAtATime) {
  Random random(29);
  for (int trial = 0; trial < 100; ++trial) {
    Lanes a, b;
    for (int i = 0; i < kLanes; ++i) {
      a[i] = std::abs(random.Normal());
      b[i] = random.Chance(0.2) ? a[i] : random.Normal();
    }
    double least = a[0];
    for (int i = 0; i < kLanes; ++i) {
      EXPECT_EQ(Sqrt(a)[i], std::sqrt(a[i]));
      EXPECT_EQ(Min(a, b)[i], std::min(a[i], b[i]));
      EXPECT_EQ(Max(a, b)[i], std::max(a[i], b[i]));
      least = std::min(least, a[i]);
    }
    EXPECT_EQ(Least(a), least);
  }
  EXPECT_EQ(RoundUp(0), 0);
  EXPECT_EQ(RoundUp(1), kLanes);
  EXPECT_EQ(RoundUp(kLanes), kLanes);
  EXPECT_EQ(RoundUp(kLanes + 1), 2 * kLanes);
}

}  // namespace
}  // namespace switchyard::linalg
