// Numbers that a seed decides.
#pragma once

#include <Eigen/Core>
#include <random>

namespace switchyard::testing {

class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}

  double Uniform(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(engine_);
  }
  bool Chance(double probability) { return Uniform(0, 1) < probability; }
  /// In [a, b].
  int Integer(int a, int b) { return std::uniform_int_distribution<int>(a, b)(engine_); }
  Eigen::VectorXd Vector(int n, double size = 1) {
    return Eigen::VectorXd::NullaryExpr(n, [&] { return Uniform(-size, size); });
  }
  Eigen::MatrixXd Matrix(int rows, int cols, double size = 1) {
    return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return Uniform(-size, size); });
  }
  /// Each in [0.2, 1].
  Eigen::VectorXd Radii(int n) {
    return Eigen::VectorXd::NullaryExpr(n, [&] { return Uniform(0.2, 1); });
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace switchyard::testing
