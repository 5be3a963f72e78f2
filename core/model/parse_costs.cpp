#include "core/model/parse_rows.hpp"
#include "switchyard/model/parse.hpp"
#include "switchyard/symbolic/decompose.hpp"

namespace switchyard {
namespace {

Binding<QuadraticCost> CostOf(const QuadraticForm& form, std::optional<bool> is_convex) {
  return {std::make_shared<QuadraticCost>(form.Q, form.b, form.c, is_convex), form.variables};
}

}  // namespace

Binding<LinearCost> ParseLinearCost(const Expression& e) {
  const AffineForm form = DecomposeAffine(OneRow(WithoutCancelledProducts(e)));
  return {std::make_shared<LinearCost>(Eigen::VectorXd(form.A.row(0)), form.b[0]), form.variables};
}

Binding<QuadraticCost> ParseQuadraticCost(const Expression& e, std::optional<bool> is_convex) {
  return CostOf(DecomposeQuadratic(e), is_convex);
}

Binding<L2NormCost> ParseL2NormCost(const Expression& e, double psd_tol, double coefficient_tol) {
  const auto form = RecognizeL2Norm(e, psd_tol, coefficient_tol);
  if (!form) {
    Refuse(e.to_string(60),
           " is no norm |Ax + b|: it needs to be a multiple of the root of a sum of squares of "
           "affine expressions");
  }
  return {std::make_shared<L2NormCost>(form->A, form->b), form->variables};
}

Binding<Cost> ParseCost(const Expression& e) {
  if (IsQuadratic(e)) {
    const QuadraticForm form = DecomposeQuadratic(e);
    if (form.Q.nonZeros() > 0) return CostOf(form, std::nullopt);
    return Binding<LinearCost>(std::make_shared<LinearCost>(form.b, form.c), form.variables);
  }
  if (const auto form = RecognizeL2Norm(e)) {
    return Binding<L2NormCost>(std::make_shared<L2NormCost>(form->A, form->b), form->variables);
  }
  const CompiledExpressions compiled = CompileExpressions(OneRow(e));
  const auto cost = std::make_shared<FunctionCost>(compiled.function);
  Describe(e, cost.get());
  return Binding<FunctionCost>(cost, compiled.variables);
}

}  // namespace switchyard
