#include "core/model/parse_rows.hpp"

#include <limits>
#include <tuple>
#include <utility>

namespace switchyard {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kShort = 60;  // characters of an expression in a message

using Kind = Formula::Kind;

void CheckShape(const char* what, const Eigen::MatrixX<Expression>& e,
                const Eigen::Ref<const Eigen::MatrixXd>& bound) {
  Require(bound.rows() == e.rows() && bound.cols() == e.cols(), e.rows(), " x ", e.cols(),
          " expressions need as many ", what, " bounds, got ", bound.rows(), " x ", bound.cols());
}

void AddTerms(double factor, const Expression& from, Expression* to) {
  for (const auto& [variable, coefficient] : from.linear()) {
    to->Add(factor * coefficient, variable);
  }
  for (const auto& [node, coefficient] : from.nonlinear()) {
    *to += Expression(factor * coefficient, node);
  }
}

// Conjunctions taken apart.
void AppendParts(const Formula& f, std::vector<Formula>* parts) {
  if (f.kind() != Kind::kAnd) {
    parts->push_back(f);
    return;
  }
  for (const Formula& part : f.parts()) AppendParts(part, parts);
}

[[noreturn]] void RefuseKind(const Formula& f) {
  const char* reason = "alternatives are no constraint";
  if (f.kind() == Kind::kLess || f.kind() == Kind::kGreater) {
    reason = "a strict comparison is no constraint: it takes <=, >= or ==";
  } else if (f.kind() == Kind::kNotEqual) {
    reason = "an inequality by != is no constraint: it takes <=, >= or ==";
  } else if (f.kind() == Kind::kNot) {
    reason = "a negation is no constraint";
  }
  Refuse(f.to_string(kShort), ": ", reason);
}

// The interval that left - right is to lie in, from that which its terms without constants do.
std::pair<double, double> BoundsOf(const Formula& f) {
  switch (f.kind()) {
    case Kind::kTrue:
      return {-kInfinity, kInfinity};
    case Kind::kFalse:
      return {kInfinity, -kInfinity};
    default:
      break;
  }
  const double bound = f.right().constant() - f.left().constant();
  switch (f.kind()) {
    case Kind::kEqual:
      return {bound, bound};
    case Kind::kLessEqual:
      return {-kInfinity, bound};
    case Kind::kGreaterEqual:
      return {bound, kInfinity};
    default:
      RefuseKind(f);
  }
}

}  // namespace

Rows RowsOf(const ExpressionList& e, const Eigen::Ref<const Eigen::MatrixXd>& lower,
            const Eigen::Ref<const Eigen::MatrixXd>& upper) {
  CheckShape("lower", e.matrix(), lower);
  CheckShape("upper", e.matrix(), upper);
  return {e.vector(), lower.reshaped(), upper.reshaped(), {}};
}

Rows RowsOf(const FormulaList& formulas) {
  Rows rows;
  for (const Formula& f : formulas.formulas()) AppendParts(f, &rows.formulas);
  const auto count = static_cast<Eigen::Index>(rows.formulas.size());
  rows.e.resize(count);
  rows.lower.resize(count);
  rows.upper.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Formula& f = rows.formulas[static_cast<std::size_t>(i)];
    if (f.kind() > Kind::kGreater) RefuseKind(f);
    std::tie(rows.lower[i], rows.upper[i]) = BoundsOf(f);
    if (!f.is_comparison()) continue;
    rows.e[i].Reserve(f.left().linear().size() + f.right().linear().size());
    AddTerms(1, f.left(), &rows.e[i]);
    AddTerms(-1, f.right(), &rows.e[i]);
  }
  return rows;
}

std::string TextOf(const Rows& rows, Eigen::Index i) {
  if (!rows.formulas.empty()) {
    return rows.formulas[static_cast<std::size_t>(i)].to_string(kShort);
  }
  const std::string e = rows.e[i].to_string(kShort);
  if (rows.lower[i] == rows.upper[i]) return Text(e, " == ", rows.lower[i]);
  if (rows.lower[i] == -kInfinity) return Text(e, " <= ", rows.upper[i]);
  if (rows.upper[i] == kInfinity) return Text(e, " >= ", rows.lower[i]);
  return Text(rows.lower[i], " <= ", e, " <= ", rows.upper[i]);
}

Expression WithoutCancelledProducts(const Expression& e) {
  if (IsAffine(e) || !IsQuadratic(e)) return e;
  const QuadraticForm form = DecomposeQuadratic(e);
  if (form.Q.nonZeros() > 0) return e;
  Expression affine = form.c;
  for (Eigen::Index j = 0; j < form.b.size(); ++j) affine.Add(form.b[j], form.variables[j]);
  return affine;
}

void Describe(const Expression& e, EvaluatorBase* evaluator) {
  std::string text = e.to_string(kShort);
  if (text.size() <= kShort) evaluator->set_description(std::move(text));
}

}  // namespace switchyard
