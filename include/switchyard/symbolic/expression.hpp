// switchyard/symbolic/expression.hpp - a formula for a number: a constant, multiples of variables,
// multiples of nonlinear terms.
#pragma once

#include <concepts>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/symbolic/variable.hpp"

namespace switchyard {

class ExpressionNode;

/// constant + sum of coefficient * variable + sum of coefficient * node, where a node is a product,
/// a quotient, a power or an elementary function of expressions. A value; nodes are shared and do
/// not change.
///
/// Linear arithmetic appends terms; those of one variable are added up when the list has doubled
/// since they last were, and wherever an expression is read (printed, compared, made a matrix).
/// Only what is free is simplified: operations on constants, 0 * e, 1 * e, e * e to e^2.
class SWITCHYARD_EXPORT Expression {
 public:
  struct LinearTerm {
    Variable variable;
    double coefficient = 0;
  };
  struct NonlinearTerm {
    std::shared_ptr<const ExpressionNode> node;
    double coefficient = 0;
  };
  using Values = std::unordered_map<Variable, double>;
  using Substitution = std::unordered_map<Variable, Expression>;

  // NOLINTBEGIN(google-explicit-constructor): numbers, variables and 1 x 1 matrices are expressions
  Expression() = default;
  Expression(double constant) : constant_(constant) {}
  Expression(Variable variable) : linear_{{variable, 1.0}} {}
  template <class Derived>
  requires(Derived::SizeAtCompileTime == 1 &&
           std::convertible_to<typename Derived::Scalar, Expression>)
      Expression(const Eigen::MatrixBase<Derived>& matrix)
      : Expression(matrix(0, 0)) {}
  // NOLINTEND(google-explicit-constructor)
  /// coefficient * node.
  Expression(double coefficient, std::shared_ptr<const ExpressionNode> node)
      : nonlinear_{{std::move(node), coefficient}} {}

  [[nodiscard]] double constant() const { return constant_; }
  /// As they were appended: a variable may stand several times.
  [[nodiscard]] const std::vector<LinearTerm>& linear() const { return linear_; }
  [[nodiscard]] const std::vector<NonlinearTerm>& nonlinear() const { return nonlinear_; }
  /// Each variable once, where it first stands; those whose terms cancel are left out.
  [[nodiscard]] std::vector<LinearTerm> MergedLinear() const;

  /// Without variables, those that cancel aside.
  [[nodiscard]] bool is_constant() const;
  /// Each variable once, in the order of their first appearance: linear terms, then nonlinear ones.
  [[nodiscard]] std::vector<Variable> GetVariables() const;
  /// The same up to the order of linear terms: the same nonlinear terms in the same order, of
  /// operands that are EqualTo.
  [[nodiscard]] bool EqualTo(const Expression& other) const;

  /// The value where each variable has the value that is given. Throws InvalidArgument for a
  /// variable that `values` lacks.
  [[nodiscard]] double Evaluate(const Values& values = {}) const;
  [[nodiscard]] double Evaluate(const std::function<double(Variable)>& value) const;
  /// With expressions put for variables, all at once; the others stay.
  [[nodiscard]] Expression Substitute(const Substitution& replacement) const;
  [[nodiscard]] Expression Substitute(Variable variable, const Expression& replacement) const;
  /// "2*x(0) + 3*y - x(0)*x(1) + sqrt(1 + x(0)^2)". Ends in "..." where it would be longer than
  /// `limit`: shared nodes can make a text exponentially long.
  [[nodiscard]] std::string to_string(std::size_t limit = 100000) const;

  Expression& operator+=(double number) {
    constant_ += number;
    return *this;
  }
  Expression& operator+=(Variable variable) { return Add(1, variable); }
  Expression& operator+=(const Expression& e) { return Add(1, e); }
  Expression& operator+=(Expression&& e);
  Expression& operator-=(double number) { return *this += -number; }
  Expression& operator-=(Variable variable) { return Add(-1, variable); }
  Expression& operator-=(const Expression& e) { return Add(-1, e); }
  Expression& operator*=(double factor);
  Expression& operator*=(const Expression& factor);
  /// Throws InvalidArgument where the divisor is the constant 0.
  Expression& operator/=(double divisor);
  Expression& operator/=(const Expression& divisor);

  /// += coefficient * variable, += factor * e: without temporaries, for loops.
  Expression& Add(double coefficient, Variable variable) {
    if (linear_.size() == linear_.capacity()) MakeRoom(1);
    linear_.push_back({variable, coefficient});
    return *this;
  }
  Expression& Add(double factor, const Expression& e);
  /// Room for `count` linear terms.
  void Reserve(std::size_t count) { linear_.reserve(count); }

 private:
  void MakeRoom(std::size_t count);

  double constant_ = 0;
  std::vector<LinearTerm> linear_;
  std::vector<NonlinearTerm> nonlinear_;
  std::size_t merged_ = 0;  // how many linear terms were left when they were last added up
};

inline Expression operator+(Expression a, const Expression& b) { return std::move(a += b); }
inline Expression operator+(Expression a, Expression&& b) { return std::move(a += std::move(b)); }
inline Expression operator-(Expression a, const Expression& b) { return std::move(a -= b); }
inline Expression operator-(Expression a) { return std::move(a *= -1.0); }
inline Expression operator+(Expression a) { return a; }
SWITCHYARD_EXPORT Expression operator*(Expression a, Expression b);
SWITCHYARD_EXPORT Expression operator/(Expression a, Expression b);

/// What their names say, folded on constants. pow with a constant exponent 0, 1, 1/2 is 1, e,
/// sqrt(e).
SWITCHYARD_EXPORT Expression pow(Expression base, Expression exponent);
SWITCHYARD_EXPORT Expression sqrt(Expression e);
SWITCHYARD_EXPORT Expression exp(Expression e);
SWITCHYARD_EXPORT Expression log(Expression e);
SWITCHYARD_EXPORT Expression sin(Expression e);
SWITCHYARD_EXPORT Expression cos(Expression e);
SWITCHYARD_EXPORT Expression tan(Expression e);
SWITCHYARD_EXPORT Expression asin(Expression e);
SWITCHYARD_EXPORT Expression acos(Expression e);
SWITCHYARD_EXPORT Expression atan(Expression e);
SWITCHYARD_EXPORT Expression sinh(Expression e);
SWITCHYARD_EXPORT Expression cosh(Expression e);
SWITCHYARD_EXPORT Expression tanh(Expression e);
SWITCHYARD_EXPORT Expression abs(Expression e);
SWITCHYARD_EXPORT Expression floor(Expression e);
SWITCHYARD_EXPORT Expression ceil(Expression e);
SWITCHYARD_EXPORT Expression atan2(Expression y, Expression x);
SWITCHYARD_EXPORT Expression min(Expression a, Expression b);
SWITCHYARD_EXPORT Expression max(Expression a, Expression b);

SWITCHYARD_EXPORT std::ostream& operator<<(std::ostream& out, const Expression& e);
inline std::string to_string(const Expression& e) { return e.to_string(); }

}  // namespace switchyard
