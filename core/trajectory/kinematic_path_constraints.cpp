// Constraints of the path and its derivatives at one normalized time.
#include <utility>

#include "core/trajectory/kinematic_point.hpp"
#include "core/trajectory/kinematic_rows.hpp"
#include "switchyard/trajectory/kinematic_trajectory_optimization.hpp"

namespace switchyard {
namespace {

bool IsIdentity(const SparseMatrix& W) {
  if (W.rows() != W.cols() || W.nonZeros() != W.rows()) return false;
  for (int i = 0; i < W.rows(); ++i) {
    if (W.coeff(i, i) != 1) return false;
  }
  return true;
}

void RequireConstraint(const std::string& call, const std::shared_ptr<Constraint>& constraint,
                       int num_vars, const char* of) {
  Require(constraint != nullptr, call, " needs a constraint, got a null pointer");
  Require(constraint->num_vars() == num_vars, call, " needs a constraint of ", num_vars,
          " variables, ", of, ", got one of ", constraint->num_vars());
}

}  // namespace

Binding<LinearConstraint> KinematicTrajectoryOptimization::AddPathRows(const std::string& call,
                                                                       const VectorRef& lb,
                                                                       const VectorRef& ub,
                                                                       double s,
                                                                       int derivative_order) {
  CheckBounds(call, lb, ub);
  const CurvePoint at = PointOf(call, placeholders_[static_cast<std::size_t>(derivative_order)], s);
  SparseMatrix W = at.Map();
  std::shared_ptr<LinearConstraint> rows;
  if (IsIdentity(W)) {
    rows = std::make_shared<BoundingBoxConstraint>(lb, ub);
  } else {
    rows = std::make_shared<LinearConstraint>(std::move(W), lb, ub);
  }
  rows->set_description(Text(call.substr(3), " at s = ", s));
  return program_.AddConstraint(rows, VariablesOf(at, false));
}

Binding<LinearConstraint> KinematicTrajectoryOptimization::AddPathPositionConstraint(
    const VectorRef& lb, const VectorRef& ub, double s) {
  return AddPathRows("AddPathPositionConstraint", lb, ub, s, 0);
}

Binding<LinearConstraint> KinematicTrajectoryOptimization::AddPathVelocityConstraint(
    const VectorRef& lb, const VectorRef& ub, double s) {
  return AddPathRows("AddPathVelocityConstraint", lb, ub, s, 1);
}

Binding<LinearConstraint> KinematicTrajectoryOptimization::AddPathAccelerationConstraint(
    const VectorRef& lb, const VectorRef& ub, double s) {
  return AddPathRows("AddPathAccelerationConstraint", lb, ub, s, 2);
}

Binding<Constraint> KinematicTrajectoryOptimization::AddPathPositionConstraint(
    const std::shared_ptr<Constraint>& constraint, double s) {
  constexpr const char* kCall = "AddPathPositionConstraint";
  RequireConstraint(kCall, constraint, num_positions(), "one for each position");
  return program_.AddConstraint(ConstraintAt(kCall, Binding<Constraint>(constraint, q()), s));
}

Binding<Constraint> KinematicTrajectoryOptimization::AddVelocityConstraintAtNormalizedTime(
    const std::shared_ptr<Constraint>& constraint, double s) {
  constexpr const char* kCall = "AddVelocityConstraintAtNormalizedTime";
  RequireConstraint(kCall, constraint, 2 * num_positions(), "positions and then velocities");
  return program_.AddConstraint(
      ConstraintAt(kCall, Binding<Constraint>(constraint, {q(), qdot()}), s));
}

std::vector<Binding<LinearConstraint>>
KinematicTrajectoryOptimization::AddVelocityConstraintAtNormalizedTime(
    const Binding<LinearConstraint>& binding, double s) {
  constexpr const char* kCall = "AddVelocityConstraintAtNormalizedTime";
  const CurvePoint at = PointOf(kCall, binding.variables(), s);
  Require(at.AllAre(1), kCall, " needs a linear constraint of qdot() alone, got ",
          binding.evaluator()->Name(), " of q() or qddot()");
  const LinearConstraint& rows = *binding.evaluator();
  std::vector<Binding<LinearConstraint>> added;
  using Sides = SideRows::Sides;
  for (const Sides sides : {Sides::kEqual, Sides::kLower, Sides::kUpper}) {
    const SideRows some(rows.get_sparse_A(), rows.lower_bound(), rows.upper_bound(), at.Map(),
                        sides);
    if (some.empty()) continue;
    const auto constraint = some.OfDuration();
    constraint->set_description(Text(rows.Name(), " at s = ", s));
    added.push_back(program_.AddConstraint(constraint, VariablesOf(at, true)));
  }
  return added;
}

}  // namespace switchyard
