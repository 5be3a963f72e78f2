// switchyard/gcs/graph_of_convex_sets.hpp - graphs of convex sets, whole: the graph, its vertices,
// its edges.
#pragma once

#include "switchyard/gcs/edge.hpp"    // IWYU pragma: export
#include "switchyard/gcs/graph.hpp"   // IWYU pragma: export
#include "switchyard/gcs/vertex.hpp"  // IWYU pragma: export
