#include <Eigen/Eigenvalues>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "switchyard/model/constraint.hpp"
#include "tests/model/said.hpp"

namespace switchyard {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

CoefficientMatrix Identity(int n) { return MatrixXd::Identity(n, n).eval(); }

class Source {
 public:
  explicit Source(unsigned seed) : engine_(seed) {}
  VectorXd Vector(int n) {
    return VectorXd::NullaryExpr(n, [&] { return normal_(engine_); });
  }
  MatrixXd Symmetric(int n) {
    const MatrixXd half = Vector(n * n).reshaped(n, n);
    return half + half.transpose();
  }

 private:
  std::mt19937 engine_;
  std::normal_distribution<double> normal_;
};

// How far z is inside, positive where it is, in the formula that users know.
using Depth = std::function<double(const VectorXd&)>;

// The constraint on z itself says of random points what the formula says of them.
void ExpectMembership(const Constraint& cone, const Depth& depth) {
  Source source(11);
  int inside = 0;
  for (int k = 0; k < 2000; ++k) {
    VectorXd z = source.Vector(cone.num_vars());
    z[0] += 1;
    const double d = depth(z);
    if (std::abs(d) < 1e-9) continue;
    EXPECT_EQ(cone.CheckSatisfied(z, 0), d > 0) << "at " << z.transpose();
    inside += d > 0 ? 1 : 0;
  }
  EXPECT_GT(inside, 50) << "too few points inside to mean anything";
}

VectorXd InAbi(const ConeConstraint& cone, const VectorXd& z) {
  VectorXd s(static_cast<Eigen::Index>(cone.frame().size()));
  for (std::size_t i = 0; i < cone.frame().size(); ++i) {
    s[static_cast<Eigen::Index>(i)] = cone.frame()[i].scale * z[cone.frame()[i].row];
  }
  return s;
}

// <y, z> = <y_abi, s> for any dual: the value of a Lagrangian does not depend on the coordinates.
void ExpectPairingKept(const ConeConstraint& cone, const VectorXd& z, unsigned seed) {
  Source source(seed);
  const VectorXd dual = source.Vector(static_cast<int>(cone.frame().size()));
  EXPECT_EQ(cone.cone().dim, static_cast<int>(cone.frame().size()));
  EXPECT_NEAR(cone.DualInUserFrame(dual).dot(z), dual.dot(InAbi(cone, z)), 1e-11);
}

TEST(LorentzConeConstraint, HoldsWhereTheFirstEntryIsAtLeastTheNormOfTheOthers) {
  const LorentzConeConstraint cone(Identity(3), Vector3d::Zero());
  ExpectMembership(cone, [](const VectorXd& z) { return z[0] - z.tail(2).norm(); });
  ExpectPairingKept(cone, Source(1).Vector(3), 2);
}

TEST(RotatedLorentzConeConstraint, HoldsWhereTheProductIsAtLeastTheSquares) {
  const RotatedLorentzConeConstraint cone(Identity(4), VectorXd::Zero(4));
  ExpectMembership(cone, [](const VectorXd& z) {
    return std::min({z[0], z[1], z[0] * z[1] - z.tail(2).squaredNorm()});
  });
  ExpectPairingKept(cone, Source(3).Vector(4), 4);
}

TEST(RotatedLorentzConeConstraint, HasTheDualThatUsersKnow) {
  // y is in the dual of {z0 z1 >= |w|^2} where 4 y0 y1 >= |y_w|^2.
  const RotatedLorentzConeConstraint cone(Identity(3), Vector3d::Zero());
  const Vector3d on_boundary(1, 2, 2);  // of the ABI's cone, its own dual: 2 s0 s1 = s2^2
  const VectorXd y = cone.DualInUserFrame(on_boundary);
  EXPECT_NEAR(4 * y[0] * y[1], y[2] * y[2], 1e-12);
}

TEST(ExponentialConeConstraint, HoldsWhereTheFirstEntryIsAboveThePerspectiveOfExp) {
  const ExponentialConeConstraint cone(Identity(3), Vector3d::Zero());
  ExpectMembership(cone, [](const VectorXd& z) {
    return z[1] > 0 ? z[0] - z[1] * std::exp(z[2] / z[1]) : std::min({z[0], -z[2], z[1]});
  });
  ExpectPairingKept(cone, Source(5).Vector(3), 6);
  EXPECT_TRUE(cone.CheckSatisfied(Vector3d(1, 0, -1), 0));  // of its closure
}

TEST(PowerConeConstraint, HoldsWhereTheWeightedMeanIsAtLeastTheThirdEntry) {
  const PowerConeConstraint cone(Identity(3), Vector3d::Zero(), 0.3);
  ExpectMembership(cone, [](const VectorXd& z) {
    if (z[0] < 0 || z[1] < 0) return std::min(z[0], z[1]);
    return std::pow(z[0], 0.3) * std::pow(z[1], 0.7) - std::abs(z[2]);
  });
  ExpectPairingKept(cone, Source(7).Vector(3), 8);
}

TEST(PositiveSemidefiniteConstraint, HoldsWhereNoEigenvalueIsNegative) {
  Source source(9);
  int inside = 0;
  for (int k = 0; k < 300; ++k) {
    const int n = 1 + k % 4;
    const PositiveSemidefiniteConstraint cone(n);
    const MatrixXd X = source.Symmetric(n) + 2.0 * MatrixXd::Identity(n, n);
    const double least = Eigen::SelfAdjointEigenSolver<MatrixXd>(X).eigenvalues()[0];
    EXPECT_EQ(cone.CheckSatisfied(X.reshaped(), 1e-12), least > 0) << X;
    ExpectPairingKept(cone, X.reshaped(), static_cast<unsigned>(k));
    inside += least > 0 ? 1 : 0;
  }
  EXPECT_GT(inside, 50);
}

TEST(PositiveSemidefiniteConstraint, ReadsTheUpperTriangle) {
  const PositiveSemidefiniteConstraint cone(2);
  EXPECT_TRUE(cone.CheckSatisfied(MatrixXd{{1, 0}, {9, 1}}.reshaped(), 0));
  EXPECT_FALSE(cone.CheckSatisfied(MatrixXd{{1, 9}, {0, 1}}.reshaped(), 0));
}

TEST(PositiveSemidefiniteConstraint, HasASymmetricMatrixForItsDual) {
  const PositiveSemidefiniteConstraint cone(3);
  VectorXd svec(6);
  svec << 1, 2 * std::sqrt(2.0), 3, 4 * std::sqrt(2.0), 5 * std::sqrt(2.0), 6;
  const VectorXd dual = cone.DualInUserFrame(svec);
  const MatrixXd Y = dual.reshaped(3, 3);
  EXPECT_TRUE(Y.isApprox(MatrixXd{{1, 2, 4}, {2, 3, 5}, {4, 5, 6}}, 1e-14)) << Y;
}

TEST(LinearMatrixInequality, HoldsWhereTheSumHasNoNegativeEigenvalue) {
  Source source(13);
  const std::vector<MatrixXd> F = {source.Symmetric(3) + 3.0 * MatrixXd::Identity(3, 3),
                                   source.Symmetric(3), source.Symmetric(3)};
  const LinearMatrixInequalityConstraint cone(F);
  EXPECT_EQ(cone.num_vars(), 2);
  EXPECT_EQ(cone.matrix_rows(), 3);
  for (int k = 0; k < 200; ++k) {
    const VectorXd x = source.Vector(2);
    const MatrixXd sum = F[0] + x[0] * F[1] + x[1] * F[2];
    const double least = Eigen::SelfAdjointEigenSolver<MatrixXd>(sum).eigenvalues()[0];
    VectorXd z;
    cone.Eval(x, &z);
    EXPECT_TRUE(z.isApprox(sum.reshaped(), 1e-13));
    EXPECT_EQ(cone.CheckSatisfied(x, 1e-12), least > 0);
    ExpectPairingKept(cone, z, static_cast<unsigned>(k));
  }
}

TEST(ConeConstraints, HoldAtAffineImagesOfTheirVariables) {
  const MatrixXd A{{0.0}, {1.0}};
  LorentzConeConstraint cone(A, Vector2d(3, 1));  // 3 >= |x + 1|
  EXPECT_TRUE(cone.CheckSatisfied(VectorXd::Constant(1, 2), 0));
  EXPECT_FALSE(cone.CheckSatisfied(VectorXd::Constant(1, 2.1), 0.01));
  cone.UpdateCoefficients(A, Vector2d(4, 1));
  EXPECT_TRUE(cone.CheckSatisfied(VectorXd::Constant(1, 2.1), 0));
  EXPECT_TRUE(std::isnan(cone.Violation(VectorXd::Constant(1, kNaN))));
}

TEST(ConeConstraints, SayWhatIsWrong) {
  const VectorXd one = VectorXd::Ones(1);
  EXPECT_EQ(Said([] { LorentzConeConstraint(MatrixXd(0, 2), VectorXd(0)); }),
            "Lorentz cone constraint: A needs at least 1 row, got 0");
  EXPECT_EQ(Said([&] { RotatedLorentzConeConstraint(Identity(1), one); }),
            "rotated Lorentz cone constraint: A needs at least 2 rows, got 1");
  EXPECT_EQ(Said([] { ExponentialConeConstraint(Identity(2), Vector2d::Zero()); }),
            "exponential cone constraint: A needs 3 rows, got 2");
  EXPECT_EQ(Said([] { PowerConeConstraint(Identity(3), Vector3d::Zero(), 1); }),
            "power cone constraint: alpha needs to be in (0, 1), got 1");
  EXPECT_EQ(Said([] { PowerConeConstraint(Identity(3), Vector3d::Zero(), kNaN); }),
            "power cone constraint: alpha needs to be in (0, 1), got nan");
  EXPECT_EQ(Said([&] { LorentzConeConstraint(Identity(2), one); }),
            "Lorentz cone constraint: b needs 2 entries, got 1");
  EXPECT_EQ(Said([] { LorentzConeConstraint(Identity(2), Vector2d(0, kNaN)); }),
            "Lorentz cone constraint: b[1] needs to be finite, got nan");
  EXPECT_EQ(Said([] { PositiveSemidefiniteConstraint(-5); }),
            "positive semidefinite constraint: the matrix needs 1 to 46340 rows, got -5");
  LorentzConeConstraint cone(Identity(2), Vector2d(0, 0));
  EXPECT_EQ(Said([&] { cone.UpdateCoefficients(Identity(3), Vector3d::Zero()); }),
            "Lorentz cone constraint: A needs to be 2 x 2, got 3 x 3");
  EXPECT_EQ(Said([&] { (void)cone.DualInUserFrame(one); }),
            "Lorentz cone constraint: the dual needs 2 entries, got 1");
}

TEST(LinearMatrixInequality, SaysWhichMatrixIsWrong) {
  const MatrixXd I = MatrixXd::Identity(2, 2);
  const auto said = [](const std::vector<MatrixXd>& F) {
    return Said([&] { LinearMatrixInequalityConstraint constraint(F); });
  };
  EXPECT_EQ(said({}), "linear matrix inequality: needs F[0], got no matrix");
  EXPECT_EQ(said({MatrixXd::Zero(2, 3)}),
            "linear matrix inequality: F[0] needs to be 2 x 2, got 2 x 3");
  EXPECT_EQ(said({I, MatrixXd::Identity(3, 3)}),
            "linear matrix inequality: F[1] needs to be 2 x 2, got 3 x 3");
  EXPECT_EQ(said({I, MatrixXd{{1, 2}, {3, 1}}}),
            "linear matrix inequality: F[1] needs to be symmetric, got (0,1) = 2 and (1,0) = 3");
  EXPECT_EQ(said({I, MatrixXd{{1, 2}, {kNaN, 1}}}),
            "linear matrix inequality: F[1](1,0) needs to be finite, got nan");
}

}  // namespace
}  // namespace switchyard
