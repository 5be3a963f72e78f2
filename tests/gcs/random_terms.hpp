// Costs and constraints of every type on a point.
#pragma once

#include <memory>
#include <vector>

#include "switchyard/model/constraint.hpp"
#include "switchyard/model/cost.hpp"
#include "switchyard/model/function_terms.hpp"
#include "tests/gcs/random_draw.hpp"

namespace switchyard::testing {

class RandomTerms {
 public:
  explicit RandomTerms(Draw& draw) : draw_(draw) {}

  /// About `fee` at a point.
  std::shared_ptr<Cost> LinearWith(double fee, const Eigen::VectorXd& at) {
    const Eigen::VectorXd a = draw_.Vector(N(at), 0.5);
    return std::make_shared<LinearCost>(a, fee - a.dot(at) + draw_.Uniform(-0.3, 0.3));
  }
  /// `at`: where a perspective quadratic's denominator is 4.
  std::shared_ptr<Cost> AnyCost(const Eigen::VectorXd& at, bool polyhedral) {
    const int n = N(at), rows = draw_.Integer(1, 3);
    const int kind = n == 0 ? 0 : draw_.Integer(0, polyhedral ? 2 : 5);
    const auto A = [&] { return draw_.Matrix(rows, n); };
    switch (kind) {
      case 1:
        return std::make_shared<L1NormCost>(A(), draw_.Vector(rows));
      case 2:
        return std::make_shared<LInfNormCost>(A(), draw_.Vector(rows));
      case 3:
        return std::make_shared<L2NormCost>(A(), draw_.Vector(rows));
      case 4: {
        const Eigen::MatrixXd S = A();
        return std::make_shared<QuadraticCost>(S.transpose() * S, draw_.Vector(n), 0.5);
      }
      case 5: {
        Eigen::MatrixXd Z(rows + 1, n);
        Z << draw_.Matrix(1, n, 0.2), A();
        Eigen::VectorXd b = draw_.Vector(rows + 1);
        b[0] = 4 - Z.row(0).dot(at);
        return std::make_shared<PerspectiveQuadraticCost>(Z, b);
      }
      default:
        return LinearWith(0.6, at);
    }
  }

  /// Between the halves of x, in R^2n: what lets a relaxation send its flow around in circles.
  std::shared_ptr<Cost> Distance(int n, bool polyhedral) {
    Eigen::MatrixXd A(n, 2 * n);
    A << -Eigen::MatrixXd::Identity(n, n), Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
    if (polyhedral) return std::make_shared<L1NormCost>(A, zero);
    if (draw_.Chance(0.5)) return std::make_shared<L2NormCost>(A, zero);
    return std::make_shared<QuadraticCost>(2 * A.transpose() * A, Eigen::VectorXd::Zero(2 * n));
  }

  /// One that holds at a point (with n > 0 entries), most of them around it too.
  std::shared_ptr<Constraint> AnyConstraint(const Eigen::VectorXd& at, bool polyhedral) {
    using Make = std::shared_ptr<Constraint> (RandomTerms::*)(const Eigen::VectorXd&);
    static const std::vector<Make> flat = {&RandomTerms::OneSided, &RandomTerms::TwoSided,
                                           &RandomTerms::Equality, &RandomTerms::Bounds};
    static const std::vector<Make> round = {&RandomTerms::Lorentz, &RandomTerms::Rotated,
                                            &RandomTerms::Matrix,  &RandomTerms::Exponential,
                                            &RandomTerms::Power,   &RandomTerms::Quadratic};
    const int count = static_cast<int>(flat.size() + (polyhedral ? 0 : round.size()));
    const auto k = static_cast<std::size_t>(draw_.Integer(0, count - 1));
    return (this->*(k < flat.size() ? flat[k] : round[k - flat.size()]))(at);
  }

 private:
  using One = std::shared_ptr<Constraint>;

  One OneSided(const Eigen::VectorXd& p) {
    const Eigen::MatrixXd A = draw_.Matrix(2, N(p));
    const Eigen::VectorXd open = Eigen::VectorXd::Constant(2, kInfinity);
    const Eigen::VectorXd side = A * p + draw_.Radii(2);
    if (draw_.Chance(0.5)) return std::make_shared<LinearConstraint>(A, -open, side);
    return std::make_shared<LinearConstraint>(-A, -side, open);
  }
  One TwoSided(const Eigen::VectorXd& p) {
    const Eigen::MatrixXd A = draw_.Matrix(2, N(p));
    const Eigen::VectorXd middle = A * p;
    return std::make_shared<LinearConstraint>(A, middle - draw_.Radii(2), middle + draw_.Radii(2));
  }
  One Equality(const Eigen::VectorXd& p) {
    const Eigen::MatrixXd A = draw_.Matrix(1, N(p));
    return std::make_shared<LinearEqualityConstraint>(A, A * p);
  }
  One Bounds(const Eigen::VectorXd& p) {
    return std::make_shared<BoundingBoxConstraint>(p - draw_.Radii(N(p)), p + draw_.Radii(N(p)));
  }
  /// |M (x - p)| <= 1 + c'(x - p).
  One Lorentz(const Eigen::VectorXd& p) {
    Eigen::MatrixXd A(3, N(p));
    A << draw_.Matrix(1, N(p), 0.2), draw_.Matrix(2, N(p));
    return std::make_shared<LorentzConeConstraint>(A, Eigen::Vector3d(1, 0, 0) - A * p);
  }
  /// |M (x - p)|^2 <= (1 + c'(x - p)) (0.5 + d'(x - p)).
  One Rotated(const Eigen::VectorXd& p) {
    Eigen::MatrixXd A(4, N(p));
    A << draw_.Matrix(2, N(p), 0.2), draw_.Matrix(2, N(p));
    return std::make_shared<RotatedLorentzConeConstraint>(A, Eigen::Vector4d(1, 0.5, 0, 0) - A * p);
  }
  One Matrix(const Eigen::VectorXd& p) {
    std::vector<Eigen::MatrixXd> F(static_cast<std::size_t>(N(p)) + 1);
    F[0] = Eigen::Matrix3d::Identity();
    for (int i = 0; i < N(p); ++i) {
      const Eigen::MatrixXd M = draw_.Matrix(3, 3, 0.5);
      F[static_cast<std::size_t>(i) + 1] = M + M.transpose();
      F[0] -= p[i] * (M + M.transpose());
    }
    return std::make_shared<LinearMatrixInequalityConstraint>(F);
  }
  /// exp(a'(x - p)) <= 1.5 + c'(x - p).
  One Exponential(const Eigen::VectorXd& p) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3, N(p));
    A.row(0) = draw_.Matrix(1, N(p), 0.3);
    A.row(2) = draw_.Matrix(1, N(p));
    return std::make_shared<ExponentialConeConstraint>(A, Eigen::Vector3d(1.5, 1, 0) - A * p);
  }
  /// |a'(x - p)| <= (1 + c'(x - p))^alpha (1 + d'(x - p))^(1 - alpha).
  One Power(const Eigen::VectorXd& p) {
    Eigen::MatrixXd A(3, N(p));
    A << draw_.Matrix(2, N(p), 0.3), draw_.Matrix(1, N(p));
    return std::make_shared<PowerConeConstraint>(A, Eigen::Vector3d(1, 1, 0) - A * p,
                                                 draw_.Uniform(0.2, 0.8));
  }
  /// 1/2 x'Qx + b'x at most 1/2 more than at p, where it is least.
  One Quadratic(const Eigen::VectorXd& p) {
    const Eigen::MatrixXd S = draw_.Matrix(2, N(p));
    const Eigen::MatrixXd Q = S.transpose() * S;
    return std::make_shared<QuadraticConstraint>(Q, -Q * p, -kInfinity, 0.5 - 0.5 * p.dot(Q * p));
  }
  static int N(const Eigen::VectorXd& p) { return static_cast<int>(p.size()); }

  Draw& draw_;
};

}  // namespace switchyard::testing
