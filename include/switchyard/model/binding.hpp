// switchyard/model/binding.hpp - an evaluator and the variables that it is applied to.
#pragma once

#include <algorithm>
#include <memory>
#include <type_traits>
#include <utility>

#include "switchyard/model/evaluator.hpp"
#include "switchyard/symbolic/variable.hpp"

namespace switchyard {

/// "linear cost: 2*x(0) + y"; of constraints with their bounds, a row a line; a function by its
/// description and the variables.
SWITCHYARD_EXPORT std::string DescribeBinding(const EvaluatorBase& evaluator,
                                              const VectorXDecisionVariable& variables);

/// A value: copies share the evaluator.
template <class C>
class Binding {
 public:
  /// Throws InvalidArgument where the evaluator takes another number of variables.
  Binding(std::shared_ptr<C> evaluator, const VariableList& variables)
      : evaluator_(std::move(evaluator)), variables_(variables.vector()) {
    Require(evaluator_ != nullptr, "a binding needs an evaluator, got a null pointer");
    if (evaluator_->num_vars() != variables_.size()) {  // Name() is made only where it is said
      Refuse(evaluator_->Name(), " takes ", evaluator_->num_vars(), " variables, got ",
             variables_.size());
    }
  }
  template <class U>
  requires std::is_convertible_v<std::shared_ptr<U>, std::shared_ptr<C>> Binding(
      const Binding<U>& other)  // NOLINT(google-explicit-constructor): to its base
      : evaluator_(other.evaluator()), variables_(other.variables()) {}

  [[nodiscard]] const std::shared_ptr<C>& evaluator() const { return evaluator_; }
  [[nodiscard]] const VectorXDecisionVariable& variables() const { return variables_; }
  [[nodiscard]] std::size_t GetNumElements() const {
    return static_cast<std::size_t>(variables_.size());
  }
  [[nodiscard]] bool ContainsVariable(Variable variable) const {
    return std::find(variables_.begin(), variables_.end(), variable) != variables_.end();
  }

  [[nodiscard]] std::string to_string() const { return DescribeBinding(*evaluator_, variables_); }

  /// The same evaluator, by identity, on the same variables.
  friend bool operator==(const Binding& a, const Binding& b) {
    return a.evaluator_ == b.evaluator_ && std::equal(a.variables_.begin(), a.variables_.end(),
                                                      b.variables_.begin(), b.variables_.end());
  }

 private:
  std::shared_ptr<C> evaluator_;
  VectorXDecisionVariable variables_;
};

template <class C>
Binding<C> CreateBinding(std::shared_ptr<C> evaluator, const VariableList& variables) {
  return Binding<C>(std::move(evaluator), variables);
}

}  // namespace switchyard
