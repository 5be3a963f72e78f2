// core/gcs/detached_cycles.hpp - cycles that integral flows have beside a path.
#pragma once

#include <vector>

#include "core/gcs/pruning.hpp"
#include "core/gcs/transcription.hpp"
#include "switchyard/problem.hpp"

namespace switchyard {

/// Adds to the problem, for each cycle beside the path in the flows of x (those above 1/2) that
/// costs less than nothing or holds an edge that must be on the path, the rows that no path
/// violates: what leaves a vertex of the cycle has come into the cycle,
///
///   sum of phi into W - sum of phi out of v >= 0   for each v in W.
///
/// Were there any?
bool ForbidCycles(const PrunedGraph& graph, const GcsTranscription& transcription,
                  const std::vector<double>& x, ProblemData& problem);

}  // namespace switchyard
