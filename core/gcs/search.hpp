// core/gcs/search.hpp - one search for a shortest path, from the graph to the answer in its terms.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/gcs/path_point.hpp"
#include "core/gcs/pruning.hpp"
#include "core/gcs/term_tags.hpp"
#include "core/gcs/transcription.hpp"
#include "core/solve/choice.hpp"
#include "core/solve/recovery.hpp"
#include "switchyard/gcs/shortest_path.hpp"

namespace switchyard {

/// Its steps are the members, in the order in which Run calls them.
class Search {
 public:
  using Vertex = GraphOfConvexSets::Vertex;
  using Edge = GraphOfConvexSets::Edge;
  using Transcription = GraphOfConvexSets::Transcription;

  /// `written`: by the transcription that the options choose; see TranscriptionOf.
  Search(const GraphOfConvexSets& graph, const Vertex& source, const Vertex& target,
         const GraphOfConvexSetsOptions& options, WrittenProgram& written, Host& host);

  static Transcription TranscriptionOf(const GraphOfConvexSetsOptions& options) {
    return options.convex_relaxation == false ? Transcription::kMIP : Transcription::kRelaxation;
  }

  ShortestPath Run();

 private:
  struct Tried {
    std::unique_ptr<MathematicalProgram> program;
    MathematicalProgramResult result;
  };

  void OneVertex();
  bool Prune();
  void Transcribe();
  void WarnOfUnbounded();
  bool Load();
  [[nodiscard]] std::string AskedFirst(SolverOptions& options) const;
  void Solve();
  bool SolveOnce(const ProblemData& data);
  void SolveWhole();
  void Recover();
  void JudgeByTags();
  void RecoverWhole();
  void SupportOptimum(double cost);
  void RecoverFlow();
  void RecoverPath(const PathPoints& path, const Tried* tried = nullptr);
  double CheckPath(const PathPoints& path, const Tried* tried);
  void CapRelaxation();
  void RecoverRelaxation();
  void RecoverBestTried();
  [[nodiscard]] bool rounds() const;
  [[nodiscard]] std::vector<const Edge*> EdgesOf(const std::int32_t* arcs,
                                                 std::int32_t count) const;
  void SolvePath(const std::int32_t* arcs, std::int32_t count, const sy_control& control,
                 sy_result& result);
  [[nodiscard]] Tried SolveRestriction(const std::vector<const Edge*>& edges, SolverOptions options,
                                       const MathematicalProgramResult* guide) const;
  void Guide(const double* x);
  [[nodiscard]] bool GuideAlong(const std::vector<const Edge*>& edges, const double* x,
                                MathematicalProgramResult& guide) const;
  void Hear(const std::int32_t* arcs, std::int32_t count, const sy_result& result);
  MathematicalProgramResult& result() { return answer_.result; }
  [[nodiscard]] double Since(std::chrono::steady_clock::time_point start) const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  const GraphOfConvexSets& graph_;
  const Vertex& source_;
  const Vertex& target_;
  const GraphOfConvexSetsOptions& options_;
  WrittenProgram& written_;
  Host& host_;
  const Transcription as_;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  ShortestPath answer_;
  PrunedGraph pruned_;
  TermTags tags_;
  std::unique_ptr<GcsTranscription> transcription_;
  Problem forbidding_;  // the whole problem and what forbids cycles: in place while it is loaded
  BackendChoice choice_;
  std::unique_ptr<AnswerBuffers> raw_;
  bool failed_ = false;            // nothing came back
  bool relaxation_ended_ = false;  // by itself, not at a limit
  std::vector<double> relaxed_;
  std::mutex mutex_;
  /// The relaxation's flow and points, from when it is told on: where restrictions start.
  std::unique_ptr<const MathematicalProgramResult> guide_;
  std::map<std::vector<const Edge*>, Tried> tried_;  // by solve_path
};

}  // namespace switchyard
