// tests/trajectory/curves.hpp - random curves, and derivatives by differences to hold theirs to.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "switchyard/trajectory/trajectory.hpp"

namespace switchyard::testing {

class RandomCurves {
 public:
  explicit RandomCurves(unsigned seed) : generator_(seed) {}

  double Number(double lower = -1, double upper = 1) {
    return std::uniform_real_distribution<double>(lower, upper)(generator_);
  }
  Eigen::MatrixXd Matrix(Eigen::Index rows, Eigen::Index cols) {
    return Eigen::MatrixXd::NullaryExpr(rows, cols, [this] { return Number(); });
  }
  std::vector<Eigen::MatrixXd> Matrices(int count, Eigen::Index rows, Eigen::Index cols) {
    std::vector<Eigen::MatrixXd> matrices;
    for (int i = 0; i < count; ++i) matrices.push_back(Matrix(rows, cols));
    return matrices;
  }
  /// `count` numbers in order, the first and the last given.
  std::vector<double> Times(int count, double first, double last) {
    std::vector<double> times = {first, last};
    while (static_cast<int>(times.size()) < count) times.push_back(Number(first, last));
    std::sort(times.begin(), times.end());
    return times;
  }

 private:
  std::mt19937_64 generator_;
};

inline double Distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  EXPECT_EQ(a.rows(), b.rows());
  EXPECT_EQ(a.cols(), b.cols());
  return a.size() == 0 ? 0 : (a - b).cwiseAbs().maxCoeff();
}

/// Each derivative up to `orders` against differences of the one before, at inner times where the
/// curve is smooth on [t - h, t + h].
inline void ExpectDerivativesOfDifferences(const Trajectory<double>& curve, int orders,
                                           const std::vector<double>& times, double tolerance) {
  constexpr double h = 1e-5;
  for (int k = 1; k <= orders; ++k) {
    const auto made = curve.MakeDerivative(k);
    for (const double t : times) {
      const Eigen::MatrixXd difference =
          (curve.EvalDerivative(t + h, k - 1) - curve.EvalDerivative(t - h, k - 1)) / (2 * h);
      const double scale = 1 + difference.cwiseAbs().maxCoeff();
      EXPECT_LE(Distance(curve.EvalDerivative(t, k), difference), tolerance * scale)
          << "order " << k << " at " << t;
      EXPECT_LE(Distance(made->value(t), curve.EvalDerivative(t, k)), 1e-11 * scale)
          << "order " << k << " at " << t;
    }
  }
}

/// The same values at many times, at the ends and outside of them.
inline void ExpectSameCurve(const Trajectory<double>& a, const Trajectory<double>& b,
                            double tolerance) {
  ASSERT_NEAR(a.start_time(), b.start_time(), tolerance);
  ASSERT_NEAR(a.end_time(), b.end_time(), tolerance);
  const double length = a.end_time() - a.start_time();
  for (int i = -1; i <= 51; ++i) {
    const double t = a.start_time() + length * i / 50;
    EXPECT_LE(Distance(a.value(t), b.value(t)), tolerance) << "at " << t;
  }
}

}  // namespace switchyard::testing
