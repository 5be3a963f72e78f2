// core/gcs/transcription.hpp - the shortest path as one sy_problem, with the hints that say what in
// it is a path.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/gcs/fixed_ends.hpp"
#include "core/gcs/idle_heads.hpp"
#include "core/gcs/pruning.hpp"
#include "core/gcs/term_block.hpp"
#include "core/gcs/transitions.hpp"
#include "core/gcs/written_program.hpp"
#include "switchyard/hints.h"

namespace switchyard {

/// The program of a pruned graph, lean: no rows for two-cycles, linear costs in the objective, one
/// rotated cone for the squares of a block, nothing for edges that are on no path.
///
///   min   sum of the perspectives of costs at (phi_e, y_e, z_e)
///   flow      out - in = 1 at the source, -1 at the target, 0 elsewhere
///   degree    out <= 1 elsewhere
///   spatial   sum_out y - sum_in z = 0 elsewhere
///   block e   y_e in phi_e X_u, z_e in phi_e X_v, the edge's own constraints and those of u (of v
///             where v is the target; v's constraints too where its set alone is not bounded,
///             so that z_e is 0 where phi_e is)
///
/// and at vertices that count transitions (e, f), instead of flow and spatial rows,
///   block ef  w_ef in lambda_ef X_v, the terms of v
///   flow      phi_e = sum_f lambda_ef, z_e = sum_f w_ef
///             phi_f = sum_e lambda_ef, y_f = sum_e w_ef
/// where the only transition from e, or to f, has no copy of its own: it is z_e, or y_f.
/// Coordinates that have but one value have no variable: they are phi times it; and heads have none
/// for those that say nothing there, see IdleHeads. Bounds of y, z and w are the sets' boxes,
/// hulled with 0: implied. Stays in place while a backend holds the problem.
class GcsTranscription {
 public:
  using Transcription = GraphOfConvexSets::Transcription;

  /// `transitions`: may vertices count them? `written`: by the same transcription of the same
  /// graph, of which one at a time is there; nullptr: nothing. Throws InvalidArgument, naming it,
  /// for a term that has no perspective.
  GcsTranscription(const PrunedGraph& graph, Transcription as, bool transitions = true,
                   WrittenProgram* written = nullptr);
  GcsTranscription(const GcsTranscription&) = delete;
  GcsTranscription& operator=(const GcsTranscription&) = delete;

  [[nodiscard]] const Problem& problem() const { return problem_; }
  /// Are its terms those of the restrictions to its paths?
  [[nodiscard]] bool same_terms() const { return same_terms_; }
  /// The variable of an arc's flow, and the first of its slacks; -1: it has none.
  [[nodiscard]] std::int32_t flow(std::size_t arc) const { return edges_[arc].phi; }
  [[nodiscard]] std::int32_t slack(std::size_t arc) const { return edges_[arc].slack; }
  /// phi x_u and phi x_v at a point of the problem; of an idle coordinate of x_v, phi times the
  /// mean of what leaves v.
  [[nodiscard]] Eigen::VectorXd TailOf(std::size_t arc, const std::vector<double>& x) const;
  [[nodiscard]] Eigen::VectorXd HeadOf(std::size_t arc, const std::vector<double>& x) const;
  /// What the blocks of some arcs, and of transitions between them, cost at a point.
  [[nodiscard]] double CostOf(const std::vector<std::int32_t>& arcs,
                              const std::vector<double>& x) const;
  /// Who solves and hears of paths; may be set until the problem is loaded.
  [[nodiscard]] sy_paths& paths() { return paths_; }

 private:
  struct EdgeVariables {
    std::int32_t phi = -1;
    std::int32_t slack = -1;
    std::int32_t tail = 0, head = 0;  // the first of its coordinates in the program's ends
  };
  struct TransitionVariables {
    std::int32_t lambda = -1, w = -1;  // -1: not its own
    std::int32_t block = -1;
  };

  void FindBlocks();
  [[nodiscard]] BlockKey KeyOf(std::size_t arc) const;
  [[nodiscard]] BlockKey KeyOf(const Transition& t) const;
  void WriteBlocks();
  void PlaceBlocks();
  std::int32_t AddVariables(std::int32_t count);
  void AddPoint(std::int32_t vertex);
  void AddEdgeVariables(std::size_t arc);
  void AddEnd(std::int32_t vertex, std::int32_t scale, std::span<const FixedCoordinate> fixed,
              const std::vector<std::uint8_t>& idle);
  [[nodiscard]] const std::vector<FixedCoordinate>* FixedOf(std::size_t arc) const {
    return blocks_of_edge_[arc].fixed[graph_.head[arc] == graph_.target ? 1 : 0];
  }
  void WriteEdge(std::size_t arc);
  void WriteTransition(const Transition& t);
  void WriteBlock(const TermBlock& block);
  void WriteRows(const TermBlock& block, std::int32_t own);
  void WriteCones(const TermBlock& block, std::int32_t own);
  template <class Take>
  void EachEntry(const PlacedRows& rows, std::size_t row, const TermBlock& block, std::int32_t own,
                 Take&& take) const;
  void WriteSquares(std::int32_t scale);
  void BeginRow(double lower, double upper);
  void DropRow();
  void WriteCoupling();
  void WriteFlow(std::int32_t vertex, std::span<const std::int32_t> in,
                 std::span<const std::int32_t> out);
  void WriteTransitionFlow(std::int32_t vertex, std::span<const std::int32_t> in,
                           std::span<const std::int32_t> out);
  void WriteSum(std::span<const std::int32_t> transitions, std::int32_t flow,
                std::span<const Column> end, const std::vector<std::uint8_t>& missing);
  /// Coordinates of an arc's head without a column; empty: none.
  [[nodiscard]] const std::vector<std::uint8_t>& MissingAt(std::size_t arc) const;
  /// The set's block without idle coordinates.
  [[nodiscard]] const TermBlock& KeptSet(std::int32_t vertex);
  [[nodiscard]] std::uint64_t IdleStamp(std::int32_t vertex) const;
  void Finish();
  void WriteHints();
  void WritePoints(bool tails, Csc& matrix, sy_csc& view) const;
  [[nodiscard]] static Eigen::VectorXd ValueOf(std::span<const Column> end,
                                               const std::vector<double>& x);
  /// Of a coordinate that an arc's head has no column for: the columns that add up to it; none
  /// where it is idle.
  [[nodiscard]] std::vector<Column> PartsOf(std::size_t arc, std::int32_t coordinate) const;

  /// phi times an arc's end point, by coordinate.
  [[nodiscard]] std::span<const Column> Tail(std::size_t arc) const;
  [[nodiscard]] std::span<const Column> Head(std::size_t arc) const;
  [[nodiscard]] std::int32_t DimensionAt(std::int32_t vertex) const {
    return graph_.vertices[static_cast<std::size_t>(vertex)]->ambient_dimension();
  }
  [[nodiscard]] Column CopyOf(const Transition& t, std::size_t k, std::int32_t i) const;
  [[nodiscard]] std::int32_t ScaleOf(const Transition& t, std::size_t k) const;
  [[nodiscard]] const std::optional<Eigen::VectorXd>& PointAt(std::int32_t vertex) const {
    return point_[static_cast<std::size_t>(vertex)];
  }

  const PrunedGraph& graph_;
  std::unique_ptr<WrittenProgram> own_;  // where none was given
  WrittenProgram& written_;
  BlockProgram& p_;  // the program as it is written
  Problem& problem_;
  std::vector<VertexBlocks> blocks_of_vertex_;
  std::vector<EdgeBlocks> blocks_of_edge_;  // by arc
  bool same_terms_ = true;
  TransitionPlan plan_;
  std::optional<IdleHeads> idle_;
  std::optional<Leaving> out_;
  std::vector<std::optional<Eigen::VectorXd>> point_;  // of each vertex whose set is one
  std::vector<EdgeVariables> edges_;
  std::vector<TransitionVariables> transitions_;

  std::vector<Column> columns_;          // of the places of the block at hand
  std::vector<Column> squares_;          // of the block at hand, row after row
  std::vector<std::size_t> square_end_;  // of each row

  std::int32_t block_ = -1;  // at hand
  PathLists& lists_;
  sy_blocks blocks_{};
  sy_paths paths_{};
  std::vector<sy_hint> hints_;
};

}  // namespace switchyard
