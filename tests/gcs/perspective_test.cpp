// t g(x / t) as a cone: the epigraph's least value is the perspective, for every kind of cost.
#include "core/gcs/perspective.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "switchyard/cones.hpp"

namespace switchyard::testing {
namespace {

double Value(const Cost& cost, const Eigen::VectorXd& x) {
  Eigen::VectorXd y;
  cost.Eval(x, &y);
  return y[0];
}

/// The largest violation of the cone at (t, x, w).
double ConeViolation(const ScaledSet& cone, const Eigen::VectorXd& at) {
  std::vector<double> rows(cone.lower.size(), 0.0);
  std::vector<double> s(static_cast<std::size_t>(cone.F.rows), 0.0);
  MultiplyAdd(cone.A.View(), 1, at.data(), rows.data());
  MultiplyAdd(cone.F.View(), 1, at.data(), s.data());
  double worst = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    worst = std::max({worst, cone.lower[i] - rows[i], rows[i] - cone.upper[i]});
  }
  const double* next = s.data();
  for (const sy_cone& one : cone.cones) {
    worst = std::max(worst, FactsOf(one.kind).violation(next, one.dim, one.parameter));
    next += one.dim;
  }
  return worst;
}

/// cost'(t, x, w) + |Sx|^2 / (2t).
double Total(const Perspective& p, const Eigen::VectorXd& at) {
  double sum = 0;
  for (std::size_t j = 0; j < p.cost.size(); ++j)
    sum += p.cost[j] * at[static_cast<Eigen::Index>(j)];
  if (p.S.rows == 0) return sum;
  Eigen::VectorXd Sx = Eigen::VectorXd::Zero(p.S.rows);
  MultiplyAdd(p.S.View(), 1, at.data() + 1, Sx.data());
  return sum + Sx.squaredNorm() / (2 * at[0]);
}

struct Kind {
  std::shared_ptr<Cost> cost;
  bool one_epigraph_each;
};

std::vector<Kind> OneOfEach(std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  const auto random = [&](int r, int c) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(r, c, [&] { return normal(engine); }));
  };
  const Eigen::MatrixXd A = random(3, 4);
  const Eigen::VectorXd b = random(3, 1);
  return {{std::make_shared<LinearCost>(Eigen::VectorXd(random(4, 1)), 0.7), false},
          {std::make_shared<QuadraticCost>(Eigen::MatrixXd(A.transpose() * A),
                                           Eigen::VectorXd(random(4, 1)), 0.3),
           false},
          {std::make_shared<L2NormCost>(A, b), false},
          {std::make_shared<L2NormCost>(Eigen::MatrixXd(A.topRows(1)), Eigen::VectorXd(b.head(1))),
           false},
          {std::make_shared<L1NormCost>(A, b), true},
          {std::make_shared<LInfNormCost>(A, b), false}};
}

TEST(Perspective, HasThePerspectiveAsItsLeastValue) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> scale(0.05, 3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 50; ++trial) {
    for (const Kind& kind : OneOfEach(engine)) {
      const Perspective p = PerspectiveOf(*kind.cost);
      const double t = scale(engine);
      const Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(4, [&] { return normal(engine); });
      const double expected = t * Value(*kind.cost, x / t);
      Eigen::VectorXd at(p.cone.num_columns());
      at[0] = t;
      at.segment(1, 4) = x;
      if (kind.one_epigraph_each) {
        const auto& norm = dynamic_cast<const NormCost&>(*kind.cost);
        at.tail(p.cone.num_aux) = (norm.A() * x + norm.b() * t).cwiseAbs();
      } else if (p.cone.num_aux == 1) {
        at.tail(1).setConstant(expected);
      }
      EXPECT_NEAR(Total(p, at), expected, 1e-12 * (1 + std::abs(expected))) << kind.cost->Kind();
      EXPECT_LE(ConeViolation(p.cone, at), 1e-12 * (1 + std::abs(expected)));
      if (p.cone.num_aux == 0) continue;
      at.tail(1) *= 0.99;  // any less is outside
      EXPECT_GT(ConeViolation(p.cone, at), 1e-6) << kind.cost->Kind();
    }
  }
}

TEST(Perspective, RefusesWhatIsNotConvex) {
  const QuadraticCost saddle(Eigen::Vector2d(1, -1).asDiagonal().toDenseMatrix(),
                             Eigen::Vector2d::Zero());
  EXPECT_THROW(PerspectiveOf(saddle), InvalidArgument);
}

}  // namespace
}  // namespace switchyard::testing
