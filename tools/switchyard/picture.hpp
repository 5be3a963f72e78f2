// tools/switchyard/picture.hpp - a graph of convex sets and what was found in it, as SVG.
#pragma once

#include <string>

#include "switchyard/gcs/shortest_path.hpp"
#include "switchyard/io/graph.hpp"

namespace switchyard::cli {

/// The sets, the relaxed flow on each edge as the width of a line, the path with its points, source
/// and target, and a legend. Of more than two dimensions the first two are drawn. Where there is no
/// path, the lines run between the points of the flow, else between the middles of the sets.
std::string Picture(const GraphProblem& problem, const ShortestPath& found);

/// Writes it; "-" is standard output. Throws InvalidArgument where it cannot.
void WritePicture(const GraphProblem& problem, const ShortestPath& found, const std::string& path);

}  // namespace switchyard::cli
