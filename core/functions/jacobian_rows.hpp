// core/functions/jacobian_rows.hpp - on what each output of a graph depends.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/functions/graph.hpp"
#include "switchyard/functions/function.hpp"

namespace switchyard {

/// The nodes that a node depends on.
class Cones {
 public:
  explicit Cones(const Graph& graph) : graph_(graph), seen_by_(graph.num_nodes, -1) {}
  /// `root` and what it depends on, each node after all those that use it; until the next call.
  const std::vector<int>& Of(int root);

 private:
  const Graph& graph_;
  std::vector<int> seen_by_;
  std::vector<int> cone_;
};

/// The structure of the Jacobian by rows. Outputs that are one node share their row.
struct JacobianRows {
  explicit JacobianRows(const Graph& graph);

  std::vector<int> row_of_output;  // -1 for a constant
  std::vector<int> root;           // the node of each row
  std::vector<int> start = {0};
  std::vector<int> col;        // ascending in each row
  std::int64_t cone_arcs = 0;  // over all rows
  int longest = 0;

  [[nodiscard]] int size() const { return static_cast<int>(root.size()); }
  [[nodiscard]] std::span<const int> cols(int row) const {
    return std::span(col).subspan(start[row], start[row + 1] - start[row]);
  }
};

/// Entry k of the pattern stands at place `source[k]` of rows.col.
struct JacobianOrder {
  SparsityPattern pattern;  // column by column
  std::vector<int> source;
};
JacobianOrder ColumnByColumn(const JacobianRows& rows, int num_inputs);

}  // namespace switchyard
