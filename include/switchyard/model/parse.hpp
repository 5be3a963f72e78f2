// switchyard/model/parse.hpp - the costs and constraints that expressions and formulas say.
//
// All functions throw InvalidArgument, naming the expression and the reason, for what does not have
// the asked form. Variables stand in a binding in the order in which they first appear.
#pragma once

#include <memory>
#include <optional>

#include "switchyard/export.hpp"
#include "switchyard/model/binding.hpp"
#include "switchyard/model/constraint.hpp"
#include "switchyard/model/cost.hpp"
#include "switchyard/model/function_terms.hpp"
#include "switchyard/symbolic/lists.hpp"

namespace switchyard {

using MatrixRef = Eigen::Ref<const Eigen::MatrixXd>;

// ---- Costs ----

SWITCHYARD_EXPORT Binding<LinearCost> ParseLinearCost(const Expression& e);
SWITCHYARD_EXPORT Binding<QuadraticCost> ParseQuadraticCost(
    const Expression& e, std::optional<bool> is_convex = std::nullopt);
/// See RecognizeL2Norm for the tolerances.
SWITCHYARD_EXPORT Binding<L2NormCost> ParseL2NormCost(const Expression& e, double psd_tol = 1e-8,
                                                      double coefficient_tol = 1e-8);
/// The first of these that it is: linear, quadratic, a norm; else a function with exact
/// derivatives.
SWITCHYARD_EXPORT Binding<Cost> ParseCost(const Expression& e);

// ---- Constraints lower <= e <= upper and formulas, row by row ----
//
// Formulas are ==, <=, >= and conjunctions of them; strict comparisons, !=, || and ! are refused. A
// row without variables that cannot hold is refused; so is a single one that always holds, since it
// constrains nothing. Among others such a row stays, so that rows keep their numbers.

/// All rows affine: a bounding box where each is a multiple of one variable and not all are
/// equalities, a linear equality constraint where all are, else a linear constraint. One row: a
/// quadratic constraint, or a Lorentz cone for |Ax + b| <= c'x + d. Else a function with exact
/// derivatives, described by its expression where that is short.
SWITCHYARD_EXPORT Binding<Constraint> ParseConstraint(const Expression& e, double lower,
                                                      double upper);
SWITCHYARD_EXPORT Binding<Constraint> ParseConstraint(const ExpressionList& e,
                                                      const MatrixRef& lower,
                                                      const MatrixRef& upper);
SWITCHYARD_EXPORT Binding<Constraint> ParseConstraint(const FormulaList& formulas);

/// The same, of rows that must be affine.
SWITCHYARD_EXPORT Binding<LinearConstraint> ParseLinearConstraint(const Expression& e, double lower,
                                                                  double upper);
SWITCHYARD_EXPORT Binding<LinearConstraint> ParseLinearConstraint(const ExpressionList& e,
                                                                  const MatrixRef& lower,
                                                                  const MatrixRef& upper);
SWITCHYARD_EXPORT Binding<LinearConstraint> ParseLinearConstraint(const FormulaList& formulas);
/// Null where the expression is not affine.
SWITCHYARD_EXPORT std::unique_ptr<Binding<Constraint>> MaybeParseLinearConstraint(
    const Expression& e, double lower, double upper);

/// e = b; of square matrices, where wanted, the lower triangles alone.
SWITCHYARD_EXPORT Binding<LinearEqualityConstraint> ParseLinearEqualityConstraint(
    const Expression& e, double b);
SWITCHYARD_EXPORT Binding<LinearEqualityConstraint> ParseLinearEqualityConstraint(
    const ExpressionList& e, const MatrixRef& b, bool lower_triangle = false);
SWITCHYARD_EXPORT Binding<LinearEqualityConstraint> ParseLinearEqualityConstraint(
    const FormulaList& formulas);

SWITCHYARD_EXPORT Binding<QuadraticConstraint> ParseQuadraticConstraint(
    const Expression& e, double lower, double upper,
    std::optional<QuadraticConstraint::HessianType> hessian_type = std::nullopt);

// ---- Cones ----

/// |Ax + b| <= c'x + d, or with the sides exchanged by >=; see RecognizeL2Norm for the tolerances.
SWITCHYARD_EXPORT Binding<LorentzConeConstraint> ParseLorentzConeConstraint(
    const Formula& formula, double psd_tol = 1e-8, double coefficient_tol = 1e-8);
/// z_0 >= |z_1..m|, z affine.
SWITCHYARD_EXPORT Binding<LorentzConeConstraint> ParseLorentzConeConstraint(
    const ExpressionList& z);
/// linear >= sqrt(quadratic); `tolerance`: how far the quadratic may be from a sum of squares.
SWITCHYARD_EXPORT Binding<LorentzConeConstraint> ParseLorentzConeConstraint(
    const Expression& linear, const Expression& quadratic, double tolerance = 0);
/// z_0 z_1 >= z_2^2 + ... + z_m^2, z_0 >= 0, z_1 >= 0, z affine.
SWITCHYARD_EXPORT Binding<RotatedLorentzConeConstraint> ParseRotatedLorentzConeConstraint(
    const ExpressionList& z);
/// linear1 * linear2 >= quadratic, linear1 >= 0, linear2 >= 0.
SWITCHYARD_EXPORT Binding<RotatedLorentzConeConstraint> ParseRotatedLorentzConeConstraint(
    const Expression& linear1, const Expression& linear2, const Expression& quadratic,
    double tolerance = 0);

/// v'Xv >= 0 for each v with one entry 1 or two entries +-1: X_ii >= 0 and, for i < j,
/// X_ii + X_jj +- (X_ij + X_ji) >= 0.
SWITCHYARD_EXPORT Binding<LinearConstraint> ParsePositiveDiagonallyDominantDualCone(
    const ExpressionList& X);

}  // namespace switchyard
