// From an answer of the program to the trajectory.
#include <algorithm>
#include <cmath>
#include <utility>

#include "switchyard/trajectory/efforts.hpp"
#include "switchyard/trajectory/kinematic_trajectory_optimization.hpp"

namespace switchyard {
namespace {

// Of the guess: a duration that is not above this share of it vanishes.
constexpr double kVanishing = 1e-9;
// Times at which efforts are verified, for each control point.
constexpr int kEffortSamples = 20;

std::string WordsOfVanishing(double duration, double guess) {
  return Text("the duration vanishes: ", duration, " s, where the guess has ", guess, " s");
}

}  // namespace

KinematicTrajectoryOptimization::Answer KinematicTrajectoryOptimization::AnswerOf(
    const std::string& call, const MathematicalProgramResult& result) const {
  Require(result.Knows(duration_), call,
          " needs a result with a point of prog(), got none: ", to_string(result.termination));
  Answer answer{result.GetSolution(control_points_), result.GetSolution(duration_)};
  Require(answer.duration > kVanishing * guessed_duration_, call, ": ",
          WordsOfVanishing(answer.duration, guessed_duration_));
  return answer;
}

BsplineTrajectory<double> KinematicTrajectoryOptimization::ReconstructTrajectory(
    const MathematicalProgramResult& result) const {
  const auto [points, duration] = AnswerOf("ReconstructTrajectory", result);
  std::vector<double> knots = basis_.knots();
  for (double& knot : knots) knot *= duration;
  std::vector<Eigen::MatrixXd> columns;
  for (Eigen::Index j = 0; j < points.cols(); ++j) columns.emplace_back(points.col(j));
  return {BsplineBasis<double>(basis_.order(), std::move(knots)), std::move(columns)};
}

std::vector<double> KinematicTrajectoryOptimization::BoundViolation(
    const MathematicalProgramResult& result) const {
  const auto [points, duration] = AnswerOf("BoundViolation", result);
  std::vector<double> worst(4, 0.0);
  for (const Bound& bound : bounds_) {
    const int k = bound.derivative_order;
    const Eigen::MatrixXd values = std::pow(duration, -k) * (points * basis_.DerivativeMap(k));
    const double below = (bound.lower.replicate(1, values.cols()) - values).maxCoeff();
    const double above = (values - bound.upper.replicate(1, values.cols())).maxCoeff();
    double& into = worst[static_cast<std::size_t>(k)];
    into = std::max({into, below, above});
  }
  return worst;
}

KinematicTrajectory KinematicTrajectoryOptimization::FindTrajectory(
    const SolverOptions& options, const SolverInterface* solver) const {
  KinematicTrajectory found;
  found.result = solver != nullptr ? solver->Solve(program_, std::nullopt, options)
                                   : Solve(program_, std::nullopt, options);
  if (found.result.primal == PointKind::kNone || found.result.primal == PointKind::kRay) {
    return found;
  }
  const double duration = found.result.GetSolution(duration_);
  if (duration <= kVanishing * guessed_duration_) {
    found.result.termination = Termination::kNumericalTrouble;
    found.result.notes.push_back(WordsOfVanishing(duration, guessed_duration_));
    return found;
  }
  found.trajectory = ReconstructTrajectory(found.result);
  found.bound_violation = BoundViolation(found.result);
  for (const EffortBound& bound : effort_bounds_) {
    found.effort_violation = std::max(
        found.effort_violation, EffortViolation(bound.model, *found.trajectory, bound.lower,
                                                bound.upper, kEffortSamples * num_control_points())
                                    .amount);
  }
  return found;
}

}  // namespace switchyard
