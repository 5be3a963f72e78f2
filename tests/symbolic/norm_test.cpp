#include <gtest/gtest.h>

#include <random>

#include "switchyard/symbolic/decompose.hpp"

namespace switchyard {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class RecognizeNorm : public testing::Test {
 protected:
  RecognizeNorm() {
    for (int i = 0; i < 4; ++i) x[i] = Variable(1 + i);
  }

  // It is recognized, and |Ax + b| has the expression's value at random points.
  AffineForm ExpectNorm(const Expression& e, Eigen::Index rows) {
    const auto form = RecognizeL2Norm(e);
    if (!form) {
      ADD_FAILURE() << e << " is not recognized";
      return {};
    }
    EXPECT_EQ(form->A.rows(), rows) << e;
    for (int trial = 0; trial < 10; ++trial) {
      Expression::Values values;
      for (const Variable v : x) values[v] = std::uniform_real_distribution<>(-3, 3)(random_);
      VectorXd at(form->variables.size());
      for (Eigen::Index i = 0; i < at.size(); ++i) at[i] = values.at(form->variables[i]);
      EXPECT_NEAR((form->A * at + form->b).norm(), e.Evaluate(values), 1e-7) << e;
    }
    return *form;
  }

  VectorXDecisionVariable x{4};
  std::mt19937 random_;
};

TEST_F(RecognizeNorm, OfAnAffineVectorGivesItsRows) {
  const MatrixXd A = MatrixXd::Random(3, 4);
  const VectorXd b = VectorXd::Random(3);
  const AffineForm form = ExpectNorm((A * x + b).norm(), 3);
  EXPECT_EQ(MatrixXd(form.A), A);
  EXPECT_EQ(form.b, b);
  ExpectNorm((x.head(2) - x.tail(2)).norm(), 2);
  ExpectNorm(2.5 * x.norm(), 4);
}

TEST_F(RecognizeNorm, OfAWeightedSumOfSquaresAndAConstant) {
  ExpectNorm(sqrt(2 * pow(x[0] - 1, 2) + pow(x[1] + x[2], 2) / 4 + 3), 3);
  ExpectNorm(pow(x[0] * x[0] + 1, 0.5), 2);
}

TEST_F(RecognizeNorm, OfAnAbsoluteValue) { ExpectNorm(3 * abs(x[0] - 2 * x[1] + 1), 1); }

TEST_F(RecognizeNorm, CompletesAQuadraticThatIsNotWrittenAsSquares) {
  const MatrixXd R = MatrixXd::Random(3, 4);
  const MatrixXd Q = R.transpose() * R;
  const VectorXd d = VectorXd::Random(3);
  const Expression form = x.transpose() * Q * x;
  ExpectNorm(sqrt(form), 3);
  ExpectNorm(sqrt(form + 2 * (R.transpose() * d).dot(x) + d.squaredNorm()), 3);
  ExpectNorm(sqrt(form + 2 * (R.transpose() * d).dot(x) + d.squaredNorm() + 2), 4);
  ExpectNorm(sqrt(x[0] * x[0] + 2 * x[0] * x[1] + 2 * x[1] * x[1]), 2);
  ExpectNorm(sqrt(pow(x[0], 2) + 2 * x[0] + 1), 1);
}

TEST_F(RecognizeNorm, SeesWhatIsNone) {
  for (const Expression& e :
       {Expression(x[0]), sqrt(x[0]), sqrt(x[0] * x[1]), sqrt(x[0] * x[0] - x[1] * x[1]),
        sqrt(x[0] * x[0] - 1), sqrt(x[0] * x[0] + x[1]), -1 * x.norm(), x.norm() + 1,
        x.norm() + x[0], x.norm() + abs(x[0]), sqrt(1 + sin(x[0])), sqrt(pow(x[0], 4)), sin(x[0]),
        abs(x[0] * x[1]), sqrt(x[0] * x[1] + x[1] * x[0])}) {
    EXPECT_FALSE(RecognizeL2Norm(e)) << e;
  }
}

TEST_F(RecognizeNorm, TakesSmallPivotsForZeroByTheTolerance) {
  const Expression e = sqrt(x[0] * x[0] - 1e-5 * (x[1] * x[1]));
  EXPECT_FALSE(RecognizeL2Norm(e));
  ASSERT_TRUE(RecognizeL2Norm(e, 1e-4, 1e-4));
  EXPECT_EQ(RecognizeL2Norm(e, 1e-4, 1e-4)->A.rows(), 1);
  EXPECT_FALSE(RecognizeL2Norm(e, 1e-4, 1e-6)) << "the coefficient that is lost is 1e-5";
}

}  // namespace
}  // namespace switchyard
