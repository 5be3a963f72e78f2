#include "switchyard/symbolic/expression.hpp"

#include <algorithm>
#include <cmath>

#include "core/functions/op_table.hpp"
#include "core/symbolic/node.hpp"
#include "core/symbolic/terms.hpp"
#include "switchyard/error.hpp"

namespace switchyard {
namespace {

// Shorter lists of linear terms are not added up before they are read.
constexpr std::size_t kShort = 32;

bool IsNumber(const Expression& e, double number) {
  return HasNoTerms(e) && e.constant() == number;
}

// The same terms, written in the same order: a quick look that may miss what is equal.
bool Identical(const Expression& a, const Expression& b) {
  return a.constant() == b.constant() &&
         std::equal(a.linear().begin(), a.linear().end(), b.linear().begin(), b.linear().end(),
                    [](const auto& s, const auto& t) {
                      return s.coefficient == t.coefficient && s.variable.equal_to(t.variable);
                    }) &&
         std::equal(a.nonlinear().begin(), a.nonlinear().end(), b.nonlinear().begin(),
                    b.nonlinear().end(), [](const auto& s, const auto& t) {
                      return s.coefficient == t.coefficient && s.node == t.node;
                    });
}

// Takes out the coefficient c of an expression that is one term, c * t, and makes it t.
double TakeCoefficient(Expression* e) {
  if (e->constant() != 0 || e->linear().size() + e->nonlinear().size() != 1) return 1;
  if (!e->linear().empty()) {
    const auto [variable, coefficient] = e->linear().front();
    *e = variable;
    return coefficient;
  }
  const auto [node, coefficient] = e->nonlinear().front();
  *e = Expression(1, node);
  return coefficient;
}

Expression Scaled(Expression e, double factor) { return std::move(e *= factor); }

// The exponent where e is base^exponent, whole; else 0.
double WholeExponent(const Expression& e, const Expression& base) {
  if (e.constant() != 0 || !e.linear().empty() || e.nonlinear().size() != 1) return 0;
  const auto& [node, coefficient] = e.nonlinear().front();
  const bool power = coefficient == 1 && IsWholePower(*node) && Identical(node->operand(0), base);
  return power ? node->operand(1).constant() : 0;
}

}  // namespace

std::vector<Expression::LinearTerm> Expression::MergedLinear() const { return Merged(linear_); }

void Expression::MakeRoom(std::size_t count) {
  if (linear_.size() >= std::max(kShort, 2 * merged_)) {
    linear_ = Merged(linear_);
    merged_ = linear_.size();
  }
  const std::size_t needed = linear_.size() + count;
  if (needed > linear_.capacity()) {
    linear_.reserve(std::max({needed, 2 * linear_.size(), std::size_t{4}}));
  }
}

Expression& Expression::Add(double factor, const Expression& e) {
  if (&e == this) return *this *= 1 + factor;
  constant_ += factor * e.constant_;
  if (!e.linear_.empty()) {
    if (linear_.capacity() - linear_.size() < e.linear_.size()) MakeRoom(e.linear_.size());
    for (const LinearTerm& t : e.linear_) linear_.push_back({t.variable, factor * t.coefficient});
  }
  for (const NonlinearTerm& t : e.nonlinear_)
    nonlinear_.push_back({t.node, factor * t.coefficient});
  return *this;
}

Expression& Expression::operator+=(Expression&& e) {
  if (!HasNoTerms(*this) || &e == this) return Add(1, e);
  const double constant = constant_;
  *this = std::move(e);
  constant_ += constant;
  return *this;
}

Expression& Expression::operator*=(double factor) {
  constant_ *= factor;
  if (factor == 0) {
    linear_.clear();
    nonlinear_.clear();
  }
  for (LinearTerm& t : linear_) t.coefficient *= factor;
  for (NonlinearTerm& t : nonlinear_) t.coefficient *= factor;
  return *this;
}

Expression& Expression::operator/=(double divisor) {
  if (divisor == 0) Refuse("division of ", to_string(60), " by 0");
  constant_ /= divisor;
  for (LinearTerm& t : linear_) t.coefficient /= divisor;
  for (NonlinearTerm& t : nonlinear_) t.coefficient /= divisor;
  return *this;
}

Expression& Expression::operator*=(const Expression& factor) {
  return *this = std::move(*this) * factor;
}

Expression& Expression::operator/=(const Expression& divisor) {
  return *this = std::move(*this) / divisor;
}

Expression operator*(Expression a, Expression b) {
  if (HasNoTerms(a)) return std::move(b *= a.constant());
  if (HasNoTerms(b)) return std::move(a *= b.constant());
  const double c = TakeCoefficient(&a) * TakeCoefficient(&b);
  if (Identical(a, b)) return Scaled(pow(std::move(a), 2), c);
  const double exponent = WholeExponent(a, b);
  if (exponent > 0) return Scaled(pow(std::move(b), exponent + 1), c);
  return Scaled(MakeExpression(Op::kMultiply, std::move(a), std::move(b)), c);
}

Expression operator/(Expression a, Expression b) {
  if (HasNoTerms(b)) return std::move(a /= b.constant());
  if (IsNumber(a, 0)) return a;
  const double c = HasNoTerms(a) ? std::exchange(a, 1.0).constant() : TakeCoefficient(&a);
  return Scaled(MakeExpression(Op::kDivide, std::move(a), std::move(b)), c);
}

Expression MakeExpression(Op op, std::vector<Expression> operands) {
  if (!std::all_of(operands.begin(), operands.end(), HasNoTerms)) {
    return {1.0, std::make_shared<const ExpressionNode>(op, std::move(operands))};
  }
  double value[3] = {};
  std::transform(operands.begin(), operands.end(), value,
                 [](const Expression& e) { return e.constant(); });
  return FactsOf(op).value(value[0], value[1], value[2]);
}

Expression pow(Expression base, Expression exponent) {
  if (IsNumber(exponent, 0)) return 1;
  if (IsNumber(exponent, 1)) return base;
  if (IsNumber(exponent, 0.5)) return sqrt(std::move(base));
  return MakeExpression(Op::kPower, std::move(base), std::move(exponent));
}

Expression sqrt(Expression e) { return MakeExpression(Op::kSqrt, std::move(e)); }
Expression exp(Expression e) { return MakeExpression(Op::kExp, std::move(e)); }
Expression log(Expression e) { return MakeExpression(Op::kLog, std::move(e)); }
Expression sin(Expression e) { return MakeExpression(Op::kSin, std::move(e)); }
Expression cos(Expression e) { return MakeExpression(Op::kCos, std::move(e)); }
Expression tan(Expression e) { return MakeExpression(Op::kTan, std::move(e)); }
Expression asin(Expression e) { return MakeExpression(Op::kAsin, std::move(e)); }
Expression acos(Expression e) { return MakeExpression(Op::kAcos, std::move(e)); }
Expression atan(Expression e) { return MakeExpression(Op::kAtan, std::move(e)); }
Expression sinh(Expression e) { return MakeExpression(Op::kSinh, std::move(e)); }
Expression cosh(Expression e) { return MakeExpression(Op::kCosh, std::move(e)); }
Expression tanh(Expression e) { return MakeExpression(Op::kTanh, std::move(e)); }
Expression abs(Expression e) { return MakeExpression(Op::kAbs, std::move(e)); }
Expression floor(Expression e) { return MakeExpression(Op::kFloor, std::move(e)); }
Expression ceil(Expression e) { return MakeExpression(Op::kCeil, std::move(e)); }
Expression atan2(Expression y, Expression x) {
  return MakeExpression(Op::kAtan2, std::move(y), std::move(x));
}
Expression min(Expression a, Expression b) {
  return MakeExpression(Op::kMin, std::move(a), std::move(b));
}
Expression max(Expression a, Expression b) {
  return MakeExpression(Op::kMax, std::move(a), std::move(b));
}

}  // namespace switchyard
