// Costs and constraints of q, qdot and qddot at many normalized times.
#include <cmath>
#include <utility>

#include "core/sets/cone_constraint_of.hpp"
#include "core/trajectory/kinematic_point.hpp"
#include "core/trajectory/kinematic_rows.hpp"
#include "switchyard/model/parse.hpp"
#include "switchyard/trajectory/kinematic_trajectory_optimization.hpp"

namespace switchyard {
namespace {

using HessianType = QuadraticConstraint::HessianType;

SparseMatrix Congruent(const SparseMatrix& Q, const SparseMatrix& W) {
  return W.transpose() * (Q * W).eval();
}

/// Ax + b in the cone at x = W p.
std::shared_ptr<Constraint> ConeOf(const ConeConstraint& cone, const SparseMatrix& W) {
  const auto dim = static_cast<Eigen::Index>(cone.frame().size());
  std::vector<Eigen::Triplet<double>> scales;
  for (Eigen::Index i = 0; i < dim; ++i) {
    const auto& row = cone.frame()[static_cast<std::size_t>(i)];
    scales.emplace_back(i, row.row, row.scale);
  }
  SparseMatrix frame(dim, cone.b().size());
  frame.setFromTriplets(scales.begin(), scales.end());
  return ConeConstraintOf(cone.cone(), frame * (cone.A() * W).eval(), frame * cone.b());
}

/// The constraint at x = W p as one of its own kind; null where only a function says it.
std::shared_ptr<Constraint> OfPoints(const Constraint& constraint, const SparseMatrix& W) {
  if (const auto* rows = dynamic_cast<const LinearConstraint*>(&constraint)) {
    return std::make_shared<LinearConstraint>(SparseMatrix(rows->get_sparse_A() * W),
                                              rows->lower_bound(), rows->upper_bound());
  }
  if (const auto* cone = dynamic_cast<const ConeConstraint*>(&constraint)) {
    return ConeOf(*cone, W);
  }
  if (const auto* form = dynamic_cast<const QuadraticConstraint*>(&constraint)) {
    const bool indefinite = form->hessian_type() == HessianType::kIndefinite;
    return std::make_shared<QuadraticConstraint>(
        Congruent(form->Q(), W), W.transpose() * form->b(), form->lower_bound()[0],
        form->upper_bound()[0], indefinite ? std::nullopt : std::optional(form->hessian_type()));
  }
  return nullptr;
}

std::shared_ptr<Cost> NormOf(NormCost::Norm norm, const SparseMatrix& A, const Eigen::VectorXd& b) {
  switch (norm) {
    case NormCost::Norm::kL1:
      return std::make_shared<L1NormCost>(A, b);
    case NormCost::Norm::kL2:
      return std::make_shared<L2NormCost>(A, b);
    case NormCost::Norm::kLInf:
      return std::make_shared<LInfNormCost>(A, b);
    case NormCost::Norm::kPerspectiveQuadratic:
      break;
  }
  return std::make_shared<PerspectiveQuadraticCost>(A, b);
}

/// weight >= 0 times the cost, likewise.
std::shared_ptr<Cost> OfPoints(const Cost& cost, const SparseMatrix& W, double weight) {
  if (const auto* linear = dynamic_cast<const LinearCost*>(&cost)) {
    return std::make_shared<LinearCost>(weight * (W.transpose() * linear->a()),
                                        weight * linear->b());
  }
  if (const auto* form = dynamic_cast<const QuadraticCost*>(&cost)) {
    return std::make_shared<QuadraticCost>(SparseMatrix(weight * Congruent(form->Q(), W)),
                                           weight * (W.transpose() * form->b()), weight * form->c(),
                                           form->is_convex() ? std::optional(true) : std::nullopt);
  }
  if (const auto* norm = dynamic_cast<const NormCost*>(&cost)) {
    return NormOf(norm->norm(), SparseMatrix(weight * (norm->A() * W)), weight * norm->b());
  }
  return nullptr;
}

/// What a parser says, behind the words that say where it stands.
template <class Parse>
auto Parsed(const std::string& call, Parse parse) {
  try {
    return parse();
  } catch (const InvalidArgument& e) {
    Refuse(call, ": ", e.what());
  }
}

}  // namespace

Binding<Constraint> KinematicTrajectoryOptimization::ConstraintAt(
    const std::string& call, const Binding<Constraint>& binding, double s) {
  const CurvePoint at = PointOf(call, binding.variables(), s);
  const auto& given = binding.evaluator();
  const auto* rows = dynamic_cast<const LinearConstraint*>(given.get());
  std::shared_ptr<Constraint> constraint;
  bool with_duration = at.moves();
  if (at.AllAre(0)) {
    constraint = OfPoints(*given, at.Map());
  } else if (rows != nullptr && (at.AllAre(1) || at.AllAre(2))) {
    constraint = MakePowerRows(
        SideRows(rows->get_sparse_A(), rows->lower_bound(), rows->upper_bound(), at.Map()),
        at.AllAre(1) ? 1 : 2);
  }
  if (constraint == nullptr) {
    if (with_duration) RequireDuration(call);
    constraint = std::make_shared<FunctionConstraint>(AtCurvePoint(given, at), given->lower_bound(),
                                                      given->upper_bound(),
                                                      !with_duration && given->is_convex());
  }
  constraint->set_description(Text(given->Name(), " at s = ", s));
  return {std::move(constraint), VariablesOf(at, with_duration)};
}

Binding<Cost> KinematicTrajectoryOptimization::CostAt(const std::string& call,
                                                      const Binding<Cost>& binding, double s,
                                                      double weight, bool timed) const {
  const CurvePoint at = PointOf(call, binding.variables(), s);
  const auto& given = binding.evaluator();
  std::shared_ptr<Cost> cost;
  if (at.AllAre(0) && !timed) cost = OfPoints(*given, at.Map(), weight);
  if (cost == nullptr) {
    if (at.moves()) RequireDuration(call);
    cost = std::make_shared<FunctionCost>(AtCurvePoint(given, at, weight, timed),
                                          !at.moves() && !timed && given->is_convex());
  }
  cost->set_description(Text(given->Name(), " at s = ", s));
  return {std::move(cost), VariablesOf(at, at.moves() || timed)};
}

std::vector<Binding<Constraint>> KinematicTrajectoryOptimization::AddConstraintAtNormalizedTimes(
    const Binding<Constraint>& binding, const VectorRef& s) {
  std::vector<Binding<Constraint>> all;
  for (const double one : s) {
    all.push_back(ConstraintAt("AddConstraintAtNormalizedTimes", binding, one));
  }
  for (const auto& one : all) program_.AddConstraint(one);
  return all;
}

std::vector<Binding<Constraint>> KinematicTrajectoryOptimization::AddConstraintAtNormalizedTimes(
    const FormulaList& formulas, const VectorRef& s) {
  return AddConstraintAtNormalizedTimes(
      Parsed("AddConstraintAtNormalizedTimes", [&] { return ParseConstraint(formulas); }), s);
}

std::vector<Binding<Cost>> KinematicTrajectoryOptimization::AddCostAtNormalizedTimes(
    const Binding<Cost>& binding, const VectorRef& s) {
  std::vector<Binding<Cost>> all;
  for (const double one : s) all.push_back(CostAt("AddCostAtNormalizedTimes", binding, one));
  for (const auto& one : all) program_.AddCost(one);
  return all;
}

std::vector<Binding<Cost>> KinematicTrajectoryOptimization::AddCostAtNormalizedTimes(
    const Expression& e, const VectorRef& s) {
  return AddCostAtNormalizedTimes(Parsed("AddCostAtNormalizedTimes", [&] { return ParseCost(e); }),
                                  s);
}

}  // namespace switchyard
