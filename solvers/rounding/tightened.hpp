// solvers/rounding/tightened.hpp - a path problem with cuts: rows that every path keeps and its
// relaxation does not.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "solvers/rounding/entries.hpp"
#include "solvers/rounding/path_problem.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::rounding {

/// The whole problem and its relaxation with what was added, for a backend to be loaded with.
///
/// A two-cycle row of u towards w: a path that goes from u to w does not come back, so with all
/// arcs between the two left out what flows out of u is still a multiple of a point of its set,
///
///   (t, W) = (out flows - all u->w - all w->u, out tails - tails of u->w - heads of w->u)
///
/// in the cone over the set, parallel arcs summed. Of a set's rows those are added that a point
/// violates, over the arcs' own variables: one row each, where all of (t, W) would be a block of
/// variables that meets as many coupling rows. Where a cone is violated, or the set has variables
/// of its own, it is that block.
class Tightened {
 public:
  /// Does the hint say where points stand and what sets they are of?
  static bool Serves(const PathProblem& whole);
  /// Of a problem that it serves.
  explicit Tightened(const PathProblem& whole);

  [[nodiscard]] const sy_problem& problem() const { return exact_.view(); }
  [[nodiscard]] const sy_problem& relaxation() const { return relaxed_.view(); }
  [[nodiscard]] int num_cuts() const { return num_cuts_; }

  /// Of the rows that x, a point of the relaxation, violates by more than `tolerance` in units of
  /// flow, those that are violated at least a tenth as much as the worst. How many there were.
  /// Only of vertices with at most `most_dim` coordinates.
  int AddTwoCycles(std::span<const double> x, double tolerance, std::int32_t most_dim);

  /// What leaves a vertex of a path has come from its source: for the vertices W that the flow of x
  /// does not reach from there, sum of flows into W - sum out of v >= 0 for each v of W that more
  /// than `tolerance` leaves. How many were new.
  int AddDetached(std::span<const double> x, double tolerance);

  /// sum of value x[variable] >= 0, a row that every path keeps.
  using Entry = rounding::Entry;
  void AddRow(const std::vector<Entry>& entries);
  void Count(int cuts) { num_cuts_ += cuts; }
  /// The problems with all that was added: empty before the first call.
  void Rebuild();

 private:
  struct Sum {  // linear in the variables of the problem
    std::vector<Entry> entries;
    double lower = 0, upper = 0;  // by their bounds
  };
  struct Cone {  // the left side of a two-cycle row
    std::int32_t vertex;
    Sum scale;
    std::vector<Sum> point;
    std::vector<double> factor;       // NaN: point[i] is not this times the scale
    std::vector<std::uint8_t> known;  // of each coordinate: do all arcs say it?
    [[nodiscard]] bool Knows(const sy_csc& by_rows, std::int32_t row) const;
    [[nodiscard]] bool KnowsAll() const;
  };

  void ListPairs();
  [[nodiscard]] Cone ConeOf(std::int32_t u, std::int32_t w) const;
  void Add(const sy_csc& points, std::int32_t column, double sign, Sum& sum) const;
  void AddFlow(std::int32_t arc, double sign, Sum& sum) const;
  struct Violated {
    std::int32_t u, w;
    std::int32_t row;  // of u's set; kScale: t >= 0; kWhole: all of it as a block
    double by;
    auto Key() const { return std::tuple(u, w, row); }
  };
  static constexpr std::int32_t kScale = -1, kWhole = -2;
  void Find(std::int32_t u, std::int32_t w, std::span<const double> x,
            std::vector<Violated>& violated) const;
  void Append(const Violated& violated);
  [[nodiscard]] static double ConeViolation(const sy_set& set, std::span<const double> at);
  void AddCombination(const Cone& cone, const sy_set& set, std::int32_t row);
  std::int32_t AddVariable(double lower, double upper, bool scale);
  void BeginRow(double lower, double upper, std::int32_t block);
  void AppendBlock(const Cone& cone, const sy_set& set);
  void AppendSet(const sy_set& set, std::span<const std::int32_t> column,
                 std::span<const double> factor, std::int32_t block);

  const PathProblem& whole_;
  const sy_problem& p_;
  Leaving in_;
  std::vector<std::int32_t> tail_first_, head_first_;         // columns of each arc's points
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs_;  // that have arcs both ways
  std::set<std::tuple<std::int32_t, std::int32_t, std::int32_t>> added_;
  int num_cuts_ = 0;

  // What is added: variables, rows by rows, cone rows by rows.
  std::vector<double> x_lower_, x_upper_, row_lower_, row_upper_;
  std::vector<std::uint8_t> is_scale_;
  std::vector<std::int32_t> block_of_x_, block_of_row_, block_of_cone_;
  std::int32_t num_blocks_;
  Rows rows_, cone_rows_;
  std::vector<sy_cone> cones_;

  Problem exact_, relaxed_;
  std::vector<std::int32_t> all_x_, all_rows_, all_cones_;
  sy_blocks blocks_{};
  std::vector<sy_hint> hints_;
};

}  // namespace switchyard::rounding
