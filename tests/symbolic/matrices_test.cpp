#include "switchyard/symbolic/matrices.hpp"

#include <Eigen/Geometry>
#include <random>

#include "tests/model/said.hpp"

namespace switchyard {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Symbols and their values, so that each operation can be done on both.
class Matrices : public testing::Test {
 protected:
  static constexpr int kSize = 4;
  Matrices() {
    for (int i = 0; i < kSize; ++i) {
      x[i] = Variable(1 + i);
      y[i] = Variable(11 + i);
      at[x[i]] = X[i];
      at[y[i]] = Y[i];
    }
  }

  void ExpectSame(const Expression& e, double value) const {
    EXPECT_NEAR(e.Evaluate(at), value, 1e-12) << e;
  }
  template <class Derived>
  void ExpectSame(const Eigen::MatrixBase<Derived>& e, const MatrixXd& value) const {
    const MatrixXd found = Evaluate(e.template cast<Expression>().eval(), at);
    ASSERT_EQ(found.rows(), value.rows());
    ASSERT_EQ(found.cols(), value.cols());
    EXPECT_LT((found - value).cwiseAbs().maxCoeff(), 1e-12) << e;
  }

  VectorXd X = VectorXd::Random(kSize), Y = VectorXd::Random(kSize), c = VectorXd::Random(kSize);
  MatrixXd A = MatrixXd::Random(3, kSize), Q = MatrixXd::Random(kSize, kSize);
  VectorXDecisionVariable x{kSize}, y{kSize};
  Expression::Values at;
};

TEST_F(Matrices, MultiplyLikeNumbers) {
  const Eigen::VectorX<Expression> Ax = A * x;
  const Eigen::MatrixX<Expression> xy = x * y.transpose();
  ExpectSame(Ax, A * X);
  ExpectSame(xy, X * Y.transpose());
  ExpectSame(A * xy, A * X * Y.transpose());
  ExpectSame(xy * A.transpose(), X * Y.transpose() * A.transpose());
  ExpectSame(xy * x, X * Y.transpose() * X);
  ExpectSame(xy * xy, X * Y.transpose() * X * Y.transpose());
  ExpectSame(x.transpose() * Q, X.transpose() * Q);
  ExpectSame(A.leftCols(2) * x.tail(2), A.leftCols(2) * X.tail(2));
  ExpectSame((2 * A) * (x + y), 2 * A * (X + Y));
  ExpectSame(c.asDiagonal() * x, c.asDiagonal() * X);
  const Eigen::SparseMatrix<double> S = A.sparseView();
  ExpectSame(S * x, A * X);
  ExpectSame(S * xy, A * X * Y.transpose());
  ExpectSame(S.transpose() * Ax, A.transpose() * A * X);
}

TEST_F(Matrices, OfOneEntryAreExpressions) {
  const Expression quadratic = x.transpose() * Q * x;
  ExpectSame(quadratic, X.transpose() * Q * X);
  const Expression sum = x.transpose() * Q * x + c.transpose() * x;
  ExpectSame(sum, X.dot(Q * X) + c.dot(X));
  ExpectSame(x.transpose() * y - 1 + Expression(c.transpose() * x), X.dot(Y) - 1 + c.dot(X));
  ExpectSame((x.transpose() * y)(0), X.dot(Y));
}

TEST_F(Matrices, HaveDotProductsSumsAndNorms) {
  ExpectSame(x.dot(y), X.dot(Y));
  ExpectSame(c.dot(x), c.dot(X));
  ExpectSame(x.dot(c), X.dot(c));
  ExpectSame(x.dot(Q * y), X.dot(Q * Y));
  ExpectSame((x - y).squaredNorm(), (X - Y).squaredNorm());
  ExpectSame((x - y).norm(), (X - Y).norm());
  ExpectSame(x.squaredNorm(), X.squaredNorm());
  ExpectSame(x.norm(), X.norm());
  ExpectSame((A * x + VectorXd::Ones(3)).norm(), (A * X + VectorXd::Ones(3)).norm());
  ExpectSame((x + y).sum(), (X + Y).sum());
  ExpectSame(x.cast<Expression>().sum(), X.sum());
  ExpectSame((A * x).mean(), (A * X).mean());
  ExpectSame((Q * x).prod(), (Q * X).prod());
  ExpectSame((x * y.transpose()).trace(), X.dot(Y));
  ExpectSame((A * x).cwiseAbs().sum(), (A * X).cwiseAbs().sum());
  ExpectSame((A * x).array().sin().matrix(), (A * X).array().sin().matrix());
  ExpectSame((A * x).array().square().matrix(), (A * X).array().square().matrix());
}

TEST_F(Matrices, AddScaleAndMultiplyEntryByEntry) {
  ExpectSame(2 * x, 2 * X);
  ExpectSame(x * 2.5, X * 2.5);
  ExpectSame(x / 4, X / 4);
  ExpectSame(x + y, X + Y);
  ExpectSame(x - c, X - c);
  ExpectSame(c + x, c + X);
  ExpectSame(A * x - VectorXd::Ones(3), A * X - VectorXd::Ones(3));
  ExpectSame(-(A * x), -(A * X));
  ExpectSame(x.cwiseProduct(y), X.cwiseProduct(Y));
  ExpectSame(x.cwiseProduct(c), X.cwiseProduct(c));
  ExpectSame((x.array() * y.array() + c.array()).matrix(), X.cwiseProduct(Y) + c);
  ExpectSame(x[0] * c, X[0] * c);
  ExpectSame(x[0] * x.cast<Expression>(), X[0] * X);
  ExpectSame(x[0] * Q, X[0] * Q);
  ExpectSame(Q / (2 + y[0]), Q / (2 + Y[0]));
  Eigen::VectorX<Expression> e = A * x;
  e += A * y;
  e *= 2;
  e -= Eigen::VectorX<Expression>(A * x);
  ExpectSame(e, A * X + 2 * A * Y);
  Eigen::VectorX<Expression> listed(3);
  listed << x[0], 2 * y[1], 3;
  ExpectSame(listed, Eigen::Vector3d(X[0], 2 * Y[1], 3));
}

TEST_F(Matrices, OfFixedSizesDoTheSame) {
  const Eigen::Vector3<Variable> u = x.head<3>(), v = y.head<3>();
  const Eigen::Vector3d U = X.head<3>(), V = Y.head<3>();
  const Eigen::Matrix3d R = Q.topLeftCorner<3, 3>();
  ExpectSame(R * u, R * U);
  ExpectSame(u.transpose() * R * v, U.transpose() * R * V);
  ExpectSame(u.cross(v), U.cross(V));
  ExpectSame((u - V).squaredNorm(), (U - V).squaredNorm());
  ExpectSame((u - v).norm(), (U - V).norm());
}

TEST_F(Matrices, LeaveOutZerosOfAMatrixOfNumbers) {
  MatrixXd B = MatrixXd::Zero(2, kSize);
  B(0, 1) = 2;
  const Eigen::VectorX<Expression> Bx = B * x;
  EXPECT_EQ(Bx[0].linear().size(), 1U);
  EXPECT_TRUE(Bx[1].linear().empty());
}

TEST_F(Matrices, CompareAsArraysEntryByEntry) {
  const auto lower = x.array() <= y.array();
  static_assert(std::same_as<decltype(lower)::Scalar, Formula>);
  for (int i = 0; i < kSize; ++i) {
    EXPECT_TRUE(lower(i).EqualTo(x[i] <= y[i]));
    EXPECT_TRUE((x.array() == y.array())(i).EqualTo(x[i] == y[i]));
    EXPECT_TRUE((x.array() >= c.array())(i).EqualTo(x[i] >= c[i]));
    EXPECT_TRUE((c.array() == x.array())(i).EqualTo(c[i] == x[i]));
    EXPECT_TRUE((x.array() <= 1)(i).EqualTo(x[i] <= 1));
    EXPECT_TRUE((1 <= x.array())(i).EqualTo(1 <= x[i]));
    EXPECT_TRUE((x.array() == y[0])(i).EqualTo(x[i] == y[0]));
    EXPECT_TRUE((c.array() <= y[0])(i).EqualTo(c[i] <= y[0]));
    EXPECT_TRUE(((x + y).array() < (2 * x).array())(i).EqualTo(x[i] + y[i] < 2 * x[i]));
    EXPECT_TRUE((x.array() > y.array())(i).EqualTo(x[i] > y[i]));
    EXPECT_EQ((x.array() != y.array())(i).kind(), Formula::Kind::kNotEqual);
  }
  EXPECT_TRUE(((A * x).array() <= 1)(2).EqualTo((A * x)[2] <= 1));
}

TEST_F(Matrices, CompareAsMatricesByOneFormula) {
  const Formula f = A * x == Eigen::Vector3d(1, 2, 3);
  ASSERT_EQ(f.kind(), Formula::Kind::kAnd);
  ASSERT_EQ(f.parts().size(), 3U);
  EXPECT_TRUE(f.parts()[1].EqualTo((A * x)[1] == 2));
  EXPECT_EQ((x <= y).parts().size(), 4U);
  EXPECT_EQ((x >= c).parts().size(), 4U);
}

TEST_F(Matrices, OfVariablesAreTheSameOrNot) {
  EXPECT_EQ(x, x);
  EXPECT_TRUE(bool(x == x));
  EXPECT_FALSE(bool(x == y));
  EXPECT_TRUE(bool(x != y));
  EXPECT_TRUE((x.array() == x.array()).all());
  EXPECT_FALSE((x.array() == y.array()).any());
  EXPECT_TRUE((x.array() == x[2]).any());
}

TEST_F(Matrices, SayWhichSizesDoNotFit) {
  EXPECT_EQ(Said([&] { (void)(A * x.head(2)); }), "a product of a 3 x 4 matrix with one of 2 x 1");
  EXPECT_EQ(Said([&] { (void)(x == y.head(2)); }), "a 4 x 1 matrix compared with one of 2 x 1");
  EXPECT_EQ(Said([&] { (void)(x.array() <= y.head(2).array()); }),
            "a 4 x 1 array compared with one of 2 x 1");
}

}  // namespace
}  // namespace switchyard
