// switchyard/symbolic/formula.hpp - comparisons of expressions, and what is put together of them.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/symbolic/expression.hpp"

namespace switchyard {

/// A value; copies share what it is made of. As constraints serve ==, <=, >= and conjunctions of
/// them; if_then_else takes any.
class SWITCHYARD_EXPORT Formula {
 public:
  enum class Kind {
    kTrue,
    kFalse,
    kEqual,
    kNotEqual,
    kLessEqual,
    kGreaterEqual,
    kLess,
    kGreater,
    kAnd,
    kOr,
    kNot,
  };

  Formula() : Formula(true) {}
  explicit Formula(bool holds) : kind_(holds ? Kind::kTrue : Kind::kFalse) {}
  // NOLINTNEXTLINE(google-explicit-constructor): a comparison of variables is one of expressions
  Formula(const VariableEquality& equality);
  /// left ? right, for the kinds that compare.
  Formula(Kind comparison, Expression left, Expression right);
  static Formula True() { return Formula(true); }
  static Formula False() { return Formula(false); }
  /// All of them hold; conjunctions among them are taken apart.
  static Formula All(const std::vector<Formula>& formulas);

  [[nodiscard]] Kind kind() const { return kind_; }
  [[nodiscard]] bool is_comparison() const {
    return kind_ >= Kind::kEqual && kind_ <= Kind::kGreater;
  }
  /// The sides of a comparison.
  [[nodiscard]] const Expression& left() const;
  [[nodiscard]] const Expression& right() const;
  /// Of a conjunction, a disjunction or a negation.
  [[nodiscard]] const std::vector<Formula>& parts() const;

  /// Does it hold without knowing values? Where it compares what differs by a constant, or where it
  /// is an equality of two variables: these are equal when they are the same. Else it throws
  /// InvalidArgument.
  explicit operator bool() const;

  [[nodiscard]] bool Evaluate(const Expression::Values& values = {}) const;
  [[nodiscard]] std::vector<Variable> GetVariables() const;
  [[nodiscard]] Formula Substitute(const Expression::Substitution& replacement) const;
  [[nodiscard]] bool EqualTo(const Formula& other) const;
  /// "x(0) + y <= 2 and z == 1"; `limit` as that of an expression, for each side.
  [[nodiscard]] std::string to_string(std::size_t limit = 100000) const;

 private:
  struct Content;
  Formula(Kind kind, std::vector<Formula> parts);
  friend SWITCHYARD_EXPORT Formula operator||(const Formula& a, const Formula& b);
  friend SWITCHYARD_EXPORT Formula operator!(const Formula& f);

  Kind kind_;
  std::shared_ptr<const Content> content_;  // of kinds other than true and false
};

inline Formula operator==(Expression a, Expression b) {
  return {Formula::Kind::kEqual, std::move(a), std::move(b)};
}
inline Formula operator!=(Expression a, Expression b) {
  return {Formula::Kind::kNotEqual, std::move(a), std::move(b)};
}
inline Formula operator<=(Expression a, Expression b) {
  return {Formula::Kind::kLessEqual, std::move(a), std::move(b)};
}
inline Formula operator>=(Expression a, Expression b) {
  return {Formula::Kind::kGreaterEqual, std::move(a), std::move(b)};
}
inline Formula operator<(Expression a, Expression b) {
  return {Formula::Kind::kLess, std::move(a), std::move(b)};
}
inline Formula operator>(Expression a, Expression b) {
  return {Formula::Kind::kGreater, std::move(a), std::move(b)};
}

/// Neither side is left out, as && of bools does.
inline Formula operator&&(const Formula& a, const Formula& b) { return Formula::All({a, b}); }
/// Of equalities that could be bools as well.
inline Formula operator&&(const VariableEquality& a, const VariableEquality& b) {
  return Formula::All({a, b});
}
SWITCHYARD_EXPORT Formula operator||(const Formula& a, const Formula& b);
inline Formula operator||(const VariableEquality& a, const VariableEquality& b) {
  return Formula(a) || Formula(b);
}
SWITCHYARD_EXPORT Formula operator!(const Formula& f);
/// As != of two variables.
inline bool operator!(const VariableEquality& equality) { return !bool(equality); }

/// Where the formula holds `then`, else `otherwise`.
SWITCHYARD_EXPORT Expression if_then_else(const Formula& formula, Expression then,
                                          Expression otherwise);

SWITCHYARD_EXPORT std::ostream& operator<<(std::ostream& out, const Formula& f);
inline std::string to_string(const Formula& f) { return f.to_string(); }

}  // namespace switchyard
