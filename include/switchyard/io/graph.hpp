// switchyard/io/graph.hpp - graphs of convex sets from files and to files: gcs/1.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/gcs/graph_of_convex_sets.hpp"
#include "switchyard/io/file_error.hpp"
#include "switchyard/io/read.hpp"

namespace switchyard {

/// A graph, and the shortest path that is asked for in it.
struct GraphProblem {
  std::string name;
  std::string notes;
  /// What is known of the answer, by name: "optimum", "relaxation", "source", ...
  std::map<std::string, std::variant<double, std::string>> reference;
  std::unique_ptr<GraphOfConvexSets> graph;
  GraphOfConvexSets::Vertex* source = nullptr;  // of the graph, as the target
  GraphOfConvexSets::Vertex* target = nullptr;
};

/// The graph in a file of gcs/1; "-" is standard input; gzip is recognized by its first bytes.
/// Vertices and edges stand in the file's order; what entries of the tables say is one evaluator or
/// set, however many use it. Of an undirected graph each edge has its reverse behind it: the same
/// terms of the same two points.
/// Throws FileError where the file is not of its format, InvalidArgument where it cannot be read.
SWITCHYARD_EXPORT GraphProblem ReadGraph(const std::string& path, const ReadOptions& options = {});
/// The same of a text in memory; `name` is what errors call it.
SWITCHYARD_EXPORT GraphProblem ReadGraphText(std::string_view text, const std::string& name,
                                             const ReadOptions& options = {});

/// What gcs/1 cannot hold of the graph, a sentence each: slack variables, fixed flows, terms that
/// are not for all transcriptions, sets and functions of a user's class.
SWITCHYARD_EXPORT std::vector<std::string> CannotHold(const GraphProblem& problem);
/// Writes the graph; "-" is standard output; an ending ".gz" compresses. Throws InvalidArgument
/// with the sentences of CannotHold, and where source, target or graph are absent.
SWITCHYARD_EXPORT void WriteGraph(const GraphProblem& problem, const std::string& path,
                                  std::vector<std::string>* notes = nullptr);
/// The text that WriteGraph writes.
SWITCHYARD_EXPORT std::string GraphText(const GraphProblem& problem,
                                        std::vector<std::string>* notes = nullptr);

}  // namespace switchyard
