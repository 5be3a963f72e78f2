// Nearest points: min |y - x|_2 over the set.
#include "core/sets/set_program.hpp"
#include "switchyard/error.hpp"
#include "switchyard/sets/convex_set.hpp"
#include "switchyard/solve/solve.hpp"

namespace switchyard {

std::optional<std::pair<std::vector<double>, Eigen::MatrixXd>> ConvexSet::Projection(
    const Eigen::Ref<const Eigen::MatrixXd>& points) const {
  Require(points.rows() == dimension_, "points to be projected on a ", Kind(), " in R^", dimension_,
          " need ", dimension_, " rows, got ", points.rows());
  Require(points.allFinite(), "an entry of a point to be projected on a ", Kind(),
          " is not a finite number");
  if (IsEmpty()) return std::nullopt;
  std::vector<double> distances;
  Eigen::MatrixXd nearest = points;
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    if (dimension_ > 0) nearest.col(k) = DoNearestPoint(points.col(k));
    distances.push_back((nearest.col(k) - points.col(k)).norm());
  }
  return std::pair(std::move(distances), std::move(nearest));
}

// Squared, since a program with a quadratic objective is no harder than one with a cone, and its
// answer is the more accurate near the set. Its unit is the distance to a point of the set, so that
// the tolerances of a backend mean the same near and far.
Eigen::VectorXd ConvexSet::DoNearestPoint(const Eigen::VectorXd& x) const {
  if (Violation(x) == 0) return x;
  const double unit = (*MaybeGetFeasiblePoint() - x).norm();
  const int n = dimension_;
  MathematicalProgram program;
  const VectorXDecisionVariable step = program.NewContinuousVariables(n, "step");
  AddPointInNonnegativeScalingConstraints(&program, unit * Eigen::MatrixXd::Identity(n, n), x,
                                          Eigen::VectorXd(), 1, step, VariableList());
  program.AddQuadraticErrorCost(1.0, Eigen::VectorXd::Zero(n), step);
  const MathematicalProgramResult result = Solve(program);
  if (!result.is_success()) CouldNotTell(Kind(), "the point nearest to another", result);
  return x + unit * Eigen::VectorXd(result.GetSolution(step));
}

}  // namespace switchyard
