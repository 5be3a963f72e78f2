#include "switchyard/model/cost.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "switchyard/model/program.hpp"
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

double At(const Cost& cost, const VectorXd& x) {
  VectorXd y;
  cost.Eval(x, &y);
  EXPECT_EQ(y.size(), 1);
  return y[0];
}

MatrixXd Random(int rows, int cols, unsigned seed) {
  std::mt19937 source(seed);
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, cols, [&] { return normal(source); });
}

QuadraticCost Form(const CoefficientMatrix& Q) {
  return QuadraticCost(Q, VectorXd::Zero(Q.sparse().rows()));
}

TEST(LinearCost, IsItsFormula) {
  LinearCost cost(Vector2d(2, -3), 4);
  EXPECT_EQ(At(cost, Vector2d(5, 7)), 2 * 5 - 3 * 7 + 4);
  cost.UpdateCoefficients(Vector2d(1, 1));
  EXPECT_EQ(At(cost, Vector2d(5, 7)), 12);
}

TEST(LinearCost, SaysWhatIsWrongAndStaysAsItWas) {
  LinearCost cost(Vector2d(2, -3), 4);
  EXPECT_EQ(Said([&] { cost.UpdateCoefficients(Vector3d(1, 2, 3)); }),
            "linear cost: a needs 2 entries, got 3");
  EXPECT_EQ(Said([&] { cost.UpdateCoefficients(Vector2d(1, kNaN)); }),
            "linear cost: a[1] needs to be finite, got nan");
  EXPECT_EQ(Said([&] { cost.UpdateCoefficients(Vector2d(1, 1), -kInfinity); }),
            "linear cost: b needs to be finite, got -inf");
  EXPECT_EQ(Said([&] { (void)At(cost, Vector3d(1, 2, 3)); }),
            "Eval of linear cost: x needs 2 entries, got 3");
  cost.set_description("fuel");
  EXPECT_EQ(Said([&] { cost.UpdateCoefficients(Vector2d(kInfinity, 0)); }),
            "fuel: a[0] needs to be finite, got inf");
  EXPECT_EQ(At(cost, Vector2d(5, 7)), -7);
}

TEST(QuadraticCost, DependsOnTheSymmetricPartAlone) {
  const MatrixXd Q = Random(4, 4, 1);
  const VectorXd b = Random(4, 1, 2);
  const VectorXd x = Random(4, 1, 3);
  const QuadraticCost cost(Q, b, 3);
  EXPECT_NEAR(At(cost, x), 0.5 * x.dot(Q * x) + b.dot(x) + 3, 1e-13);
  EXPECT_EQ(MatrixXd(cost.Q()), MatrixXd(cost.Q()).transpose());
}

TEST(QuadraticCost, KeepsASymmetricMatrixToTheBit) {
  const MatrixXd half = Random(5, 5, 4);
  const MatrixXd Q = half + half.transpose();
  EXPECT_EQ(MatrixXd(Form(Q).Q()), Q);
}

TEST(QuadraticCost, IsConvexWhereEveryEigenvalueIsNonnegative) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const int n = 1 + static_cast<int>(seed % 6);
    const MatrixXd half = Random(n, n, seed);
    const MatrixXd Q = half + half.transpose() + 2.0 * MatrixXd::Identity(n, n);
    const double least = Eigen::SelfAdjointEigenSolver<MatrixXd>(Q).eigenvalues()[0];
    EXPECT_EQ(Form(Q).is_convex(), least >= 0) << seed << ": least eigenvalue " << least;
  }
}

TEST(QuadraticCost, IsConvexWhereSingular) {
  EXPECT_TRUE(Form(MatrixXd::Zero(3, 3)).is_convex());
  EXPECT_TRUE(Form(MatrixXd::Ones(300, 300)).is_convex());
  EXPECT_TRUE(Form(MatrixXd::Ones(400, 400)).is_convex());  // by the sparse factorization
  for (unsigned seed = 0; seed < 10; ++seed) {
    for (const int rank : {1, 5, 40}) {
      const MatrixXd V = Random(200, rank, seed);
      EXPECT_TRUE(Form(V * V.transpose()).is_convex()) << "rank " << rank;
    }
  }
}

TEST(QuadraticCost, IsNotConvexWhereADirectionDescends) {
  EXPECT_FALSE(Form(MatrixXd{{0, 1}, {1, 0}}).is_convex());
  EXPECT_FALSE(Form(MatrixXd{{1, 2}, {2, 1}}).is_convex());
  EXPECT_FALSE(Form(MatrixXd{{1, 0}, {0, -1e-9}}).is_convex());
  EXPECT_FALSE(Form(MatrixXd{{0, 1e-3}, {1e-3, 5}}).is_convex());
  MatrixXd ones = MatrixXd::Ones(400, 400);
  ones(7, 7) -= 1e-6;
  EXPECT_FALSE(Form(ones).is_convex());
}

TEST(QuadraticCost, IsJudgedByComponentSoThatLargeEntriesHideNothing) {
  MatrixXd Q = MatrixXd::Zero(4, 4);
  Q(0, 0) = 1e14;
  Q(1, 1) = Q(3, 3) = 1;
  EXPECT_TRUE(Form(Q).is_convex());
  Q(1, 3) = Q(3, 1) = 2;
  EXPECT_FALSE(Form(Q).is_convex());
}

TEST(QuadraticCost, IsAsConvexAsTheCallerSays) {
  const MatrixXd Q{{-1.0}};
  EXPECT_TRUE(QuadraticCost(Q, VectorXd::Zero(1), 0, true).is_convex());
  QuadraticCost cost(Q, VectorXd::Zero(1));
  EXPECT_FALSE(cost.is_convex());
  cost.UpdateCoefficients(MatrixXd{{1.0}}, VectorXd::Zero(1));
  EXPECT_TRUE(cost.is_convex());
}

TEST(QuadraticCost, OfTwentyThousandVariablesIsMadeInMilliseconds) {
  constexpr int n = 20000;
  std::vector<Eigen::Triplet<double>> chain;
  for (int i = 0; i < n; ++i) {
    chain.emplace_back(i, i, 2);
    if (i > 0) chain.emplace_back(i, i - 1, -1), chain.emplace_back(i - 1, i, -1);
  }
  SparseMatrix diagonal(n, n);
  SparseMatrix laplacian(n, n);
  diagonal.setIdentity();
  laplacian.setFromTriplets(chain.begin(), chain.end());
  for (const SparseMatrix* Q : {&diagonal, &laplacian}) {
    const CpuClock clock;
    EXPECT_TRUE(Form(*Q).is_convex());
    const double taken = clock.seconds();
    RecordProperty(Q == &diagonal ? "diagonal" : "laplacian", Text(taken));
    if (kTimed) {
      EXPECT_LT(taken, 0.05);
    }
  }
}

TEST(QuadraticCost, SaysWhatIsWrong) {
  EXPECT_EQ(Said([] { QuadraticCost(MatrixXd::Zero(2, 3), Vector2d::Zero()); }),
            "quadratic cost: Q needs to be 2 x 2, got 2 x 3");
  EXPECT_EQ(Said([] {
              QuadraticCost(MatrixXd{{1, 0}, {kNaN, 1}}, Vector2d::Zero());
            }),
            "quadratic cost: Q(1,0) needs to be finite, got nan");
  EXPECT_EQ(Said([] { QuadraticCost(MatrixXd::Zero(2, 2), Vector2d(0, kInfinity)); }),
            "quadratic cost: b[1] needs to be finite, got inf");
  EXPECT_EQ(Said([] { QuadraticCost(MatrixXd::Zero(2, 2), Vector2d::Zero(), kNaN); }),
            "quadratic cost: c needs to be finite, got nan");
}

TEST(NormCosts, AreTheirFormulas) {
  const MatrixXd A{{1, 2}, {3, 4}, {-5, 6}};
  const Vector3d b(1, -1, 2);
  const Vector2d x(0.5, -2);
  const Vector3d z = A * x + b;
  EXPECT_DOUBLE_EQ(At(L1NormCost(A, b), x), z.cwiseAbs().sum());
  EXPECT_DOUBLE_EQ(At(L2NormCost(A, b), x), z.norm());
  EXPECT_DOUBLE_EQ(At(LInfNormCost(A, b), x), z.cwiseAbs().maxCoeff());
  EXPECT_DOUBLE_EQ(At(PerspectiveQuadraticCost(A, b + Vector3d(10, 0, 0)), x),
                   (z[1] * z[1] + z[2] * z[2]) / (z[0] + 10));
}

TEST(PerspectiveQuadraticCost, IsClosedAtTheBoundaryOfItsDomain) {
  const PerspectiveQuadraticCost cost(MatrixXd::Identity(2, 2), Vector2d::Zero());
  EXPECT_EQ(At(cost, Vector2d(0, 0)), 0);
  EXPECT_EQ(At(cost, Vector2d(0, 1)), kInfinity);
  EXPECT_EQ(At(cost, Vector2d(-1, 0)), kInfinity);
  EXPECT_TRUE(std::isnan(At(cost, Vector2d(kNaN, 1))));
}

TEST(NormCosts, SayWhatIsWrong) {
  const MatrixXd I = MatrixXd::Identity(2, 2);
  EXPECT_EQ(Said([&] { L1NormCost(I, Vector3d::Zero()); }),
            "L1-norm cost: b needs 2 entries, got 3");
  EXPECT_EQ(Said([&] { LInfNormCost(kNaN * I, Vector2d::Zero()); }),
            "infinity-norm cost: A(0,0) needs to be finite, got nan");
  EXPECT_EQ(Said([] { PerspectiveQuadraticCost(MatrixXd(0, 2), VectorXd(0)); }),
            "perspective quadratic cost: A needs a row, got none");
  L2NormCost cost(I, Vector2d::Zero());
  EXPECT_EQ(Said([&] { cost.UpdateCoefficients(MatrixXd::Zero(3, 2), Vector3d::Zero()); }),
            "L2-norm cost: A needs to be 2 x 2, got 3 x 2");
}

TEST(ErrorCosts, AreTheirFormulas) {
  MathematicalProgram program;
  const auto vars = program.NewContinuousVariables(3);
  const MatrixXd Q = Random(3, 3, 5);
  const MatrixXd A = Random(4, 3, 6);
  const VectorXd b = Random(4, 1, 7);
  const VectorXd d = Random(3, 1, 8);
  const VectorXd x = Random(3, 1, 9);
  const auto at = [&](const auto& binding) { return program.EvalBinding(binding, x)[0]; };
  EXPECT_NEAR(at(program.AddQuadraticErrorCost(Q, d, vars)), (x - d).dot(Q * (x - d)), 1e-12);
  EXPECT_NEAR(at(program.AddQuadraticErrorCost(2.5, d, vars)), 2.5 * (x - d).squaredNorm(), 1e-12);
  EXPECT_NEAR(at(program.Add2NormSquaredCost(A, b, vars)), (A * x - b).squaredNorm(), 1e-12);
  EXPECT_NEAR(at(program.AddL2NormCost(A, b, vars)), (A * x + b).norm(), 1e-12);
  EXPECT_TRUE(program.quadratic_costs()[1].evaluator()->is_convex());
  EXPECT_TRUE(program.quadratic_costs()[2].evaluator()->is_convex());
  EXPECT_FALSE(program.AddQuadraticErrorCost(-1, d, vars).evaluator()->is_convex());
}

TEST(ErrorCosts, SayWhatIsWrong) {
  MathematicalProgram program;
  const auto vars = program.NewContinuousVariables(2);
  EXPECT_EQ(Said([&] { program.AddQuadraticErrorCost(1, Vector3d::Zero(), vars); }),
            "quadratic error cost: x_desired needs 2 entries, got 3");
  EXPECT_EQ(Said([&] { program.AddQuadraticErrorCost(1, Vector2d(0, kNaN), vars); }),
            "quadratic error cost: x_desired[1] needs to be finite, got nan");
  EXPECT_EQ(
      Said([&] { program.Add2NormSquaredCost(MatrixXd::Zero(3, 3), Vector3d::Zero(), vars); }),
      "2-norm squared cost: A needs to be 3 x 2, got 3 x 3");
  EXPECT_TRUE(program.GetAllCosts().empty());
}

}  // namespace
}  // namespace switchyard
