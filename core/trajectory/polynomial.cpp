#include "switchyard/trajectory/polynomial.hpp"

#include "core/trajectory/powers.hpp"
#include "switchyard/error.hpp"

namespace switchyard {

template <class T>
Polynomial<T>::Polynomial(const Eigen::Ref<const Eigen::VectorX<T>>& coefficients)
    : coefficients_(coefficients) {
  Require(coefficients.size() > 0, "a polynomial needs a coefficient or more, got none");
}

template <class T>
T Polynomial<T>::EvaluateUnivariate(const T& x, int derivative_order) const {
  return SumOfPowers<T>(coefficients_.transpose(), x, derivative_order)(0);
}

template <class T>
Polynomial<T> Polynomial<T>::Derivative(int derivative_order) const {
  return Polynomial(DerivativeOfPowers<T>(coefficients_.transpose(), derivative_order).transpose());
}

template <class T>
Polynomial<T> Polynomial<T>::Integral(const T& integration_constant) const {
  Eigen::MatrixX<T> integral = IntegralOfPowers<T>(coefficients_.transpose());
  integral(0, 0) = integration_constant;
  return Polynomial(integral.transpose());
}

template <class T>
bool Polynomial<T>::operator==(const Polynomial& other) const {
  return coefficients_.size() == other.coefficients_.size() && coefficients_ == other.coefficients_;
}

template class Polynomial<double>;

}  // namespace switchyard
