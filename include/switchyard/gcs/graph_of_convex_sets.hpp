// switchyard/gcs/graph_of_convex_sets.hpp - a directed graph whose vertices are convex sets, and
// the shortest path through one.
#pragma once

#include <compare>
#include <cstdint>
#include <deque>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/gcs/options.hpp"
#include "switchyard/model/program.hpp"
#include "switchyard/sets/convex_set.hpp"
#include "switchyard/solve/result.hpp"

namespace switchyard {

/// An id that cannot be mistaken for that of another thing.
template <class Tag>
struct Identifier {
  int value = -1;
  auto operator<=>(const Identifier&) const = default;
};

/// Vertices hold sets; a path picks one point in each of its vertices. The cost of a path is the
/// sum of the costs of its edges, functions of both end points, and of its vertices; constraints
/// likewise. Vertices and edges stay where they are until they are removed.
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
  class Edge;

  class SWITCHYARD_EXPORT Vertex final {
   public:
    Vertex(const Vertex&) = delete;
    Vertex& operator=(const Vertex&) = delete;
    [[nodiscard]] VertexId id() const { return id_; }
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] int ambient_dimension() const { return set_->ambient_dimension(); }
    /// Placeholders of its point, for costs and constraints.
    [[nodiscard]] const VectorXDecisionVariable& x() const { return x_; }
    [[nodiscard]] const ConvexSet& set() const { return *set_; }
    [[nodiscard]] const std::shared_ptr<const ConvexSet>& shared_set() const { return set_; }

    /// Throws InvalidArgument where a variable is not one of x().
    Binding<Cost> AddCost(const Binding<Cost>& binding, TranscriptionSet in = {});
    Binding<Constraint> AddConstraint(const Binding<Constraint>& binding, TranscriptionSet in = {});
    [[nodiscard]] std::vector<Binding<Cost>> GetCosts(TranscriptionSet in = {}) const;
    [[nodiscard]] std::vector<Binding<Constraint>> GetConstraints(TranscriptionSet in = {}) const;
    [[nodiscard]] const std::vector<Tagged<Binding<Cost>>>& costs() const { return costs_; }
    [[nodiscard]] const std::vector<Tagged<Binding<Constraint>>>& constraints() const {
      return constraints_;
    }

    /// The sum of its costs at the solution, weighted by the flow through it; none where there is
    /// no flow.
    [[nodiscard]] std::optional<double> GetSolutionCost(const MathematicalProgramResult& r) const;
    [[nodiscard]] std::optional<double> GetSolutionCost(const MathematicalProgramResult& r,
                                                        const Binding<Cost>& cost) const;
    /// Its point; none where no flow passes.
    [[nodiscard]] std::optional<Eigen::VectorXd> GetSolution(
        const MathematicalProgramResult& result) const;
    [[nodiscard]] const std::vector<Edge*>& incoming_edges() const { return incoming_; }
    [[nodiscard]] const std::vector<Edge*>& outgoing_edges() const { return outgoing_; }

   private:
    friend class GraphOfConvexSets;
    Vertex(VertexId id, std::shared_ptr<const ConvexSet> set, std::string name);
    VertexId id_;
    std::shared_ptr<const ConvexSet> set_;
    std::string name_;
    VectorXDecisionVariable x_;
    std::vector<Tagged<Binding<Cost>>> costs_;
    std::vector<Tagged<Binding<Constraint>>> constraints_;
    std::vector<Edge*> incoming_;
    std::vector<Edge*> outgoing_;
  };

  class SWITCHYARD_EXPORT Edge final {
   public:
    Edge(const Edge&) = delete;
    Edge& operator=(const Edge&) = delete;
    [[nodiscard]] EdgeId id() const { return id_; }
    /// The name given, or "(u, v)".
    [[nodiscard]] std::string name() const;
    [[nodiscard]] const Vertex& u() const { return *u_; }
    [[nodiscard]] Vertex& u() { return *u_; }
    [[nodiscard]] const Vertex& v() const { return *v_; }
    [[nodiscard]] Vertex& v() { return *v_; }
    /// Its flow; a placeholder, for GetSolution.
    [[nodiscard]] Variable phi() const { return Variable(first_id_); }
    [[nodiscard]] const VectorXDecisionVariable& xu() const { return u_->x(); }
    [[nodiscard]] const VectorXDecisionVariable& xv() const { return v_->x(); }
    /// Variables that belong to the edge, for its own costs and constraints.
    VectorXDecisionVariable NewSlackVariables(int rows, const std::string& name = "s");
    [[nodiscard]] const VectorXDecisionVariable& slacks() const { return slacks_; }

    /// Throws InvalidArgument where a variable is not one of xu(), xv() and the slacks.
    Binding<Cost> AddCost(const Binding<Cost>& binding, TranscriptionSet in = {});
    Binding<Constraint> AddConstraint(const Binding<Constraint>& binding, TranscriptionSet in = {});
    /// true: on the path; false: not on it.
    void AddPhiConstraint(bool phi_value) { phi_value_ = phi_value; }
    void ClearPhiConstraints() { phi_value_.reset(); }
    [[nodiscard]] std::optional<bool> phi_value() const { return phi_value_; }
    [[nodiscard]] std::vector<Binding<Cost>> GetCosts(TranscriptionSet in = {}) const;
    [[nodiscard]] std::vector<Binding<Constraint>> GetConstraints(TranscriptionSet in = {}) const;
    [[nodiscard]] const std::vector<Tagged<Binding<Cost>>>& costs() const { return costs_; }
    [[nodiscard]] const std::vector<Tagged<Binding<Constraint>>>& constraints() const {
      return constraints_;
    }

    /// The sum of phi g(x / phi) over its costs; 0 where phi is.
    [[nodiscard]] std::optional<double> GetSolutionCost(const MathematicalProgramResult& r) const;
    [[nodiscard]] std::optional<double> GetSolutionCost(const MathematicalProgramResult& r,
                                                        const Binding<Cost>& cost) const;
    [[nodiscard]] std::optional<Eigen::VectorXd> GetSolutionPhiXu(
        const MathematicalProgramResult& result) const;
    [[nodiscard]] std::optional<Eigen::VectorXd> GetSolutionPhiXv(
        const MathematicalProgramResult& result) const;

   private:
    friend class GraphOfConvexSets;
    Edge(EdgeId id, Vertex* u, Vertex* v, std::string name);
    void CheckVariables(const EvaluatorBase& evaluator,
                        const VectorXDecisionVariable& variables) const;
    EdgeId id_;
    Vertex* u_;
    Vertex* v_;
    std::string name_;
    Variable::Id first_id_;  // of phi, then phi x_u, then phi x_v
    VectorXDecisionVariable slacks_;
    std::optional<bool> phi_value_;
    std::vector<Tagged<Binding<Cost>>> costs_;
    std::vector<Tagged<Binding<Constraint>>> constraints_;
  };

  GraphOfConvexSets() = default;
  GraphOfConvexSets(const GraphOfConvexSets&) = delete;
  GraphOfConvexSets& operator=(const GraphOfConvexSets&) = delete;
  ~GraphOfConvexSets();
  /// A graph of the same sets, costs and constraints, whose vertices have variables of their own.
  [[nodiscard]] std::unique_ptr<GraphOfConvexSets> Clone() const;

  /// The set is cloned; one that is shared already is not.
  Vertex* AddVertex(const ConvexSet& set, std::string name = "");
  Vertex* AddVertex(std::shared_ptr<const ConvexSet> set, std::string name = "");
  /// Parallel edges are legal. Throws InvalidArgument where a vertex is not of this graph.
  Edge* AddEdge(Vertex* u, Vertex* v, std::string name = "");
  /// With its edges.
  void RemoveVertex(Vertex* vertex);
  void RemoveEdge(Edge* edge);
  /// nullptr: none of that name.
  [[nodiscard]] const Vertex* GetVertexByName(const std::string& name) const;
  [[nodiscard]] Vertex* GetMutableVertexByName(const std::string& name);
  [[nodiscard]] const Edge* GetEdgeByName(const std::string& name) const;
  [[nodiscard]] Edge* GetMutableEdgeByName(const std::string& name);
  [[nodiscard]] int num_vertices() const { return static_cast<int>(vertices_.size()); }
  [[nodiscard]] int num_edges() const { return static_cast<int>(edges_.size()); }
  [[nodiscard]] std::vector<Vertex*> Vertices();
  [[nodiscard]] std::vector<const Vertex*> Vertices() const;
  [[nodiscard]] std::vector<Edge*> Edges();
  [[nodiscard]] std::vector<const Edge*> Edges() const;
  [[nodiscard]] bool IsValid(const Vertex& v) const;
  [[nodiscard]] bool IsValid(const Edge& e) const;
  void ClearAllPhiConstraints();

  /// The shortest path, by the way that the options choose; see ShortestPath for all that is found
  /// on the way. What is found is a value, also that there is no path. Throws InvalidArgument where
  /// a vertex is not of this graph, or a term cannot be transcribed.
  [[nodiscard]] MathematicalProgramResult SolveShortestPath(
      const Vertex& source, const Vertex& target,
      const GraphOfConvexSetsOptions& options = {}) const;
  /// Follows the flows above 1 - tolerance from source to target. Throws std::runtime_error where
  /// they form no path.
  [[nodiscard]] std::vector<const Edge*> GetSolutionPath(const Vertex& source, const Vertex& target,
                                                         const MathematicalProgramResult& result,
                                                         double tolerance = 1e-3) const;
  /// Distinct paths drawn by the flows; see mathematics of the sampling walk in arcs.hpp.
  [[nodiscard]] std::vector<std::vector<const Edge*>> SamplePaths(
      const Vertex& source, const Vertex& target,
      const std::unordered_map<const Edge*, double>& flows,
      const GraphOfConvexSetsOptions& options) const;
  [[nodiscard]] std::vector<std::vector<const Edge*>> SamplePaths(
      const Vertex& source, const Vertex& target, const MathematicalProgramResult& result,
      const GraphOfConvexSetsOptions& options) const;
  /// One point in each vertex of the path, its sets, and the terms tagged for the restriction.
  /// Throws InvalidArgument where the edges are no path.
  [[nodiscard]] MathematicalProgramResult SolveConvexRestriction(
      const std::vector<const Edge*>& active_edges, const GraphOfConvexSetsOptions& options = {},
      const MathematicalProgramResult* initial_guess = nullptr) const;

 private:
  std::map<VertexId, std::unique_ptr<Vertex>> vertices_;
  std::map<EdgeId, std::unique_ptr<Edge>> edges_;
  int next_vertex_ = 0;
  int next_edge_ = 0;
};

}  // namespace switchyard
