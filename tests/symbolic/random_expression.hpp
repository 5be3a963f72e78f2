// tests/symbolic/random_expression.hpp - a random expression beside the same arithmetic on doubles.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "switchyard/symbolic/formula.hpp"

namespace switchyard {

struct WithValue {
  Expression e;
  double value;
};

/// Makes expressions in variables 1, 2, ... whose values it drew; all stay defined and moderate.
class RandomExpressions {
 public:
  RandomExpressions(unsigned seed, int num_vars) : random_(seed) {
    for (int i = 0; i < num_vars; ++i) {
      x_.emplace_back(i + 1);
      values_[x_.back()] = Uniform(-2, 2);
    }
  }

  [[nodiscard]] const Expression::Values& values() const { return values_; }
  [[nodiscard]] const std::vector<Variable>& variables() const { return x_; }

  WithValue Make(int depth) {
    if (depth == 0) return Leaf();
    const WithValue a = Make(depth - 1);
    const WithValue b = Make(depth - 1 - Int(2) * (depth > 1));
    switch (Int(14)) {
      case 0:
        return {a.e + b.e, a.value + b.value};
      case 1:
        return {a.e - b.e, a.value - b.value};
      case 2:
        return {a.e * sin(b.e), a.value * std::sin(b.value)};
      case 3:
        return {a.e / (2 + cos(b.e)), a.value / (2 + std::cos(b.value))};
      case 4:
        return {pow(sin(a.e), 3), std::pow(std::sin(a.value), 3)};
      case 5:
        return {sqrt(1 + sin(a.e) * sin(a.e)), std::sqrt(1 + std::pow(std::sin(a.value), 2))};
      case 6:
        return {exp(cos(a.e)) + tanh(b.e), std::exp(std::cos(a.value)) + std::tanh(b.value)};
      case 7:
        return {log(2 + sin(a.e)), std::log(2 + std::sin(a.value))};
      case 8:
        return {max(a.e, b.e) - abs(a.e), std::max(a.value, b.value) - std::abs(a.value)};
      case 9:
        return {min(a.e, b.e), std::min(a.value, b.value)};
      case 10:
        return {atan2(a.e, 3 + cos(b.e)), std::atan2(a.value, 3 + std::cos(b.value))};
      case 11:
        return {if_then_else(a.e <= b.e, a.e + 1, b.e), a.value <= b.value ? a.value + 1 : b.value};
      case 12:
        return {if_then_else(a.e > 0 && !(b.e > 1), 2 * a.e, -b.e),
                a.value > 0 && !(b.value > 1) ? 2 * a.value : -b.value};
      default:
        return {2.5 * a.e - b.e / 4, 2.5 * a.value - b.value / 4};
    }
  }

 private:
  WithValue Leaf() {
    if (Int(4) == 0) {
      const double c = Uniform(-2, 2);
      return {c, c};
    }
    const Variable v = x_[static_cast<std::size_t>(Int(static_cast<int>(x_.size())))];
    const double c = Uniform(-1, 1);
    return {c * v, c * values_[v]};
  }
  double Uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }
  int Int(int n) { return std::uniform_int_distribution<>(0, n - 1)(random_); }

  std::mt19937 random_;
  std::vector<Variable> x_;
  Expression::Values values_;
};

}  // namespace switchyard
