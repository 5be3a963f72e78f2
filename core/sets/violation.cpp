// How far a point is from a set.
#include <algorithm>
#include <cmath>

#include "core/sets/section_lp.hpp"
#include "core/sets/set_program.hpp"
#include "switchyard/cones.hpp"
#include "switchyard/error.hpp"
#include "switchyard/sets/convex_set.hpp"
#include "switchyard/solve/solve.hpp"

namespace switchyard {
namespace {

// Per unit of the point's size.
constexpr double kLpAccuracy = 1e-11;
constexpr double kProgramAccuracy = 1e-8;

double OfRowsAndCones(const ScaledSet& set, const Eigen::VectorXd& x) {
  std::vector<double> at(static_cast<std::size_t>(set.num_columns()), 1.0);
  std::copy(x.data(), x.data() + x.size(), at.begin() + 1);
  std::vector<double> rows(static_cast<std::size_t>(set.A.rows), 0.0);
  std::vector<double> s(static_cast<std::size_t>(set.F.rows), 0.0);
  MultiplyAdd(set.A.View(), 1, at.data(), rows.data());
  MultiplyAdd(set.F.View(), 1, at.data(), s.data());
  double worst = 0;
  const auto see = [&worst](double violation) {
    if (!(violation <= worst)) worst = violation;  // NaN stays
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    see(std::max(set.lower[i] - rows[i], rows[i] - set.upper[i]));
  }
  const double* next = s.data();
  for (const sy_cone& cone : set.cones) {
    see(FactsOf(cone.kind).violation(next, cone.dim, cone.parameter));
    next += cone.dim;
  }
  return worst;
}

/// min v : x + d in the set, |d_i| <= v. Its duals are a direction in which x is proven to be
/// beyond the support function, so a bound of 0 or less is no proof that x is outside. v has an
/// upper bound where there is a box, so that the duals need not sum to 1 exactly.
double DistanceInLargestCoordinate(const ConvexSet& set, const Eigen::VectorXd& x) {
  const int n = set.ambient_dimension();
  const SetBox& box = set.bounding_box();
  MathematicalProgram program;
  const VectorXDecisionVariable d = program.NewContinuousVariables(n, "d");
  const VectorXDecisionVariable v = program.NewContinuousVariables(1, "v");
  set.AddPointInNonnegativeScalingConstraints(&program, Eigen::MatrixXd::Identity(n, n), x,
                                              Eigen::VectorXd(), 1, d, VariableList());
  for (const double sign : {1.0, -1.0}) {
    Eigen::MatrixXd rows(n, n + 1);
    rows << sign * Eigen::MatrixXd::Identity(n, n), -Eigen::VectorXd::Ones(n);
    program.AddLinearConstraint(rows, Eigen::VectorXd::Constant(n, -kInfinity),
                                Eigen::VectorXd::Zero(n), VariableList({d, v}));
  }
  const double farthest = std::max((box.upper - x).maxCoeff(), (x - box.lower).maxCoeff());
  program.AddBoundingBoxConstraint(box.lower - x, box.upper - x, d);
  program.AddBoundingBoxConstraint(0, 1.01 * farthest + 1, v);
  program.AddLinearCost(Eigen::VectorXd::Ones(1), v);
  const MathematicalProgramResult result = Solve(program);
  if (result.termination == Termination::kInfeasible) return kInfinity;
  if (!result.is_success()) CouldNotTell(set.Kind(), "whether a point is inside", result);
  if (!std::isnan(result.bound)) return std::max(0.0, result.bound);
  const double accuracy = kProgramAccuracy * (1 + x.lpNorm<Eigen::Infinity>());
  return result.objective <= accuracy ? 0 : result.objective;
}

}  // namespace

double ConvexSet::Violation(const VectorRef& x) const {
  Require(x.size() == dimension_, "a point of a ", Kind(), " needs ", dimension_, " entries, got ",
          x.size());
  return DoViolation(x);
}

double ConvexSet::DoViolation(const Eigen::VectorXd& x) const {
  if (scaled().num_aux == 0) return OfRowsAndCones(scaled(), x);
  if (dimension_ == 0) return IsEmpty() ? kInfinity : 0;
  if (!x.allFinite()) return x.hasNaN() ? std::nan("") : kInfinity;
  if (IsSmallPolyhedron(scaled())) {
    if (const auto distance = DistanceByLp(scaled(), x)) {
      return *distance <= kLpAccuracy * (1 + x.lpNorm<Eigen::Infinity>()) ? 0 : *distance;
    }
  }
  return DistanceInLargestCoordinate(*this, x);
}

bool ConvexSet::PointInSet(const VectorRef& x, double tolerance) const {
  return Violation(x) <= tolerance;
}

}  // namespace switchyard
