#include "switchyard/gcs/shortest_path.hpp"

#include "core/gcs/search.hpp"

namespace switchyard {

using Transcription = GraphOfConvexSets::Transcription;

struct ShortestPathSearch::Written {
  WrittenProgram relaxation{Transcription::kRelaxation};
  WrittenProgram whole{Transcription::kMIP};
};

ShortestPathSearch::ShortestPathSearch(const GraphOfConvexSets& graph, Host& host)
    : graph_(graph), host_(host), written_(std::make_unique<Written>()) {}
ShortestPathSearch::~ShortestPathSearch() = default;

ShortestPath ShortestPathSearch::Find(const GraphOfConvexSets::Vertex& source,
                                      const GraphOfConvexSets::Vertex& target,
                                      const GraphOfConvexSetsOptions& options) {
  graph_.RequireValid(source, "a shortest path");
  graph_.RequireValid(target, "a shortest path");
  const bool whole = Search::TranscriptionOf(options) == Transcription::kMIP;
  return Search(graph_, source, target, options, whole ? written_->whole : written_->relaxation,
                host_)
      .Run();
}

ShortestPath FindShortestPath(const GraphOfConvexSets& graph,
                              const GraphOfConvexSets::Vertex& source,
                              const GraphOfConvexSets::Vertex& target,
                              const GraphOfConvexSetsOptions& options, Host& host) {
  return ShortestPathSearch(graph, host).Find(source, target, options);
}

MathematicalProgramResult GraphOfConvexSets::SolveShortestPath(
    const Vertex& source, const Vertex& target, const GraphOfConvexSetsOptions& options) const {
  return FindShortestPath(*this, source, target, options).result;
}

}  // namespace switchyard
