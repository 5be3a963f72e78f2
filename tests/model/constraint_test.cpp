#include "switchyard/model/constraint.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "tests/model/cpu_time.hpp"
#include "tests/model/said.hpp"

namespace switchyard {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(LinearConstraint, IsViolatedByItsWorstRow) {
  const LinearConstraint rows(MatrixXd{{1, 1}, {1, -1}}, Vector2d(1, -kInfinity),
                              Vector2d(kInfinity, 2));
  EXPECT_EQ(rows.Violation(Vector2d(1, 1)), 0);
  EXPECT_EQ(rows.Violation(Vector2d(4, -4)), 6);
  EXPECT_EQ(rows.Violation(Vector2d(-3, 0)), 4);
  EXPECT_TRUE(rows.CheckSatisfied(Vector2d(1, -1e-7)));
  EXPECT_FALSE(rows.CheckSatisfied(Vector2d(1, -1e-5)));
}

TEST(LinearConstraint, IsNeverSatisfiedByNaN) {
  const LinearConstraint free(MatrixXd{{1.0}}, VectorXd::Constant(1, -kInfinity),
                              VectorXd::Constant(1, kInfinity));
  EXPECT_TRUE(std::isnan(free.Violation(VectorXd::Constant(1, kNaN))));
  EXPECT_FALSE(free.CheckSatisfied(VectorXd::Constant(1, kNaN)));
  EXPECT_TRUE(free.CheckSatisfied(VectorXd::Constant(1, -kInfinity)));
}

TEST(LinearConstraint, SaysWhatIsWrongWithItsBounds) {
  const MatrixXd I = MatrixXd::Identity(2, 2);
  const auto said = [&](double l0, double l1, double u0, double u1) {
    return Said([&] { LinearConstraint(I, Vector2d(l0, l1), Vector2d(u0, u1)); });
  };
  EXPECT_EQ(said(0, 2, 1, 1), "linear constraint: bounds: lower[1] = 2 is above upper[1] = 1");
  EXPECT_EQ(said(kNaN, 0, 1, 1),
            "linear constraint: bounds: lower[0] needs to be a number, got nan");
  EXPECT_EQ(said(0, 0, 1, kNaN),
            "linear constraint: bounds: upper[1] needs to be a number, got nan");
  EXPECT_EQ(said(kInfinity, 0, kInfinity, 1),
            "linear constraint: bounds: lower[0] needs to be below infinity, got inf");
  EXPECT_EQ(said(0, -kInfinity, 1, -kInfinity),
            "linear constraint: bounds: upper[1] needs to be above -infinity, got -inf");
  EXPECT_EQ(Said([&] { LinearConstraint(I, Vector3d::Zero(), Vector2d::Zero()); }),
            "linear constraint: lower needs 2 entries, got 3");
  EXPECT_EQ(Said([&] { LinearConstraint(I, Vector2d::Zero(), Vector3d::Zero()); }),
            "linear constraint: upper needs 2 entries, got 3");
}

TEST(LinearConstraint, SaysWhichCoefficientIsWrong) {
  const VectorXd zero = VectorXd::Zero(1);
  EXPECT_EQ(Said([&] {
              LinearConstraint(MatrixXd{{1, kInfinity}}, zero, zero);
            }),
            "linear constraint: A(0,1) needs to be finite, got inf");
  EXPECT_EQ(Said([&] {
              LinearEqualityConstraint(MatrixXd{{kNaN, 0}}, zero);
            }),
            "linear equality constraint: A(0,0) needs to be finite, got nan");
}

TEST(LinearConstraint, StaysAsItWasWhereAnUpdateIsRefused) {
  LinearConstraint rows(MatrixXd{{1, 2}}, VectorXd::Zero(1), VectorXd::Ones(1));
  EXPECT_EQ(Said([&] {
              rows.UpdateCoefficients(MatrixXd{{3, 4}}, VectorXd::Ones(1), VectorXd::Zero(1));
            }),
            "linear constraint: bounds: lower[0] = 1 is above upper[0] = 0");
  EXPECT_EQ(Said([&] {
              rows.UpdateCoefficients(MatrixXd::Zero(2, 2), Vector2d::Zero(), Vector2d::Zero());
            }),
            "linear constraint: A needs to be 1 x 2, got 2 x 2");
  EXPECT_EQ(rows.GetDenseA(), (MatrixXd{{1, 2}}));
  rows.UpdateCoefficients(MatrixXd{{3, 4}}, VectorXd::Zero(1), VectorXd::Constant(1, 9));
  EXPECT_EQ(rows.GetDenseA(), (MatrixXd{{3, 4}}));
  EXPECT_EQ(rows.upper_bound()[0], 9);
}

TEST(LinearConstraint, KeepsThePatternOfASparseMatrixAndMovesIt) {
  SparseMatrix A(2, 2);
  A.insert(0, 0) = 1;
  A.insert(1, 1) = 0;
  A.makeCompressed();
  const double* values = A.valuePtr();
  const LinearConstraint rows(std::move(A), Vector2d::Zero(), Vector2d::Zero());
  EXPECT_EQ(rows.get_sparse_A().nonZeros(), 2);
  EXPECT_EQ(rows.get_sparse_A().valuePtr(), values);
  const LinearConstraint dense(MatrixXd{{1, 0}, {0, 0}}, Vector2d::Zero(), Vector2d::Zero());
  EXPECT_EQ(dense.get_sparse_A().nonZeros(), 1);
}

TEST(LinearConstraint, OfAHundredThousandRowsIsMadeInLinearTime) {
  const auto seconds = [](int n) {
    SparseMatrix A(n, n);
    A.reserve(Eigen::VectorXi::Constant(n, 2));
    for (int j = 0; j < n; ++j) {
      A.insert(j, j) = 1;
      if (j + 1 < n) A.insert(j + 1, j) = -1;
    }
    const CpuClock clock;
    const LinearConstraint rows(std::move(A), VectorXd::Zero(n), VectorXd::Ones(n));
    EXPECT_EQ(rows.num_constraints(), n);
    return clock.seconds();
  };
  const double taken = seconds(100000);
  RecordProperty("seconds", Text(taken));
  if (kTimed) {
    EXPECT_LT(taken, 0.05);
  }
}

TEST(LinearEqualityConstraint, StaysAnEquality) {
  LinearEqualityConstraint rows(MatrixXd{{1, 2}}, VectorXd::Constant(1, 3));
  EXPECT_EQ(rows.Violation(Vector2d(1, 2)), 2);
  LinearConstraint& base = rows;
  EXPECT_EQ(Said([&] {
              base.UpdateCoefficients(MatrixXd{{1, 2}}, VectorXd::Zero(1), VectorXd::Ones(1));
            }),
            "linear equality constraint: row 0 of an equality needs two equal sides, got 0 and 1");
  rows.UpdateCoefficients(MatrixXd{{2, 0}}, VectorXd::Constant(1, 4));
  EXPECT_EQ(rows.Violation(Vector2d(2, 0)), 0);
}

TEST(BoundingBoxConstraint, StaysABox) {
  BoundingBoxConstraint box(Vector2d(0, -kInfinity), Vector2d(1, 5));
  EXPECT_EQ(box.GetDenseA(), (MatrixXd::Identity(2, 2)));
  EXPECT_EQ(box.Violation(Vector2d(-2, 6)), 2);
  box.UpdateBounds(Vector2d(-2, 0), Vector2d(1, 5));
  EXPECT_EQ(box.Violation(Vector2d(-2, 6)), 1);
  EXPECT_EQ(Said([&] {
              box.UpdateCoefficients(MatrixXd{{2, 0}, {0, 1}}, Vector2d::Zero(), Vector2d::Ones());
            }),
            "bounding box constraint: A of a bounding box is the identity, got another matrix");
  EXPECT_EQ(Said([&] { box.UpdateBounds(Vector2d(0, 0), Vector2d(1, -1)); }),
            "bounding box constraint: bounds: lower[1] = 0 is above upper[1] = -1");
  EXPECT_EQ(box.upper_bound(), Vector2d(1, 5));
}

TEST(Constraint, NamesItsRows) {
  LinearConstraint rows(MatrixXd::Identity(2, 2), Vector2d::Zero(), Vector2d::Ones());
  EXPECT_EQ(rows.RowName(1), "linear constraint[1]");
  rows.set_description("balance");
  EXPECT_EQ(rows.RowName(1), "balance[1]");
  EXPECT_EQ(Said([&] { rows.set_row_names({"one"}); }),
            "balance: row names: there are 2 rows, got 1 names");
  rows.set_row_names({"north", "south"});
  EXPECT_EQ(rows.RowName(1), "south");
  EXPECT_EQ(Said([&] { (void)rows.RowName(2); }), "balance: row 2: there are 2");
  rows.set_row_names({});
  EXPECT_EQ(rows.RowName(0), "balance[0]");
}

}  // namespace
}  // namespace switchyard
