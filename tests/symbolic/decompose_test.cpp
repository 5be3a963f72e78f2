#include "switchyard/symbolic/decompose.hpp"

#include <random>

#include "tests/model/said.hpp"

namespace switchyard {
namespace {

using Eigen::VectorXd;

VectorXDecisionVariable Variables(int count, Variable::Id first) {
  VectorXDecisionVariable x(count);
  for (int i = 0; i < count; ++i) x[i] = Variable(first + i);
  return x;
}

class Random {
 public:
  explicit Random(unsigned seed) : random_(seed) {}
  double Number() { return std::uniform_real_distribution<>(-2, 2)(random_); }
  int Below(int n) { return std::uniform_int_distribution<>(0, n - 1)(random_); }
  Expression Affine(const VectorXDecisionVariable& x, int terms) {
    Expression e = Number();
    for (int k = 0; k < terms; ++k) e += Number() * x[Below(static_cast<int>(x.size()))];
    return e;
  }

 private:
  std::mt19937 random_;
};

Expression::Values ValuesAt(const VectorXDecisionVariable& x, const VectorXd& point) {
  Expression::Values values;
  for (Eigen::Index i = 0; i < x.size(); ++i) values[x[i]] = point[i];
  return values;
}

VectorXd Of(const VectorXDecisionVariable& some, const Expression::Values& values) {
  VectorXd point(some.size());
  for (Eigen::Index i = 0; i < some.size(); ++i) point[i] = values.at(some[i]);
  return point;
}

TEST(DecomposeAffine, IsTheSameFunction) {
  for (const Variable::Id step : {1, 1000000}) {  // ids close together, and far apart
    VectorXDecisionVariable x(12);
    for (int i = 0; i < 12; ++i) x[i] = Variable(5 + step * i);
    Random random(static_cast<unsigned>(step));
    for (int trial = 0; trial < 50; ++trial) {
      Eigen::VectorX<Expression> e(1 + random.Below(6));
      for (auto& row : e) row = random.Affine(x, random.Below(20));
      const AffineForm form = DecomposeAffine(e);
      const auto values = ValuesAt(x, VectorXd::Random(12));
      const VectorXd at = form.A * Of(form.variables, values) + form.b;
      EXPECT_LT((at - Evaluate(e, values)).cwiseAbs().maxCoeff(), 1e-12);
      EXPECT_TRUE(form.A.isCompressed());
      const SparseMatrix again = SparseMatrix(form.A.transpose()).transpose();
      EXPECT_EQ((form.A - again).norm(), 0) << "rows ascend in each column";
    }
  }
}

TEST(DecomposeAffine, HasTheVariablesInTheOrderOfTheirFirstAppearance) {
  const auto x = Variables(4, 10);
  const AffineForm form =
      DecomposeAffine(Eigen::Vector2<Expression>(2 * x[3] + x[1], x[0] + 3 * x[3] + 1));
  EXPECT_EQ(form.variables, Eigen::Vector3<Variable>(x[3], x[1], x[0]));
  Eigen::MatrixXd A(2, 3);
  A << 2, 1, 0, 3, 0, 1;
  EXPECT_EQ(Eigen::MatrixXd(form.A), A);
  EXPECT_EQ(form.b, Eigen::Vector2d(0, 1));
}

TEST(DecomposeAffine, LeavesOutVariablesThatCancel) {
  const auto x = Variables(3, 10);
  const AffineForm form =
      DecomposeAffine(Eigen::Vector2<Expression>(x[0] + x[1] - x[0], 2 * x[2] - 2 * x[2]));
  EXPECT_EQ(form.variables, VectorXDecisionVariable(x.segment(1, 1)));
  EXPECT_EQ(form.A.nonZeros(), 1);
  EXPECT_EQ(DecomposeAffine(Eigen::VectorX<Expression>(0)).variables.size(), 0);
  EXPECT_EQ(DecomposeAffine(Eigen::Vector2<Expression>(1, 2)).b, Eigen::Vector2d(1, 2));
}

TEST(DecomposeAffine, SaysWhichTermIsNot) {
  const auto x = Variables(3, 1);
  EXPECT_EQ(Said([&] { DecomposeAffine(Eigen::Vector2<Expression>(x[0], 2 + x[1] * x[2])); }),
            "2 + v2*v3 is not affine: the term v2*v3 is not");
}

TEST(DecomposeQuadratic, IsTheSameFunction) {
  const auto x = Variables(6, 1);
  Random random(7);
  for (int trial = 0; trial < 100; ++trial) {
    Expression e = random.Affine(x, 3);
    for (int k = random.Below(4); k >= 0; --k) {
      e += random.Number() * random.Affine(x, random.Below(4)) * random.Affine(x, random.Below(4));
      const Expression a = random.Affine(x, random.Below(4));
      e -= random.Number() * a * a;
      e += pow(random.Affine(x, 2), 2) / 3;
    }
    const QuadraticForm form = DecomposeQuadratic(e);
    const auto values = ValuesAt(x, VectorXd::Random(6));
    const VectorXd at = Of(form.variables, values);
    EXPECT_NEAR(0.5 * at.dot(form.Q * at) + form.b.dot(at) + form.c, e.Evaluate(values), 1e-10);
    EXPECT_LT((form.Q - SparseMatrix(form.Q.transpose())).norm(), 1e-12);
  }
}

TEST(DecomposeQuadratic, OfAQuadraticFormIsItsMatrix) {
  const auto x = Variables(5, 1);
  const Eigen::MatrixXd M = Eigen::MatrixXd::Random(5, 5);
  const Eigen::MatrixXd Q = M.transpose() + M;
  const VectorXd b = VectorXd::Random(5);
  const QuadraticForm form =
      DecomposeQuadratic(0.5 * Expression(x.transpose() * Q * x) + b.dot(x) + 3);
  EXPECT_LT((Eigen::MatrixXd(form.Q) - Q).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_EQ(form.b, b);
  EXPECT_EQ(form.c, 3);
  EXPECT_EQ(form.variables, x);
}

TEST(DecomposeQuadratic, LeavesOutWhatCancels) {
  const auto x = Variables(3, 1);
  const QuadraticForm form =
      DecomposeQuadratic(pow(x[0] + 1, 2) - x[0] * x[0] + x[1] * x[2] - x[2] * x[1]);
  EXPECT_EQ(form.Q.nonZeros(), 0);
  EXPECT_EQ(form.variables, VectorXDecisionVariable(x.head(1)));
  EXPECT_EQ(form.b[0], 2);
  EXPECT_EQ(form.c, 1);
}

TEST(DecomposeQuadratic, SaysWhichTermIsNot) {
  const auto x = Variables(3, 1);
  EXPECT_EQ(Said([&] { DecomposeQuadratic(x[0] * x[0] + 2 * sin(x[1])); }),
            "v1^2 + 2*sin(v2) is not quadratic: the term 2*sin(v2) is not");
  EXPECT_EQ(Said([&] { DecomposeQuadratic(x[0] * x[1] * x[2]); }),
            "v1*v2*v3 is not quadratic: the term v1*v2*v3 is not");
}

TEST(PolynomialDegree, IsReadFromTheForm) {
  const auto x = Variables(2, 1);
  EXPECT_EQ(PolynomialDegree(3), 0);
  EXPECT_EQ(PolynomialDegree(1 + x[0]), 1);
  EXPECT_EQ(PolynomialDegree(x[0] * x[1] + x[0]), 2);
  EXPECT_EQ(PolynomialDegree(pow(x[0] * x[1] + 1, 3) * x[0]), 7);
  EXPECT_EQ(PolynomialDegree(x[0] / 2 + x[0] * x[0] / 3), 2);
  EXPECT_EQ(PolynomialDegree(x[0] / x[1]), std::nullopt);
  EXPECT_EQ(PolynomialDegree(1 + x[0] * sin(x[1])), std::nullopt);
  EXPECT_EQ(PolynomialDegree(pow(x[0], -1)), std::nullopt);
  EXPECT_EQ(PolynomialDegree(pow(x[0], 1.5)), std::nullopt);
  EXPECT_EQ(PolynomialDegree(pow(2, x[0])), std::nullopt);
}

TEST(PolynomialDegree, IsFoundWithoutMultiplyingOut) {
  Expression e = Variable(1) + Variable(2);
  for (int i = 0; i < 200; ++i) e = e * (e + 1);
  EXPECT_EQ(PolynomialDegree(e), 1000000000);
}

}  // namespace
}  // namespace switchyard
