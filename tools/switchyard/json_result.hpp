// tools/switchyard/json_result.hpp - result/1 and solution files.
#pragma once

#include <optional>
#include <string>

#include "starts.hpp"
#include "switchyard/gcs/shortest_path.hpp"
#include "switchyard/io/graph.hpp"
#include "switchyard/solve/result.hpp"

namespace switchyard::cli {

/// Writes result/1 to `path`, "-" being standard output, with what the solves from many starts came
/// to where there were such. Throws InvalidArgument where it cannot.
void WriteResult(const MathematicalProgram& program, const MathematicalProgramResult& result,
                 const std::optional<StartCounts>& starts, const std::string& path);

/// The same of a plan, with path, points and what was tried; edges are numbered as in the file.
void WritePlanResult(const GraphProblem& problem, const ShortestPath& found,
                     const std::string& path);

/// {"variables": {name: value}, "rows": {name: dual}}.
void WriteSolution(const MathematicalProgram& program, const MathematicalProgramResult& result,
                   const std::string& path);

/// The same of a plan: "VERTEX.x[0]" for each vertex and "EDGE.flow" for each edge that has flow.
void WritePlanSolution(const GraphProblem& problem, const ShortestPath& found,
                       const std::string& path);

}  // namespace switchyard::cli
