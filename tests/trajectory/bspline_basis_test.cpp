// B-splines by what defines them: support, sign, sum, smoothness, derivatives.
#include "switchyard/trajectory/bspline_basis.hpp"

#include <cmath>

#include "switchyard/model/new_ids.hpp"
#include "switchyard/symbolic/matrices.hpp"
#include "tests/model/said.hpp"
#include "tests/trajectory/curves.hpp"

namespace switchyard::testing {
namespace {

// The recurrence as it is defined, top down, with 0/0 = 0.
double CoxDeBoor(const std::vector<double>& knots, std::size_t i, std::size_t order, double t) {
  if (order == 1) return knots[i] <= t && t < knots[i + 1] ? 1 : 0;
  const auto part = [](double over, double under) { return under > 0 ? over / under : 0; };
  return part(t - knots[i], knots[i + order - 1] - knots[i]) * CoxDeBoor(knots, i, order - 1, t) +
         part(knots[i + order] - t, knots[i + order] - knots[i + 1]) *
             CoxDeBoor(knots, i + 1, order - 1, t);
}

// Of order k over [0, 2]: even, clamped, random, and with a knot twice.
std::vector<BsplineBasis<double>> Bases(int k, RandomCurves* random) {
  std::vector<double> double_knot =
      BsplineBasis<double>(k, k + 3, KnotVectorType::kUniform, 0, 2).knots();
  double_knot[static_cast<std::size_t>(k)] = double_knot[static_cast<std::size_t>(k) + 1];
  std::vector<double> uneven;
  for (int i = 0; i < 2 * k + 5; ++i) uneven.push_back(0.2 * i - 1 + random->Number(0, 0.15));
  return {BsplineBasis<double>(k, k + 3, KnotVectorType::kUniform, 0, 2),
          BsplineBasis<double>(k, k + 3, KnotVectorType::kClampedUniform, 0, 2),
          BsplineBasis<double>(k, k), BsplineBasis<double>(k, uneven),
          BsplineBasis<double>(k, double_knot)};
}

std::vector<double> TimesIn(const BsplineBasis<double>& basis) {
  std::vector<double> times;
  const double start = basis.initial_parameter_value();
  const double length = basis.final_parameter_value() - start;
  for (int i = 0; i <= 20; ++i) times.push_back(start + length * i / 20.001);
  return times;
}

TEST(BsplineBasis, IsNonnegativeSumsToOneAndFollowsItsRecurrence) {
  RandomCurves random(1);
  for (int k = 1; k <= 5; ++k) {
    for (const auto& basis : Bases(k, &random)) {
      EXPECT_EQ(basis.num_basis_functions() + k, static_cast<int>(basis.knots().size()));
      for (const double t : TimesIn(basis)) {
        const Eigen::VectorXd all = basis.EvaluateLinearInControlPoints(t);
        EXPECT_GE(all.minCoeff(), 0);
        EXPECT_NEAR(all.sum(), 1, 1e-14);
        for (int i = 0; i < all.size(); ++i) {
          EXPECT_NEAR(
              all(i),
              CoxDeBoor(basis.knots(), static_cast<std::size_t>(i), static_cast<std::size_t>(k), t),
              1e-14);
          EXPECT_EQ(basis.EvaluateBasisFunctionI(i, t), all(i));
        }
      }
    }
  }
}

TEST(BsplineBasis, KnowsWhichFunctionsAreNotZero) {
  RandomCurves random(2);
  for (int k = 1; k <= 4; ++k) {
    for (const auto& basis : Bases(k, &random)) {
      for (const double t : TimesIn(basis)) {
        const std::vector<int> active = basis.ComputeActiveBasisFunctionIndices(t);
        ASSERT_EQ(static_cast<int>(active.size()), k);
        const int interval = basis.FindContainingInterval(t);
        EXPECT_EQ(active.back(), interval);
        EXPECT_LE(basis.knots()[static_cast<std::size_t>(interval)], t);
        EXPECT_LT(t, basis.knots()[static_cast<std::size_t>(interval) + 1]);
        for (int i = 0; i < basis.num_basis_functions(); ++i) {
          if (i < active.front() || i > active.back()) {
            EXPECT_EQ(basis.EvaluateBasisFunctionI(i, t), 0);
          }
        }
      }
      const std::array<double, 2> all = {basis.initial_parameter_value(),
                                         basis.final_parameter_value()};
      EXPECT_EQ(static_cast<int>(basis.ComputeActiveBasisFunctionIndices(all).size()),
                basis.num_basis_functions());
    }
  }
}

TEST(BsplineBasis, OfEvenKnotsIsWhereItShouldBe) {
  const BsplineBasis<double> uniform(3, 5, KnotVectorType::kUniform, 0, 3);
  EXPECT_EQ(uniform.knots(), (std::vector<double>{-2, -1, 0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(uniform.initial_parameter_value(), 0);
  EXPECT_EQ(uniform.final_parameter_value(), 3);
  const BsplineBasis<double> clamped(3, 5, KnotVectorType::kClampedUniform, 0, 3);
  EXPECT_EQ(clamped.knots(), (std::vector<double>{0, 0, 0, 1, 2, 3, 3, 3}));
  EXPECT_EQ(clamped.EvaluateBasisFunctionI(0, 0), 1);
  EXPECT_EQ(clamped.EvaluateBasisFunctionI(4, 3), 1);
  EXPECT_EQ(clamped.EvaluateBasisFunctionI(4, 7), 1);
  EXPECT_EQ(clamped.FindContainingInterval(3), 4);
  EXPECT_TRUE(clamped == BsplineBasis<double>(3, {0, 0, 0, 1, 2, 3, 3, 3}));
  EXPECT_TRUE(clamped != uniform);
}

TEST(BsplineBasis, HasDerivativesByDifferencesAndByItsMap) {
  RandomCurves random(3);
  constexpr double h = 1e-6;
  for (int k = 1; k <= 5; ++k) {
    for (const auto& basis : Bases(k, &random)) {
      for (int j = 1; j <= k + 1; ++j) {
        const Eigen::MatrixXd map = basis.DerivativeMap(j);
        ASSERT_EQ(map.rows(), basis.num_basis_functions());
        ASSERT_EQ(map.cols(), j < k ? basis.num_basis_functions() - j : 0);
        for (const double t : TimesIn(basis)) {
          const Eigen::VectorXd derivative = basis.EvaluateLinearInControlPoints(t, j);
          const double scale = 1 + derivative.cwiseAbs().maxCoeff();
          if (j >= k) {
            EXPECT_EQ(derivative, Eigen::VectorXd::Zero(map.rows()));
            continue;
          }
          const BsplineBasis<double> lower = basis.DerivativeBasis(j);
          EXPECT_LE(Distance(map * lower.EvaluateLinearInControlPoints(t), derivative),
                    1e-13 * scale);
          if (t - h < basis.initial_parameter_value() || t + h > basis.final_parameter_value() ||
              basis.FindContainingInterval(t - h) != basis.FindContainingInterval(t + h)) {
            continue;
          }
          const Eigen::VectorXd difference = (basis.EvaluateLinearInControlPoints(t + h, j - 1) -
                                              basis.EvaluateLinearInControlPoints(t - h, j - 1)) /
                                             (2 * h);
          // Rounding over the step, and the step squared times two derivatives more.
          const double room = 1e-9 * (1 + basis.EvaluateLinearInControlPoints(t, j - 1).norm()) +
                              h * h * basis.EvaluateLinearInControlPoints(t, j + 2).norm();
          EXPECT_LE(Distance(difference, derivative), room + 1e-9 * scale);
        }
      }
    }
  }
}

TEST(BsplineBasis, CombinesControlPointsOfAnyKind) {
  const BsplineBasis<double> basis(3, 4);
  const Eigen::VectorXd weights = basis.EvaluateLinearInControlPoints(0.3);
  EXPECT_NEAR(basis.EvaluateCurve(std::vector<double>{1, 2, 3, 4}, 0.3),
              weights.dot(Eigen::Vector4d(1, 2, 3, 4)), 1e-15);
  std::vector<Eigen::VectorX<Expression>> points;
  const Variable::Id first = NewVariableIds(4);
  Expression::Values values;
  for (int i = 0; i < 4; ++i) {
    points.push_back(Eigen::VectorX<Expression>::Constant(2, Expression(Variable(first + i))));
    values[Variable(first + i)] = i + 1;
  }
  const Eigen::VectorX<Expression> curve = basis.EvaluateCurve(points, 0.3);
  ASSERT_EQ(curve.size(), 2);
  EXPECT_NEAR(curve(1).Evaluate(values), weights.dot(Eigen::Vector4d(1, 2, 3, 4)), 1e-15);
}

TEST(BsplineBasis, SaysWhatACallerGotWrong) {
  using Basis = BsplineBasis<double>;
  EXPECT_EQ(Said([] {
              Basis(0, {0.0, 1.0});
            }),
            "the order of a B-spline basis needs to be 1 or more, got 0");
  EXPECT_EQ(Said([] {
              Basis(2, {0.0, 1.0, 2.0});
            }),
            "a B-spline basis of order 2 needs 4 knots or more, got 3");
  EXPECT_EQ(Said([] { Basis(1, {0.0, 2.0, 1.0}); }), "knots: knots[2] = 1 is below knots[1] = 2");
  EXPECT_EQ(Said([] {
              Basis(2, {0.0, 1.0, 1.0, 2.0});
            }),
            "a B-spline basis of order 2 needs knots[2] above knots[1], got 1 for both");
  EXPECT_EQ(Said([] { Basis(4, 3); }),
            "a B-spline basis of order 4 needs 4 functions or more, got 3");
  EXPECT_EQ(Said([] { (void)Basis(2, 3).FindContainingInterval(1.5); }),
            "a parameter from 0 to 1 is needed, got 1.5");
  EXPECT_EQ(Said([] { (void)Basis(2, 3).EvaluateBasisFunctionI(3, 0); }),
            "the number of a basis function needs to be from 0 to 2, got 3");
  EXPECT_EQ(Said([] {
              (void)Basis(2, 3).EvaluateCurve(std::vector<double>{1, 2}, 0);
            }),
            "EvaluateCurve needs 3 control points, one for each basis function, got 2");
}

}  // namespace
}  // namespace switchyard::testing
