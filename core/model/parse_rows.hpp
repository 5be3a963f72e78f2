// core/model/parse_rows.hpp - rows of expressions with bounds, as parsing makes constraints of
// them.
#pragma once

#include <vector>

#include "switchyard/error.hpp"
#include "switchyard/model/evaluator.hpp"
#include "switchyard/symbolic/decompose.hpp"
#include "switchyard/symbolic/lists.hpp"

namespace switchyard {

/// lower <= e <= upper, row by row.
struct Rows {
  Eigen::VectorX<Expression> e;
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
  std::vector<Formula> formulas;  // of each row the one that it came from; empty: none

  [[nodiscard]] Eigen::Index size() const { return e.size(); }
};

/// Throws where the bounds have another shape than the expressions.
Rows RowsOf(const ExpressionList& e, const Eigen::Ref<const Eigen::MatrixXd>& lower,
            const Eigen::Ref<const Eigen::MatrixXd>& upper);
/// left - right, its constant taken into the bounds; conjunctions are taken apart. Throws for a
/// formula that is no constraint.
Rows RowsOf(const FormulaList& formulas);

/// Row i as it was given: "x + y <= 2", "1 <= x + y <= 2".
std::string TextOf(const Rows& rows, Eigen::Index i);

inline Eigen::VectorX<Expression> OneRow(const Expression& e) {
  return Eigen::VectorX<Expression>::Constant(1, e);
}

/// Affine, where e is of second order only by products that cancel; else e itself.
Expression WithoutCancelledProducts(const Expression& e);

/// Gives the evaluator the expression as its description, where that is short.
void Describe(const Expression& e, EvaluatorBase* evaluator);

}  // namespace switchyard
