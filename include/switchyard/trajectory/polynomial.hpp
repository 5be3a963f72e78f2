// switchyard/trajectory/polynomial.hpp - a polynomial of one variable by its coefficients.
#pragma once

#include <Eigen/Core>
#include <type_traits>

#include "switchyard/export.hpp"

namespace switchyard {

/// c_0 + c_1 x + ... + c_n x^n. Coefficients are kept as they are given: the last may be 0.
template <class T>
class SWITCHYARD_EXPORT Polynomial final {
  static_assert(std::is_same_v<T, double>, "a polynomial has T = double");

 public:
  Polynomial() : Polynomial(T(0)) {}
  // NOLINTNEXTLINE(google-explicit-constructor): a number is a polynomial
  Polynomial(const T& constant) : coefficients_(Eigen::VectorX<T>::Constant(1, constant)) {}
  /// (c_0, ..., c_n). Throws InvalidArgument where there is none.
  explicit Polynomial(const Eigen::Ref<const Eigen::VectorX<T>>& coefficients);

  [[nodiscard]] int GetDegree() const { return static_cast<int>(coefficients_.size()) - 1; }
  [[nodiscard]] const Eigen::VectorX<T>& GetCoefficients() const { return coefficients_; }
  /// The value at x, or that of a derivative of an order >= 0.
  [[nodiscard]] T EvaluateUnivariate(const T& x, int derivative_order = 0) const;
  [[nodiscard]] Polynomial Derivative(int derivative_order = 1) const;
  /// The antiderivative that is integration_constant at 0.
  [[nodiscard]] Polynomial Integral(const T& integration_constant = 0) const;
  [[nodiscard]] bool operator==(const Polynomial& other) const;

 private:
  Eigen::VectorX<T> coefficients_;
};

extern template class Polynomial<double>;

}  // namespace switchyard
