// Trajectory problems that several tests begin with.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "switchyard/sets/hpolyhedron.hpp"
#include "switchyard/sets/hyperrectangle.hpp"
#include "switchyard/sets/point.hpp"
#include "switchyard/trajectory/bezier_curve.hpp"
#include "switchyard/trajectory/gcs_trajectory_optimization.hpp"

namespace switchyard::testing {

// Before the process's own host is made.
[[maybe_unused]] inline const int set_before_main =
    setenv("SWITCHYARD_PLUGIN_PATH", SWITCHYARD_PLUGIN_FOLDER, 1);

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using Subgraph = GcsTrajectoryOptimization::Subgraph;
using EdgesBetween = GcsTrajectoryOptimization::EdgesBetweenSubgraphs;

inline VectorXd One(double x) { return VectorXd::Constant(1, x); }
inline ConvexSets At(const VectorXd& x) { return MakeConvexSets(Point(x)); }
inline ConvexSets Box(const VectorXd& lb, const VectorXd& ub) {
  return MakeConvexSets(Hyperrectangle(lb, ub));
}
inline ConvexSets Range(double lb, double ub) { return Box(One(lb), One(ub)); }

/// From a point through some regions to a point; all that is asked is asked by the test.
struct Through {
  Through(const VectorXd& from, const ConvexSets& regions, const VectorXd& to, int order,
          double h_min = 1e-6, double h_max = 20)
      : gcs(static_cast<int>(from.size())),
        rooms(gcs.AddRegions(regions, order, h_min, h_max, "rooms")),
        start(gcs.AddRegions(At(from), 0, 0, 0, "start")),
        goal(gcs.AddRegions(At(to), 0, 0, 0, "goal")),
        out(gcs.AddEdges(start, rooms)),
        in(gcs.AddEdges(rooms, goal)) {}
  [[nodiscard]] GcsTrajectory Find(const GraphOfConvexSetsOptions& options = {}) const {
    return gcs.FindPath(start, goal, options);
  }

  GcsTrajectoryOptimization gcs;
  Subgraph& rooms;
  Subgraph& start;
  Subgraph& goal;
  EdgesBetween& out;
  EdgesBetween& in;
};

/// Three rooms around a corner: the shortest way from (0.5, 0.5) to (4.5, 0.5) bends at (1, 2) and
/// (4, 2).
inline ConvexSets Corridor() {
  return MakeConvexSets(Hyperrectangle(Vector2d(0, 0), Vector2d(1, 3)),
                        HPolyhedron::MakeBox(Vector2d(0, 2), Vector2d(5, 3)),
                        Hyperrectangle(Vector2d(4, 0), Vector2d(5, 3)));
}
inline const Vector2d kCorridorStart(0.5, 0.5);
inline const Vector2d kCorridorGoal(4.5, 0.5);
inline const double kCorridorLength = 3 + std::sqrt(10.0);

/// The text of the InvalidArgument that is thrown.
template <class F>
std::string Thrown(F&& f) {
  try {
    f();
  } catch (const InvalidArgument& e) {
    return e.what();
  }
  return "nothing was thrown";
}

}  // namespace switchyard::testing
