// switchyard/symbolic/lists.hpp - the arguments "some expressions" and "some formulas".
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <utility>
#include <vector>

#include "switchyard/symbolic/expression.hpp"
#include "switchyard/symbolic/formula.hpp"
#include "switchyard/symbolic/matrices.hpp"

namespace switchyard {

/// One expression, or a vector, matrix or array of expressions, variables or numbers.
class ExpressionList {
 public:
  // NOLINTBEGIN(google-explicit-constructor): an argument type, made to convert
  template <std::convertible_to<Expression> One>
  ExpressionList(One&& one) : all_(1, 1) {
    all_(0, 0) = std::forward<One>(one);
  }
  template <class Derived>
  requires matrices::Entry<typename Derived::Scalar> ExpressionList(
      const Eigen::DenseBase<Derived>& some)
      : all_(some.rows(), some.cols()) {
    for (Eigen::Index j = 0; j < some.cols(); ++j) {
      for (Eigen::Index i = 0; i < some.rows(); ++i) all_(i, j) = some.derived()(i, j);
    }
  }
  ExpressionList(Eigen::MatrixX<Expression>&& some) : all_(std::move(some)) {}
  // NOLINTEND(google-explicit-constructor)

  [[nodiscard]] const Eigen::MatrixX<Expression>& matrix() const { return all_; }
  /// Column by column.
  [[nodiscard]] Eigen::Map<const Eigen::VectorX<Expression>> vector() const {
    return {all_.data(), all_.size()};
  }

 private:
  Eigen::MatrixX<Expression> all_;
};

/// One formula, or several that all are to hold.
class FormulaList {
 public:
  // NOLINTBEGIN(google-explicit-constructor): an argument type, made to convert
  template <std::convertible_to<Formula> One>
  FormulaList(One&& one) {
    all_.push_back(std::forward<One>(one));
  }
  template <class Derived>
  requires std::same_as<typename Derived::Scalar, Formula> FormulaList(
      const Eigen::DenseBase<Derived>& some) {
    for (Eigen::Index j = 0; j < some.cols(); ++j) {
      for (Eigen::Index i = 0; i < some.rows(); ++i) all_.push_back(some.derived()(i, j));
    }
  }
  FormulaList(std::vector<Formula> some) : all_(std::move(some)) {}
  // NOLINTEND(google-explicit-constructor)

  [[nodiscard]] const std::vector<Formula>& formulas() const { return all_; }

 private:
  std::vector<Formula> all_;
};

}  // namespace switchyard
