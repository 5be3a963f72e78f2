// switchyard/functions/make_function.hpp - a Function of what a caller wrote.
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "switchyard/error.hpp"
#include "switchyard/export.hpp"
#include "switchyard/functions/callables.hpp"
#include "switchyard/functions/function.hpp"
#include "switchyard/functions/function_options.hpp"
#include "switchyard/functions/traced.hpp"

namespace switchyard {

/// A function of Traced numbers by its operations. Where it decides by no value, they are recorded
/// and compiled once. Where it does, they are recorded anew at every point, which is correct there
/// and many times slower; the operations of the last few different recordings stay compiled.
SWITCHYARD_EXPORT std::shared_ptr<const Function> FunctionByTracing(
    int num_vars, std::function<std::vector<Traced>(const Eigen::VectorX<Traced>&)> f,
    const FunctionOptions& options);

/// What a caller's function of doubles can answer. Without a Jacobian it has no Hessian either.
struct PlainFunction {
  std::function<std::vector<double>(const Eigen::VectorXd&)> values;
  std::function<functions_detail::AnyMatrix(const Eigen::VectorXd&)> jacobian;
  std::function<functions_detail::AnyMatrix(const Eigen::VectorXd&, const Eigen::VectorXd& weights)>
      hessian;
};
SWITCHYARD_EXPORT std::shared_ptr<const Function> FunctionAsItIs(int num_vars, PlainFunction f,
                                                                 const FunctionOptions& options);

namespace functions_detail {

template <class Self>
PlainFunction PlainFunctionOf(const std::shared_ptr<Self>& f) {
  PlainFunction plain;
  plain.values = [f](const VectorXd& x) { return Listed<double>((*f)(x)); };
  if constexpr (HasJacobian<Self>) {
    plain.jacobian = [f](const VectorXd& x) { return Matrix(f->Jacobian(x)); };
  } else if constexpr (HasGradient<Self>) {
    plain.jacobian = [f](const VectorXd& x) { return Row(f->Gradient(x)); };
  }
  if constexpr (HasHessianOfWeighted<Self>) {
    plain.hessian = [f](const VectorXd& x, const VectorXd& w) { return Matrix(f->Hessian(x, w)); };
  } else if constexpr (HasHessianOfOne<Self>) {
    plain.hessian = [f](const VectorXd& x, const VectorXd& w) {
      Require(w.size() == 1, "function: Hessian(x) is for one output and this one has ", w.size(),
              "; give Hessian(x, weights)");
      return Matrix(w[0] * f->Hessian(x));
    };
  }
  return plain;
}

template <class Self>
FunctionOptions WithItsPatterns(const Self& f, FunctionOptions options) {
  if constexpr (requires { f.JacobianPattern(); }) {
    if (!options.jacobian) options.jacobian = f.JacobianPattern();
  }
  if constexpr (requires { f.HessianPattern(); }) {
    if (!options.hessian) options.hessian = f.HessianPattern();
  }
  return options;
}

// Constant where all calls can be: then the overloads for constants are called.
template <class X, class F>
auto Shared(F f, const FunctionOptions& options) {
  if constexpr (CallableWhileConstant<F, X>) {
    return std::make_shared<const F>(std::move(f));
  } else {
    Require(!options.is_thread_safe,
            "function: a call that is not const needs the option is_thread_safe = false");
    return std::make_shared<F>(std::move(f));
  }
}

}  // namespace functions_detail

/// The Function R^num_vars -> R^m that f computes. What f answers, one number, a vector of Eigen or
/// a std::vector, says m; it is found by a call at the probe (see FunctionOptions), and every later
/// answer needs the same length.
///
///   f can be called with                         then derivatives are
///   const VectorXd&, and has                     its own, as they are, for every place or those
///   that
///     Jacobian(x), or Gradient(x) for m = 1,     the options or its members JacobianPattern() and
///     and maybe Hessian(x, weights),             HessianPattern() declare; matrices are dense or
///     or Hessian(x) for m = 1                    Eigen::SparseMatrix<double>
///   const VectorX<Traced>& (auto, a template)    exact and sparse, by its operations
///   const VectorXd&                              none
///
/// Numbers outside a declared pattern, matrices of another shape and Hessians that are not
/// symmetric are InvalidArgument when they are met. What f throws passes through.
template <class F>
std::shared_ptr<const Function> MakeFunction(int num_vars, F f, FunctionOptions options = {}) {
  using namespace functions_detail;
  static_assert(CallableWithAVector<F>,
                "f needs to be callable with Eigen::VectorXd or Eigen::VectorX<Traced>");
  if constexpr (HasOwnDerivatives<F> || !CallableWithTraced<F>) {
    static_assert(HasOwnDerivatives<F> || !HasHessian<F>, "a Hessian needs a Jacobian beside it");
    const auto shared = Shared<VectorXd>(std::move(f), options);
    options = WithItsPatterns(*shared, std::move(options));
    return FunctionAsItIs(num_vars, PlainFunctionOf(shared), options);
  } else {
    const auto shared = Shared<TracedVector>(std::move(f), options);
    return FunctionByTracing(
        num_vars, [shared](const TracedVector& x) { return Listed<Traced>((*shared)(x)); },
        options);
  }
}

}  // namespace switchyard
