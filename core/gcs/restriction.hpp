// core/gcs/restriction.hpp - the program of one path.
#pragma once

#include <memory>
#include <vector>

#include "switchyard/gcs/graph_of_convex_sets.hpp"

namespace switchyard {

/// A path as its vertices: one more than edges. Throws InvalidArgument where an edge does not begin
/// where the one before ended.
std::vector<const GraphOfConvexSets::Vertex*> VerticesOf(
    const std::vector<const GraphOfConvexSets::Edge*>& edges);

/// Whose sets a restriction has.
enum class SetsOf { kAll, kWithoutVariables };

/// One x for each vertex, its set, and the terms tagged for the restriction, verbatim. A vertex or
/// an edge that the path visits twice stands once. kWithoutVariables: sets that are said with
/// variables of their own are left out, so that the program has none but the graph's.
std::unique_ptr<MathematicalProgram> RestrictionOf(
    const std::vector<const GraphOfConvexSets::Vertex*>& vertices,
    const std::vector<const GraphOfConvexSets::Edge*>& edges, SetsOf sets = SetsOf::kAll);

/// The start that a result of the graph gives the program of a path: points of vertices, slacks of
/// edges over phi; NaN where it has none.
Eigen::VectorXd StartFrom(const MathematicalProgramResult& result,
                          const MathematicalProgram& program,
                          const std::vector<const GraphOfConvexSets::Edge*>& edges);

}  // namespace switchyard
