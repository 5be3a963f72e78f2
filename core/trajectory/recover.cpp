// The points of a path as a trajectory, and what is said of it.
#include <algorithm>
#include <cmath>

#include "core/trajectory/trajectory_problem.hpp"
#include "switchyard/trajectory/bezier_curve.hpp"

namespace switchyard {
namespace {

// What an interior point leaves of a duration that may be 0 and wants to be.
constexpr double kNearlyNoTime = 1e-7;
constexpr double kSamePoint = 1e-6;  // of control points of a segment without time
constexpr double kTolerance = 1e-5;  // of what interior points leave, relative to the points
constexpr double kWholeFlow = 1 - 1e-3;

struct Pieces {
  std::vector<PathPiece> all;
  const PathPiece* stuck = nullptr;  // no time, and not one point
};

Pieces PiecesOf(const TrajectoryProblem& problem, const SegmentPath& path) {
  Pieces pieces;
  for (std::size_t k = 0; k < path.vertices.size(); ++k) {
    const auto id = static_cast<std::size_t>(path.vertices[k]->id().value);
    const TrajectoryProblem::OfVertex& of = problem.of_vertex[id];
    const SegmentShape& shape = of.subgraph->segments.shape;
    const Eigen::VectorXd& x = path.points[k];
    pieces.all.push_back({of.subgraph, of.region,
                          x.head(shape.duration()).reshaped(shape.num_positions, shape.order + 1),
                          x[shape.duration()], true});
  }
  for (PathPiece& piece : pieces.all) {
    const SegmentShape& shape = piece.subgraph->segments.shape;
    if (shape.order == 0 && shape.h_min == 0) {
      piece.has_time = false;
    } else if (piece.duration < (shape.h_min < kNoTime ? kNearlyNoTime : kNoTime)) {
      piece.has_time = false;
      const auto spread = piece.points.colwise() - piece.points.col(0);
      if (spread.cwiseAbs().maxCoeff() > kSamePoint) pieces.stuck = &piece;
    }
  }
  return pieces;
}

CompositeTrajectory<double> TrajectoryOf(const std::vector<PathPiece>& pieces) {
  std::vector<TrajectoryPointer<double>> segments;
  double time = 0;
  for (const PathPiece& piece : pieces) {
    if (!piece.has_time) continue;
    const double end = time + piece.duration;
    segments.push_back(BezierCurve<double>(time, end, piece.points));
    time = end;
  }
  return CompositeTrajectory<double>(std::move(segments));
}

void Fold(const TrajectoryViolation& violation, Violation& into) {
  into.rows = std::max({into.rows, violation.regions, violation.continuity[0]});
  into.bounds = std::max(into.bounds, violation.durations);
  into.nonlinear = std::max(into.nonlinear, violation.derivative_bounds);
  for (const double jump : violation.continuity) into.nonlinear = std::max(into.nonlinear, jump);
  for (const double jump : violation.path_continuity) into.rows = std::max(into.rows, jump);
}

/// Says why it is none after all.
void Withdraw(MathematicalProgramResult& result, Termination termination, std::string why) {
  result.notes.push_back(why);
  if (!result.is_success()) return;
  result.termination = termination;
  result.message = std::move(why);
}

void Judge(const Pieces& pieces, const SegmentPath& path, GcsTrajectory& found) {
  double size = 0;
  for (const PathPiece& piece : pieces.all) {
    size = std::max(size, piece.points.cwiseAbs().maxCoeff());
  }
  const double allowed = kTolerance * (1 + size);
  const TrajectoryViolation& violation = found.violation;
  MathematicalProgramResult& result = found.search.result;
  found.is_continuous = violation.continuity[0] <= allowed;
  if (path.flow < kWholeFlow) {
    Withdraw(
        result, Termination::kNoPath,
        Text("the relaxation alone is no solution: the flow along the trajectory is ", path.flow,
             " of 1, and its segments miss each other by up to ", violation.continuity[0]));
  } else if (!found.is_continuous) {
    Withdraw(result, Termination::kNumericalTrouble,
             Text("our check finds segments that miss each other by ", violation.continuity[0]));
  }
  if (pieces.stuck != nullptr) {
    Withdraw(result, Termination::kNumericalTrouble,
             Text("segment of zero duration and nonzero length at subgraph ",
                  pieces.stuck->subgraph->name, ": set h_min or velocity bounds"));
  }
  if (violation.regions > allowed || violation.durations > allowed) {
    Withdraw(
        result, Termination::kNumericalTrouble,
        Text("our check finds a control point ", violation.regions,
             " outside its region, and a duration ", violation.durations, " outside its range"));
  }
}

}  // namespace

double TrajectoryViolation::max() const {
  double worst = std::max({regions, durations, derivative_bounds});
  for (const double jump : continuity) worst = std::max(worst, jump);
  for (const double jump : path_continuity) worst = std::max(worst, jump);
  return worst;
}

void RecoverTrajectory(const TrajectoryProblem& problem, const SegmentPath& path,
                       GcsTrajectory& found) {
  found.violation.continuity = {0.0};
  if (path.vertices.empty()) return;
  const Pieces pieces = PiecesOf(problem, path);
  found.vertices = path.vertices;
  for (std::size_t k = 0; k < pieces.all.size(); ++k) {
    if (pieces.all[k].has_time) found.segment_vertices.push_back(path.vertices[k]);
  }
  found.trajectory = TrajectoryOf(pieces.all);
  found.violation = Verify(problem, pieces.all, path.edges, found.trajectory);
  Fold(found.violation, found.search.result.violation);
  Judge(pieces, path, found);
}

}  // namespace switchyard
