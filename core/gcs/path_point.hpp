// core/gcs/path_point.hpp - a result's point in the placeholders of vertices and edges.
#pragma once

#include <vector>

#include "core/gcs/transcription.hpp"
#include "switchyard/gcs/shortest_path.hpp"

namespace switchyard {

/// A path, one point for each of its vertices, and the slacks of each of its edges.
struct PathPoints {
  std::vector<const GraphOfConvexSets::Edge*> edges;
  std::vector<Eigen::VectorXd> points;
  std::vector<Eigen::VectorXd> slacks;
};

/// Follows the flows above 1/2 in a point of the transcribed problem; none where they form no path.
PathPoints PathIn(const PrunedGraph& graph, const GcsTranscription& transcription,
                  const std::vector<double>& x);

/// phi = 1 on the path, 0 elsewhere; vertices off it have no solution.
void SetPathPoint(const GraphOfConvexSets& graph, const PathPoints& path,
                  MathematicalProgramResult& result);

/// phi, phi x_u and phi x_v of a point of the transcribed problem; x_v = sum_out y / sum_out phi
/// (in of z at the target) where flow passes.
void SetFlowPoint(const GraphOfConvexSets& graph, const PrunedGraph& pruned,
                  const GcsTranscription& transcription, const std::vector<double>& x,
                  MathematicalProgramResult& result);

}  // namespace switchyard
