// core/gcs/transcription.hpp - the shortest path as one sy_problem, with the hints that say what in
// it is a path.
#pragma once

#include <cstdint>
#include <deque>
#include <unordered_map>
#include <vector>

#include "core/gcs/perspective.hpp"
#include "core/gcs/pruning.hpp"
#include "core/problem/builder.hpp"
#include "switchyard/hints.h"

namespace switchyard {

/// An edge's part of the problem: phi, then y = phi x_u and z = phi x_v, then slacks. An end whose
/// set is a point has no variables: it is phi times the point.
struct EdgeVariables {
  std::int32_t phi = 0;
  std::int32_t y = -1;  // the first; -1: a point
  std::int32_t z = -1;
  std::int32_t slack = -1;
};

/// The program of a pruned graph, lean: no rows for two-cycles, linear costs in the objective, one
/// rotated cone for the squares of an edge, nothing for edges that are on no path. Triplets go
/// straight into the builder that lowering uses.
///
///   min   sum of the perspectives of costs at (phi_e, y_e, z_e)
///   flow      out - in = 1 at the source, -1 at the target, 0 elsewhere
///   degree    out <= 1 elsewhere
///   spatial   sum_out y - sum_in z = 0 elsewhere
///   block e   y_e in phi_e X_u, z_e in phi_e X_v, the edge's own constraints and those of u (of v
///             where v is the target)
///
/// Bounds of y, z are the sets' boxes, hulled with 0: implied. Stays in place while a backend holds
/// the problem.
class GcsTranscription {
 public:
  using Transcription = GraphOfConvexSets::Transcription;

  /// Throws InvalidArgument, naming it, for a term that has no perspective.
  GcsTranscription(const PrunedGraph& graph, Transcription as);
  GcsTranscription(const GcsTranscription&) = delete;
  GcsTranscription& operator=(const GcsTranscription&) = delete;

  [[nodiscard]] const Problem& problem() const { return problem_; }
  [[nodiscard]] const EdgeVariables& variables(std::size_t arc) const { return edges_[arc]; }
  /// Who solves and hears of paths; may be set until the problem is loaded.
  [[nodiscard]] sy_paths& paths() { return paths_; }

 private:
  /// The value of a column of a term: factor times a variable; no variable: factor is 0.
  struct Column {
    std::int32_t variable;
    double factor;
  };
  struct SetRecord {
    Csc At, Ft;
    sy_csc at, ft;
    sy_set record;
  };

  void WriteEdge(std::size_t arc);
  void AddEdgeVariables(std::size_t arc);
  std::int32_t AddPoint(const ConvexSet& set);
  void WriteMembership(const ConvexSet& set, std::int32_t phi, std::int32_t first);
  template <class Owner, class Terms>
  void WriteTerms(const Owner& owner, const Terms& terms, std::size_t arc);
  void WriteTerm(const Perspective& term, const VectorXDecisionVariable& variables,
                 std::size_t arc);
  void WriteCone(const ScaledSet& cone);
  void WriteSquares(std::int32_t phi);
  [[nodiscard]] Column ColumnOf(Variable variable, std::size_t arc) const;
  void WriteCoupling();
  void WriteSpatial(std::int32_t vertex, const std::vector<std::int32_t>& first_row);
  void CloseBlock();
  void WriteHints();
  void WritePoints(bool tails, Csc& matrix, sy_csc& view);
  const sy_set* RecordOf(const ConvexSet& set);

  const PrunedGraph& graph_;
  Transcription as_;
  ProblemBuilder builder_;
  Perspectives perspectives_;
  std::vector<EdgeVariables> edges_;
  std::vector<Column> columns_;  // of the term at hand: t, x, w
  struct Square {
    const Csc* S;
    std::size_t first;  // of its columns in square_columns_
  };
  std::vector<Square> squares_;  // of the edge at hand
  std::vector<Column> square_columns_;

  Problem problem_;
  std::int32_t block_ = 0;
  std::vector<std::int32_t> block_of_x_, block_of_row_, block_of_cone_;
  std::vector<std::int32_t> flow_, arcs_, dim_;
  Csc tail_point_, head_point_;
  std::deque<SetRecord> records_;
  std::unordered_map<const ConvexSet*, const sy_set*> record_of_;
  std::vector<const sy_set*> sets_;
  sy_blocks blocks_{};
  sy_paths paths_{};
  std::vector<sy_hint> hints_;
};

}  // namespace switchyard
