// How far a trajectory is from what was asked of it, by its control points and by samples.
#include <algorithm>
#include <cmath>

#include "core/trajectory/trajectory_problem.hpp"
#include "switchyard/trajectory/bezier_curve.hpp"

namespace switchyard {
namespace {

constexpr int kSamples = 8;  // between the ends of a segment

void Raise(double value, double& worst) { worst = std::max(worst, value); }

/// Of each column from the bound.
double Excess(const Eigen::MatrixXd& derivatives, const DerivativeBound& bound) {
  double worst = 0;
  for (const auto& column : derivatives.colwise()) {
    Raise((column - bound.upper).maxCoeff(), worst);
    Raise((bound.lower - column).maxCoeff(), worst);
  }
  return worst;
}

/// The k-th derivative's control points, by r's parameter.
Eigen::MatrixXd PathDerivative(const PathPiece& piece, int k) {
  return piece.points * BezierDerivativeMap(static_cast<int>(piece.points.cols()) - 1, k);
}

/// By time; where there is none, by r's parameter.
Eigen::MatrixXd Derivative(const PathPiece& piece, int k) {
  const double h = piece.duration > kNoTime ? piece.duration : 1;
  return PathDerivative(piece, k) / std::pow(h, k);
}

void VerifyPiece(const PathPiece& piece, TrajectoryViolation& violation) {
  const SegmentGroup& segments = piece.subgraph->segments;
  const ConvexSet& region = *piece.subgraph->regions[piece.region];
  for (const auto& point : piece.points.colwise()) {
    Raise(region.Violation(point), violation.regions);
  }
  if (segments.shape.order > 0 || segments.shape.h_min > 0) {
    Raise(segments.shape.h_min - piece.duration, violation.durations);
    Raise(piece.duration - segments.shape.h_max, violation.durations);
  }
  for (const DerivativeBound& bound : segments.demands.bounds) {
    Raise(Excess(Derivative(piece, bound.order), bound), violation.derivative_bounds);
  }
}

void RaiseAt(int k, double value, std::vector<double>& by_order) {
  if (k >= std::ssize(by_order)) by_order.resize(static_cast<std::size_t>(k) + 1, 0.0);
  Raise(value, by_order[static_cast<std::size_t>(k)]);
}

void VerifyJoint(const PathPiece& u, const PathPiece& v, const TrajectoryProblem::OfEdge& of,
                 TrajectoryViolation& violation) {
  const JointGroup& joints = *of.joints;
  const Eigen::VectorXd end = u.points.rightCols<1>() + joints.OffsetOf(of.edge);
  Raise((end - v.points.col(0)).cwiseAbs().maxCoeff(), violation.continuity[0]);
  const auto jump = [&](auto derivative, int k) {
    const Eigen::VectorXd before = derivative(u, k).template rightCols<1>();
    const Eigen::VectorXd after = derivative(v, k).col(0);
    return (before - after).cwiseAbs().maxCoeff();
  };
  for (const int k : joints.demands.time_continuity) {
    RaiseAt(k, jump(Derivative, k), violation.continuity);
  }
  for (const int k : joints.demands.path_continuity) {
    RaiseAt(k, jump(PathDerivative, k), violation.path_continuity);
  }
  for (const DerivativeBound& bound : joints.demands.bounds) {
    if (bound.order <= joints.shape.u.order) {
      const Eigen::MatrixXd last = Derivative(u, bound.order).rightCols<1>();
      Raise(Excess(last, bound), violation.derivative_bounds);
    }
    if (bound.order <= joints.shape.v.order) {
      const Eigen::MatrixXd first = Derivative(v, bound.order).leftCols<1>();
      Raise(Excess(first, bound), violation.derivative_bounds);
    }
  }
}

/// The trajectory as it is given, at its own times; sets with variables of their own, of which a
/// sample may be a program, are left to their control points.
void VerifySamples(const PathPiece& piece, const Trajectory<double>& segment,
                   TrajectoryViolation& violation) {
  const ConvexSet& region = *piece.subgraph->regions[piece.region];
  const bool closed_form = region.scaled().num_aux == 0;
  for (int j = 0; j <= kSamples + 1; ++j) {
    const double share = j / (kSamples + 1.0);
    const double t = (1 - share) * segment.start_time() + share * segment.end_time();
    if (closed_form) Raise(region.Violation(segment.value(t)), violation.regions);
    for (const DerivativeBound& bound : piece.subgraph->segments.demands.bounds) {
      Raise(Excess(segment.EvalDerivative(t, bound.order), bound), violation.derivative_bounds);
    }
  }
}

}  // namespace

TrajectoryViolation Verify(const TrajectoryProblem& problem, const std::vector<PathPiece>& pieces,
                           const std::vector<const GraphOfConvexSets::Edge*>& edges,
                           const CompositeTrajectory<double>& trajectory) {
  TrajectoryViolation violation;
  violation.continuity = {0.0};
  int segment = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    VerifyPiece(pieces[k], violation);
    if (pieces[k].has_time) VerifySamples(pieces[k], trajectory.segment(segment++), violation);
    if (k + 1 < pieces.size()) {
      const auto id = static_cast<std::size_t>(edges[k]->id().value);
      VerifyJoint(pieces[k], pieces[k + 1], problem.of_edge[id], violation);
    }
  }
  return violation;
}

}  // namespace switchyard
