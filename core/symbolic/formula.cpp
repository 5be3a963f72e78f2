#include "switchyard/symbolic/formula.hpp"

#include <algorithm>
#include <optional>
#include <ostream>
#include <unordered_set>

#include "core/symbolic/node.hpp"
#include "switchyard/error.hpp"

namespace switchyard {

struct Formula::Content {
  Expression left, right;      // of a comparison
  std::vector<Formula> parts;  // of the others
};

namespace {

using Kind = Formula::Kind;

const char* SignOf(Kind kind) {
  switch (kind) {
    case Kind::kEqual:
      return " == ";
    case Kind::kNotEqual:
      return " != ";
    case Kind::kLessEqual:
      return " <= ";
    case Kind::kGreaterEqual:
      return " >= ";
    case Kind::kLess:
      return " < ";
    default:
      return " > ";
  }
}

bool Compare(Kind kind, double left, double right) {
  switch (kind) {
    case Kind::kEqual:
      return left == right;
    case Kind::kNotEqual:
      return left != right;
    case Kind::kLessEqual:
      return left <= right;
    case Kind::kGreaterEqual:
      return left >= right;
    case Kind::kLess:
      return left < right;
    default:
      return left > right;
  }
}

std::optional<bool> DecideComparison(const Formula& f) {
  const Expression& left = f.left();
  const Expression& right = f.right();
  if (HasNoTerms(left) && HasNoTerms(right)) {
    return Compare(f.kind(), left.constant(), right.constant());
  }
  if (left.EqualTo(right)) return Compare(f.kind(), 0, 0);
  const Expression difference = left - right;
  if (difference.is_constant()) return Compare(f.kind(), difference.constant(), 0);
  if (BareVariable(left) != nullptr && BareVariable(right) != nullptr) {
    if (f.kind() == Kind::kEqual) return false;
    if (f.kind() == Kind::kNotEqual) return true;
  }
  return std::nullopt;
}

// Whether the formula holds, where that is known without values.
std::optional<bool> Decide(const Formula& f) {
  if (f.is_comparison()) return DecideComparison(f);
  if (f.kind() == Kind::kTrue || f.kind() == Kind::kFalse) return f.kind() == Kind::kTrue;
  if (f.kind() == Kind::kNot) {
    const auto inner = Decide(f.parts().front());
    return inner ? std::optional(!*inner) : std::nullopt;
  }
  const bool deciding = f.kind() == Kind::kOr;  // one such part decides all
  std::optional<bool> all = !deciding;
  for (const Formula& part : f.parts()) {
    const auto one = Decide(part);
    if (one == deciding) return deciding;
    if (!one) all = std::nullopt;
  }
  return all;
}

}  // namespace

Formula::Formula(const VariableEquality& equality)
    : Formula(Kind::kEqual, equality.left, equality.right) {}

Formula::Formula(Kind comparison, Expression left, Expression right)
    : kind_(comparison),
      content_(std::make_shared<const Content>(Content{std::move(left), std::move(right), {}})) {}

Formula::Formula(Kind kind, std::vector<Formula> parts)
    : kind_(kind), content_(std::make_shared<const Content>(Content{{}, {}, std::move(parts)})) {}

Formula Formula::All(const std::vector<Formula>& formulas) {
  std::vector<Formula> parts;
  for (const Formula& f : formulas) {
    if (f.kind_ == Kind::kFalse) return False();
    if (f.kind_ == Kind::kTrue) continue;
    if (f.kind_ == Kind::kAnd) {
      parts.insert(parts.end(), f.parts().begin(), f.parts().end());
    } else {
      parts.push_back(f);
    }
  }
  if (parts.empty()) return True();
  return parts.size() == 1 ? parts.front() : Formula(Kind::kAnd, std::move(parts));
}

const Expression& Formula::left() const {
  if (!is_comparison()) Refuse(to_string(60), " is no comparison: it has no left side");
  return content_->left;
}

const Expression& Formula::right() const {
  if (!is_comparison()) Refuse(to_string(60), " is no comparison: it has no right side");
  return content_->right;
}

const std::vector<Formula>& Formula::parts() const {
  if (kind_ < Kind::kAnd) Refuse(to_string(60), " is not put together of formulas");
  return content_->parts;
}

Formula::operator bool() const {
  const auto holds = Decide(*this);
  if (!holds) {
    Refuse("whether ", to_string(60),
           " depends on values: a formula is a bool only where it compares constants, or two "
           "variables by ==");
  }
  return *holds;
}

bool Formula::Evaluate(const Expression::Values& values) const {
  const auto holds = [&values](const Formula& f) { return f.Evaluate(values); };
  switch (kind_) {
    case Kind::kTrue:
      return true;
    case Kind::kFalse:
      return false;
    case Kind::kAnd:
      return std::all_of(parts().begin(), parts().end(), holds);
    case Kind::kOr:
      return std::any_of(parts().begin(), parts().end(), holds);
    case Kind::kNot:
      return !holds(parts().front());
    default:
      return Compare(kind_, left().Evaluate(values), right().Evaluate(values));
  }
}

std::vector<Variable> Formula::GetVariables() const {
  if (kind_ == Kind::kTrue || kind_ == Kind::kFalse) return {};
  std::vector<Variable> found;
  std::unordered_set<Variable> seen;
  const auto add = [&](const std::vector<Variable>& some) {
    std::copy_if(some.begin(), some.end(), std::back_inserter(found),
                 [&seen](Variable v) { return seen.insert(v).second; });
  };
  if (is_comparison()) {
    add(left().GetVariables());
    add(right().GetVariables());
  } else {
    for (const Formula& part : parts()) add(part.GetVariables());
  }
  return found;
}

Formula Formula::Substitute(const Expression::Substitution& replacement) const {
  if (kind_ == Kind::kTrue || kind_ == Kind::kFalse) return *this;
  if (is_comparison()) {
    return {kind_, left().Substitute(replacement), right().Substitute(replacement)};
  }
  std::vector<Formula> replaced;
  for (const Formula& part : parts()) replaced.push_back(part.Substitute(replacement));
  return {kind_, std::move(replaced)};
}

bool Formula::EqualTo(const Formula& other) const {
  if (kind_ != other.kind_) return false;
  if (content_ == other.content_) return true;
  if (is_comparison()) return left().EqualTo(other.left()) && right().EqualTo(other.right());
  return std::equal(parts().begin(), parts().end(), other.parts().begin(), other.parts().end(),
                    [](const Formula& a, const Formula& b) { return a.EqualTo(b); });
}

std::string Formula::to_string(std::size_t limit) const {
  if (kind_ == Kind::kTrue) return "true";
  if (kind_ == Kind::kFalse) return "false";
  if (is_comparison()) {
    return content_->left.to_string(limit) + SignOf(kind_) + content_->right.to_string(limit);
  }
  if (kind_ == Kind::kNot) return "not (" + parts().front().to_string(limit) + ")";
  std::string text;
  for (const Formula& part : parts()) {
    if (text.size() > limit) return text + " ...";
    if (!text.empty()) text += kind_ == Kind::kAnd ? " and " : " or ";
    const bool brackets = kind_ == Kind::kAnd && part.kind_ == Kind::kOr;
    if (brackets) text += '(';
    text += part.to_string(limit);
    if (brackets) text += ')';
  }
  return text;
}

Formula operator||(const Formula& a, const Formula& b) {
  if (a.kind() == Kind::kTrue || b.kind() == Kind::kFalse) return a;
  if (b.kind() == Kind::kTrue || a.kind() == Kind::kFalse) return b;
  return {Kind::kOr, {a, b}};
}

Formula operator!(const Formula& f) {
  if (f.kind() == Kind::kTrue) return Formula::False();
  if (f.kind() == Kind::kFalse) return Formula::True();
  return {Kind::kNot, {f}};
}

Expression if_then_else(const Formula& f, Expression then, Expression otherwise) {
  const auto choose = [&](Op op, Expression condition) {
    if (HasNoTerms(condition)) {
      const double value = condition.constant();
      return (op == Op::kIfPositive ? value > 0 : value >= 0) ? then : otherwise;
    }
    return MakeExpression(op, std::move(condition), std::move(then), std::move(otherwise));
  };
  switch (f.kind()) {
    case Kind::kTrue:
      return then;
    case Kind::kFalse:
      return otherwise;
    case Kind::kGreater:
      return choose(Op::kIfPositive, f.left() - f.right());
    case Kind::kLess:
      return choose(Op::kIfPositive, f.right() - f.left());
    case Kind::kGreaterEqual:
      return choose(Op::kIfNonnegative, f.left() - f.right());
    case Kind::kLessEqual:
      return choose(Op::kIfNonnegative, f.right() - f.left());
    case Kind::kEqual:
      return if_then_else(f.left() <= f.right(),
                          if_then_else(f.left() >= f.right(), std::move(then), otherwise),
                          otherwise);
    case Kind::kNotEqual:
      return if_then_else(f.left() == f.right(), std::move(otherwise), std::move(then));
    case Kind::kNot:
      return if_then_else(f.parts().front(), std::move(otherwise), std::move(then));
    case Kind::kAnd:
      for (const Formula& part : f.parts()) then = if_then_else(part, std::move(then), otherwise);
      return then;
    case Kind::kOr:
      for (const Formula& part : f.parts())
        otherwise = if_then_else(part, then, std::move(otherwise));
      return otherwise;
  }
  return then;
}

std::ostream& operator<<(std::ostream& out, const Formula& f) { return out << f.to_string(); }

}  // namespace switchyard
