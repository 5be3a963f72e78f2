// core/functions/compressed_jacobian.hpp - a Jacobian by forward sweeps in compressed columns.
#pragma once

#include <cstdint>
#include <vector>

#include "core/functions/graph.hpp"
#include "core/functions/jacobian_rows.hpp"

namespace switchyard {

/// Columns of which no two have an entry in one row share a colour, and the sum of the columns of a
/// colour, J s, holds each of their entries alone (Curtis, Powell, Reid, "On the estimation of
/// sparse Jacobian matrices", 1974). A sweep carries kLanes colours at once:
///   (dv/ds) = sum over operands u of (dv/du) (du/ds).
class CompressedJacobian {
 public:
  static constexpr int kLanes = 8;

  /// The time of `num_colors` colours in products of a planned sum. A product of a sweep costs a
  /// quarter of one: its lanes stand side by side.
  static double Work(const Graph& graph, int num_colors);
  /// A colour for each column, greedily in their order. Linear in the sum of squares of the
  /// lengths of rows.
  static std::vector<int> Colors(const JacobianRows& rows, int num_inputs);

  CompressedJacobian(const Graph& graph, const JacobianRows& rows, const JacobianOrder& order,
                     std::vector<int> colors);

  [[nodiscard]] int num_tangents() const { return num_tangents_; }
  [[nodiscard]] std::int64_t num_products() const;
  void Run(const Graph& graph, const double* slots, double* tangents, double* jacobian) const;

 private:
  struct Entry {
    int k;        // of the pattern
    int tangent;  // where it is after the sweep
  };
  template <bool guarded>
  void Sweep(const Graph& graph, const double* slots, double* tangents) const;

  std::vector<int> color_;
  int num_sweeps_ = 0;
  int num_arcs_;
  int num_tangents_;
  std::vector<Entry> entry_;      // by sweeps
  std::vector<int> entry_start_;  // of each sweep
};

}  // namespace switchyard
