// switchyard/functions/callables.hpp - what a type can be called with, and its answers as plain
// lists and matrices.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "switchyard/error.hpp"
#include "switchyard/functions/function.hpp"
#include "switchyard/functions/traced.hpp"

namespace switchyard::functions_detail {

using Eigen::VectorXd;
using TracedVector = Eigen::VectorX<Traced>;
using AnyMatrix = std::variant<Eigen::MatrixXd, Eigen::SparseMatrix<double>>;

// The parameter of a function that is neither a template nor overloaded; void for others. Asked
// first, because Eigen has an implicit conversion of a vector of any numbers to one of doubles,
// which fails only when it is compiled: std::invocable says yes to it.
template <class C, class R, class X>
std::remove_cvref_t<X> Parameter(R (C::*)(X));
template <class C, class R, class X>
std::remove_cvref_t<X> Parameter(R (C::*)(X) const);
template <class R, class X>
std::remove_cvref_t<X> Parameter(R (*)(X));

template <class F>
struct ParameterOf {
  using type = void;
};
template <class F>
requires requires { Parameter(&F::operator()); }
struct ParameterOf<F> {
  using type = decltype(Parameter(&F::operator()));
};
template <class F>
requires std::is_pointer_v<F>
struct ParameterOf<F> {
  using type = decltype(Parameter(std::declval<F>()));
};

template <class X>
concept OfDoubles = requires {
  requires std::same_as<typename X::Scalar, double>;
};

template <class F, class X>
concept Callable = std::invocable<const F&, const X&> || std::invocable<F&, const X&>;

template <class F>
concept CallableWithTraced = !OfDoubles<typename ParameterOf<F>::type> && Callable<F, TracedVector>;
template <class F>
concept CallableWithDoubles = Callable<F, VectorXd>;
// In this order: a template of Traced numbers alone must not be compiled with doubles.
template <class F>
concept CallableWithAVector = CallableWithTraced<F> || CallableWithDoubles<F>;

template <class F>
concept HasJacobian = requires(F& f, const VectorXd& x) {
  f.Jacobian(x);
};
template <class F>
concept HasGradient = requires(F& f, const VectorXd& x) {
  f.Gradient(x);
};
template <class F>
concept HasHessianOfWeighted = requires(F& f, const VectorXd& x, const VectorXd& w) {
  f.Hessian(x, w);
};
template <class F>
concept HasHessianOfOne = requires(F& f, const VectorXd& x) {
  f.Hessian(x);
};
template <class F>
concept HasHessian = HasHessianOfWeighted<F> || HasHessianOfOne<F>;
template <class F>
concept HasOwnDerivatives = (HasJacobian<F> || HasGradient<F>)&&CallableWithDoubles<F>;

/// All that is called on it can be called while it is constant.
template <class F, class X>
concept CallableWhileConstant = std::invocable<const F&, const X&> && HasJacobian<F>
== HasJacobian<const F>&& HasGradient<F> == HasGradient<const F>&& HasHessianOfWeighted<F> ==
    HasHessianOfWeighted<const F>&& HasHessianOfOne<F> == HasHessianOfOne<const F>;

/// The numbers of an answer: one number, an Eigen vector or array, or what can be iterated.
template <class Number, class Answer>
std::vector<Number> Listed(const Answer& answer) {
  std::vector<Number> list;
  if constexpr (std::is_convertible_v<const Answer&, Number>) {
    list.push_back(answer);
  } else if constexpr (requires { answer.derived().eval(); }) {
    const auto& y = answer.derived().eval();
    Require(y.rows() == 1 || y.cols() == 1, "function: needs to return a vector, got ", y.rows(),
            " x ", y.cols());
    list.reserve(static_cast<std::size_t>(y.size()));
    for (Eigen::Index i = 0; i < y.size(); ++i) list.push_back(y(i));
  } else {
    for (const auto& y : answer) list.push_back(y);
  }
  return list;
}

template <class Answer>
AnyMatrix Matrix(const Answer& answer) {
  if constexpr (std::is_base_of_v<Eigen::SparseMatrixBase<Answer>, Answer>) {
    Eigen::SparseMatrix<double> sparse = answer;
    sparse.makeCompressed();
    return sparse;
  } else {
    return Eigen::MatrixXd(answer);
  }
}

/// A gradient as the one row of a Jacobian.
template <class Answer>
AnyMatrix Row(const Answer& answer) {
  const std::vector<double> list = Listed<double>(answer);
  return Eigen::MatrixXd(
      Eigen::Map<const Eigen::RowVectorXd>(list.data(), static_cast<Eigen::Index>(list.size())));
}

}  // namespace switchyard::functions_detail
