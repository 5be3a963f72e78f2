#include <algorithm>
#include <cmath>
#include <limits>

#include "core/model/parse_rows.hpp"
#include "switchyard/model/parse.hpp"
#include "switchyard/symbolic/decompose.hpp"

namespace switchyard {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A row that has no variables, of the value `constant`.
void CheckConstantRow(const Rows& rows, Index i, double constant) {
  const bool holds = rows.lower[i] <= constant && constant <= rows.upper[i];
  if (!holds) {
    Refuse(TextOf(rows, i), rows.size() > 1 ? Text(", row ", i, " of ", rows.size(), ",") : "",
           " is always false: no point satisfies it");
  }
  if (rows.size() == 1) Refuse(TextOf(rows, i), " is always true: it constrains nothing");
}

// Affine rows, ready to be made a constraint: lower <= Ax <= upper.
struct AffineRows {
  AffineForm form;
  VectorXd lower;
  VectorXd upper;
  Eigen::VectorXi entries;  // in each row
};

AffineRows AffineOf(const Rows& rows) {
  AffineRows affine{DecomposeAffine(rows.e), rows.lower, rows.upper,
                    Eigen::VectorXi::Zero(rows.size())};
  affine.lower -= affine.form.b;
  affine.upper -= affine.form.b;
  for (Index k = 0; k < affine.form.A.nonZeros(); ++k) {
    ++affine.entries[affine.form.A.innerIndexPtr()[k]];
  }
  for (Index i = 0; i < rows.size(); ++i) {
    if (affine.entries[i] == 0) CheckConstantRow(rows, i, affine.form.b[i]);
  }
  return affine;
}

// Rows a x_j of one variable each, as bounds on these.
Binding<BoundingBoxConstraint> BoxOf(AffineRows rows) {
  VectorXDecisionVariable variables(rows.lower.size());
  for (Index j = 0; j < rows.form.A.cols(); ++j) {
    for (SparseMatrix::InnerIterator it(rows.form.A, j); it; ++it) {
      const Index i = it.row();
      variables[i] = rows.form.variables[j];
      rows.lower[i] /= it.value();
      rows.upper[i] /= it.value();
      if (it.value() < 0) std::swap(rows.lower[i], rows.upper[i]);
    }
  }
  return {std::make_shared<BoundingBoxConstraint>(rows.lower, rows.upper), variables};
}

Binding<LinearConstraint> LinearOf(AffineRows rows) {
  if ((rows.lower.array() == rows.upper.array()).all()) {
    return Binding<LinearEqualityConstraint>(
        std::make_shared<LinearEqualityConstraint>(std::move(rows.form.A), rows.lower),
        rows.form.variables);
  }
  if ((rows.entries.array() == 1).all()) return BoxOf(std::move(rows));
  return {std::make_shared<LinearConstraint>(std::move(rows.form.A), rows.lower, rows.upper),
          rows.form.variables};
}

Binding<LinearConstraint> LinearOf(Rows rows) {
  for (Expression& e : rows.e) {
    if (!IsAffine(e)) e = WithoutCancelledProducts(e);
  }
  return LinearOf(AffineOf(rows));
}

Binding<LinearEqualityConstraint> EqualityOf(const Rows& rows) {
  for (Index i = 0; i < rows.size(); ++i) {
    if (rows.lower[i] != rows.upper[i]) Refuse(TextOf(rows, i), " is no equality");
  }
  AffineRows affine = AffineOf(rows);
  return {std::make_shared<LinearEqualityConstraint>(std::move(affine.form.A), affine.lower),
          affine.form.variables};
}

// |Ax + b| <= z_0, where the one row says so by a term k * sqrt(..) or k * |..|: k > 0 with an
// upper bound, or k < 0 with a lower one.
struct NormAndBound {
  AffineForm norm;
  Expression z0;
};
std::optional<NormAndBound> NormOf(const Rows& row, double psd_tol, double coefficient_tol) {
  const Expression& e = row.e[0];
  if (e.nonlinear().size() != 1) return std::nullopt;
  const auto& [node, k] = e.nonlinear().front();
  const double free_side = k > 0 ? row.lower[0] : -row.upper[0];
  const double bound = k > 0 ? row.upper[0] : -row.lower[0];
  if (free_side != -kInfinity || !(bound < kInfinity)) return std::nullopt;
  const auto norm = RecognizeL2Norm(Expression(std::abs(k), node), psd_tol, coefficient_tol);
  if (!norm) return std::nullopt;
  Expression rest = e.constant();
  for (const auto& [variable, coefficient] : e.linear()) rest.Add(coefficient, variable);
  return NormAndBound{*norm, bound - (k > 0 ? rest : -rest)};
}

Binding<LorentzConeConstraint> ConeOf(const NormAndBound& row) {
  Eigen::VectorX<Expression> z(row.norm.A.rows() + 1);
  z[0] = row.z0;
  z.tail(row.norm.A.rows()) = row.norm.A * row.norm.variables + row.norm.b;
  return ParseLorentzConeConstraint(z);
}

// |a'x + b| <= z_0 is -z_0 <= a'x + b <= z_0.
Binding<LinearConstraint> AbsoluteValueOf(const NormAndBound& row) {
  const Eigen::VectorX<Expression> inside = row.norm.A * row.norm.variables + row.norm.b;
  if (row.z0.is_constant()) {
    const double bound = row.z0.Evaluate();
    return ParseLinearConstraint(inside[0], -bound, bound);
  }
  return ParseLinearConstraint(Eigen::Vector2<Expression>(row.z0 - inside[0], row.z0 + inside[0]),
                               Eigen::Vector2d::Zero(), Eigen::Vector2d::Constant(kInfinity));
}

Binding<QuadraticConstraint> QuadraticOf(
    const QuadraticForm& form, double lower, double upper,
    std::optional<QuadraticConstraint::HessianType> hessian_type) {
  return {std::make_shared<QuadraticConstraint>(form.Q, form.b, lower - form.c, upper - form.c,
                                                hessian_type),
          form.variables};
}

Binding<FunctionConstraint> FunctionOf(const Rows& rows) {
  for (Index i = 0; i < rows.size(); ++i) {
    if (rows.e[i].is_constant()) CheckConstantRow(rows, i, rows.e[i].Evaluate());
  }
  const CompiledExpressions compiled = CompileExpressions(rows.e);
  const auto constraint =
      std::make_shared<FunctionConstraint>(compiled.function, rows.lower, rows.upper);
  if (rows.size() == 1) Describe(rows.e[0], constraint.get());
  return {constraint, compiled.variables};
}

Binding<Constraint> ConstraintOf(const Rows& rows) {
  if (std::all_of(rows.e.begin(), rows.e.end(), IsAffine)) return LinearOf(AffineOf(rows));
  if (rows.size() > 1) return FunctionOf(rows);
  if (IsQuadratic(rows.e[0])) {
    const QuadraticForm form = DecomposeQuadratic(rows.e[0]);
    if (form.Q.nonZeros() == 0) return LinearOf(rows);
    return QuadraticOf(form, rows.lower[0], rows.upper[0], std::nullopt);
  }
  if (const auto norm = NormOf(rows, 1e-8, 1e-8)) {
    if (norm->norm.A.rows() == 1) return AbsoluteValueOf(*norm);
    return ConeOf(*norm);
  }
  return FunctionOf(rows);
}

Rows OneRowOf(const Expression& e, double lower, double upper) {
  return {OneRow(e), VectorXd::Constant(1, lower), VectorXd::Constant(1, upper), {}};
}

}  // namespace

Binding<Constraint> ParseConstraint(const Expression& e, double lower, double upper) {
  return ConstraintOf(OneRowOf(e, lower, upper));
}

Binding<Constraint> ParseConstraint(const ExpressionList& e, const MatrixRef& lower,
                                    const MatrixRef& upper) {
  return ConstraintOf(RowsOf(e, lower, upper));
}

Binding<Constraint> ParseConstraint(const FormulaList& formulas) {
  return ConstraintOf(RowsOf(formulas));
}

Binding<LinearConstraint> ParseLinearConstraint(const Expression& e, double lower, double upper) {
  return LinearOf(OneRowOf(e, lower, upper));
}

Binding<LinearConstraint> ParseLinearConstraint(const ExpressionList& e, const MatrixRef& lower,
                                                const MatrixRef& upper) {
  return LinearOf(RowsOf(e, lower, upper));
}

Binding<LinearConstraint> ParseLinearConstraint(const FormulaList& formulas) {
  return LinearOf(RowsOf(formulas));
}

std::unique_ptr<Binding<Constraint>> MaybeParseLinearConstraint(const Expression& e, double lower,
                                                                double upper) {
  const Expression affine = WithoutCancelledProducts(e);
  if (!IsAffine(affine)) return nullptr;
  return std::make_unique<Binding<Constraint>>(ParseLinearConstraint(affine, lower, upper));
}

Binding<LinearEqualityConstraint> ParseLinearEqualityConstraint(const Expression& e, double b) {
  return EqualityOf(OneRowOf(e, b, b));
}

Binding<LinearEqualityConstraint> ParseLinearEqualityConstraint(const ExpressionList& e,
                                                                const MatrixRef& b,
                                                                bool lower_triangle) {
  const Rows all = RowsOf(e, b, b);
  if (!lower_triangle) return EqualityOf(all);
  const Index n = e.matrix().rows();
  Require(e.matrix().cols() == n, "the lower triangle of an equality needs square matrices, got ",
          n, " x ", e.matrix().cols());
  std::vector<Index> chosen;
  for (Index j = 0; j < n; ++j) {
    for (Index i = j; i < n; ++i) chosen.push_back(j * n + i);
  }
  return EqualityOf({all.e(chosen), all.lower(chosen), all.upper(chosen), {}});
}

Binding<LinearEqualityConstraint> ParseLinearEqualityConstraint(const FormulaList& formulas) {
  return EqualityOf(RowsOf(formulas));
}

Binding<QuadraticConstraint> ParseQuadraticConstraint(
    const Expression& e, double lower, double upper,
    std::optional<QuadraticConstraint::HessianType> hessian_type) {
  return QuadraticOf(DecomposeQuadratic(e), lower, upper, hessian_type);
}

Binding<LorentzConeConstraint> ParseLorentzConeConstraint(const Formula& formula, double psd_tol,
                                                          double coefficient_tol) {
  const Rows rows = RowsOf(FormulaList(formula));
  const auto norm = rows.size() == 1 ? NormOf(rows, psd_tol, coefficient_tol) : std::nullopt;
  if (!norm) {
    Refuse(
        formula.to_string(60),
        " is no Lorentz cone: it needs the form |Ax + b| <= c'x + d, the norm written as .norm() "
        "or as the root of a sum of squares");
  }
  return ConeOf(*norm);
}

}  // namespace switchyard
