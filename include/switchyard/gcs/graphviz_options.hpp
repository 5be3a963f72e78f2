// switchyard/gcs/graphviz_options.hpp - what the drawing of a graph shows.
#pragma once

namespace switchyard {

/// What a result adds to the names in GraphOfConvexSets::GetGraphvizString.
struct GcsGraphvizOptions {
  bool show_slacks = true;  // of edges
  bool show_vars = true;    // points of vertices; phi x_u and phi x_v of edges
  bool show_flows = true;   // as numbers, and edges the fainter the less flow they carry
  bool show_costs = true;
  bool scientific = false;  // numbers as 1.235e-04 instead of 0.000
  int precision = 3;        // digits behind the point
};

}  // namespace switchyard
