// switchyard/gcs/graph.hpp - a directed graph whose vertices are convex sets, and the shortest path
// through one. Vertices and edges are defined in files of their own; graph_of_convex_sets.hpp has
// all three.
#pragma once

#include <compare>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/gcs/graphviz_options.hpp"
#include "switchyard/gcs/options.hpp"
#include "switchyard/model/program.hpp"
#include "switchyard/sets/convex_set.hpp"
#include "switchyard/solve/result.hpp"
#include "switchyard/symbolic/name_table.hpp"

namespace switchyard {

/// An id that cannot be mistaken for that of another thing.
template <class Tag>
struct Identifier {
  int value = -1;
  auto operator<=>(const Identifier&) const = default;
};

/// Vertices hold sets; a path picks one point in each of its vertices. The cost of a path is the
/// sum of the costs of its edges, functions of both end points, and of its vertices; constraints
/// likewise.
///
/// The graph owns its vertices and edges; they stay in place as long as it lives. What was removed
/// knows its id and its name, and that it was removed: every other call that is made on it, or is
/// given it, throws InvalidArgument. So does a call that is given a vertex or an edge of another
/// graph. Ids count from 0 in the order of addition and are not used again.
///
/// Not thread-safe while it changes; const members may be called from several threads.
class SWITCHYARD_EXPORT GraphOfConvexSets {
 public:
  /// Where a term counts: in the mixed-integer program, its convex relaxation, the restriction to
  /// one path.
  enum class Transcription { kMIP, kRelaxation, kRestriction };
  class TranscriptionSet {
   public:
    TranscriptionSet() : bits_(kAll) {}
    // NOLINTNEXTLINE(google-explicit-constructor): {Transcription::kMIP, ...}
    TranscriptionSet(std::initializer_list<Transcription> some) : bits_(0) {
      for (const Transcription t : some) bits_ |= Bit(t);
    }
    [[nodiscard]] bool contains(Transcription t) const { return (bits_ & Bit(t)) != 0; }
    [[nodiscard]] bool meets(TranscriptionSet other) const { return (bits_ & other.bits_) != 0; }
    friend bool operator==(TranscriptionSet, TranscriptionSet) = default;

   private:
    static std::uint8_t Bit(Transcription t) {
      return static_cast<std::uint8_t>(1u << static_cast<unsigned>(t));
    }
    static constexpr std::uint8_t kAll = 7;
    std::uint8_t bits_;
  };
  template <class B>
  struct Tagged {
    B binding;
    TranscriptionSet in;
  };

  using VertexId = Identifier<class VertexTag>;
  using EdgeId = Identifier<class EdgeTag>;
  class Vertex;
  class Edge;

  GraphOfConvexSets();
  GraphOfConvexSets(const GraphOfConvexSets&) = delete;
  GraphOfConvexSets& operator=(const GraphOfConvexSets&) = delete;
  ~GraphOfConvexSets();
  /// A graph of the same sets (shared), names, ids, costs, constraints, slacks and phi constraints,
  /// whose variables are its own. What was removed is not in it.
  [[nodiscard]] std::unique_ptr<GraphOfConvexSets> Clone() const;

  // ---- Vertices and edges ----

  /// The set is cloned; one that is shared already is not. No name: "v" and the id.
  Vertex* AddVertex(const ConvexSet& set, std::string name = "");
  Vertex* AddVertex(std::shared_ptr<const ConvexSet> set, std::string name = "");
  /// With the set, name, costs and constraints of a vertex, of this graph or another.
  Vertex* AddVertexFromTemplate(const Vertex& template_vertex);
  /// From u to v. Parallel edges and loops are legal; no simple path uses a loop.
  Edge* AddEdge(Vertex* u, Vertex* v, std::string name = "");
  /// With the name (where it was given), costs, constraints, slacks and phi constraint of an edge,
  /// of this graph or another. Throws InvalidArgument where the dimensions at the ends differ, and
  /// for an edge between two vertices of a loop, whose terms do not say which end they mean.
  Edge* AddEdgeFromTemplate(Vertex* u, Vertex* v, const Edge& template_edge);
  /// With its edges. What it takes grows with their number, not with the graph.
  void RemoveVertex(Vertex* vertex);
  void RemoveEdge(Edge* edge);

  /// The first in the order of addition of those that have the name; nullptr: none. The first
  /// question makes a table of all names; it is kept in step from then on.
  [[nodiscard]] const Vertex* GetVertexByName(const std::string& name) const;
  [[nodiscard]] Vertex* GetMutableVertexByName(const std::string& name);
  [[nodiscard]] const Edge* GetEdgeByName(const std::string& name) const;
  [[nodiscard]] Edge* GetMutableEdgeByName(const std::string& name);
  [[nodiscard]] int num_vertices() const { return num_vertices_; }
  [[nodiscard]] int num_edges() const { return num_edges_; }
  /// By id, without those that were removed.
  [[nodiscard]] std::vector<Vertex*> Vertices();
  [[nodiscard]] std::vector<const Vertex*> Vertices() const;
  [[nodiscard]] std::vector<Edge*> Edges();
  [[nodiscard]] std::vector<const Edge*> Edges() const;
  /// Is it of this graph, and not removed?
  [[nodiscard]] bool IsValid(const Vertex& v) const;
  [[nodiscard]] bool IsValid(const Edge& e) const;
  /// Throws InvalidArgument, in a sentence that begins with `caller` and names it, where it is not
  /// valid.
  void RequireValid(const Vertex& v, const char* caller) const;
  void RequireValid(const Edge& e, const char* caller) const;
  void ClearAllPhiConstraints();

  // ---- Paths ----

  /// The shortest path, by the way that the options choose; see ShortestPath for all that is found
  /// on the way. What is found is a value, also that there is no path. Throws InvalidArgument where
  /// a vertex is not of this graph, or a term cannot be transcribed.
  [[nodiscard]] MathematicalProgramResult SolveShortestPath(
      const Vertex& source, const Vertex& target,
      const GraphOfConvexSetsOptions& options = {}) const;
  /// Follows the flows of at least 1 - tolerance, the largest first, from source to target, no edge
  /// twice; of a path that visits a vertex twice the way between may be left out. No edges where
  /// source and target are the same. Throws InvalidArgument where the result has no flows or they
  /// form no path, and for a tolerance outside [0, 1).
  [[nodiscard]] std::vector<const Edge*> GetSolutionPath(const Vertex& source, const Vertex& target,
                                                         const MathematicalProgramResult& result,
                                                         double tolerance = 1e-3) const;
  /// Distinct simple paths, at most options.max_rounded_paths (10 where unset), by at most
  /// options.max_rounding_trials walks from the source: each leaves a vertex by an edge drawn with
  /// probability proportional to its flow among those above options.flow_tolerance to vertices that
  /// it has not visited, and goes back where there is none. The same for the same rounding_seed.
  /// Edges that `flows` lacks carry none.
  [[nodiscard]] std::vector<std::vector<const Edge*>> SamplePaths(
      const Vertex& source, const Vertex& target,
      const std::unordered_map<const Edge*, double>& flows,
      const GraphOfConvexSetsOptions& options) const;
  /// By the flows of a result. Throws InvalidArgument where it has none.
  [[nodiscard]] std::vector<std::vector<const Edge*>> SamplePaths(
      const Vertex& source, const Vertex& target, const MathematicalProgramResult& result,
      const GraphOfConvexSetsOptions& options) const;

  /// The best points of one path: one in each vertex, in its set, under the costs and constraints
  /// tagged for the restriction, which need not be convex. A vertex or edge that the path visits
  /// twice has one point and counts once. phi is 1 on the path and 0 elsewhere; phi constraints say
  /// nothing here. Solved by restriction_solver, else by `solver` (where that takes no such
  /// program, by the best that does, with a note), else by the best. `initial_guess`: a result of
  /// this graph; its points are the start, its slacks over phi. Throws InvalidArgument where the
  /// edges are no path; infeasible is a value.
  [[nodiscard]] MathematicalProgramResult SolveConvexRestriction(
      const std::vector<const Edge*>& active_edges, const GraphOfConvexSetsOptions& options = {},
      const MathematicalProgramResult* initial_guess = nullptr) const;
  /// The best of the paths through these vertices, one vertex being a path too: with parallel edges
  /// each combination is tried, those with phi fixed to 0 left out; up to 64. Where none has a
  /// solution, the first one's result, and why in notes for each. Throws InvalidArgument, naming
  /// the pair, where no edge leads from one vertex to the next or there are more combinations.
  [[nodiscard]] MathematicalProgramResult SolveConvexRestriction(
      std::span<const Vertex* const> active_vertices, const GraphOfConvexSetsOptions& options = {},
      const MathematicalProgramResult* initial_guess = nullptr) const;

  /// A drawing in the DOT language: a node for each vertex, an arrow for each edge, with what the
  /// options show of the result; the edges of `active_path` bold and red. Throws InvalidArgument
  /// for an edge that is not valid and a precision that is not in [0, 17].
  [[nodiscard]] std::string GetGraphvizString(
      const MathematicalProgramResult* result = nullptr, const GcsGraphvizOptions& options = {},
      const std::vector<const Edge*>* active_path = nullptr) const;

 private:
  struct Names;
  void Bury(Edge& edge);
  void NameVariables(const VectorXDecisionVariable& x, const std::string& base);
  [[nodiscard]] std::string NameOfPlaceholder(Variable variable) const;

  // By id; null: what is removed in the graph of which this is a clone.
  std::vector<std::unique_ptr<Vertex>> vertices_;
  std::vector<std::unique_ptr<Edge>> edges_;
  int num_vertices_ = 0;
  int num_edges_ = 0;
  std::unique_ptr<Names> names_;
  std::vector<std::shared_ptr<const NameBlock>> variable_names_;  // what a text calls them
};

}  // namespace switchyard
