#include "core/functions/jacobian_rows.hpp"

#include <algorithm>
#include <functional>

namespace switchyard {

const std::vector<int>& Cones::Of(int root) {
  cone_.assign(1, root);
  seen_by_[root] = root;
  for (std::size_t k = 0; k < cone_.size(); ++k) {
    for (const Arc& arc : graph_.arcs(cone_[k])) {
      if (seen_by_[arc.u] == root) continue;
      seen_by_[arc.u] = root;
      cone_.push_back(arc.u);
    }
  }
  std::ranges::sort(cone_, std::greater());
  return cone_;
}

JacobianRows::JacobianRows(const Graph& graph) {
  Cones cones(graph);
  std::vector<int> row_of_node(graph.num_nodes, -1);
  for (const Slot output : graph.outputs) {
    if (!Constants::Is(output) && row_of_node[output] < 0) {
      row_of_node[output] = size();
      root.push_back(output);
      const std::vector<int>& cone = cones.Of(output);
      for (auto v = cone.rbegin(); v != cone.rend(); ++v) {
        if (*v < graph.num_inputs) col.push_back(*v);
        cone_arcs += std::ssize(graph.arcs(*v));
      }
      longest = std::max(longest, static_cast<int>(col.size()) - start.back());
      start.push_back(static_cast<int>(col.size()));
    }
    row_of_output.push_back(Constants::Is(output) ? -1 : row_of_node[output]);
  }
}

JacobianOrder ColumnByColumn(const JacobianRows& rows, int num_inputs) {
  std::vector<int> end(num_inputs + 1, 0);
  const auto for_each = [&](auto&& visit) {
    for (int i = 0; i < static_cast<int>(rows.row_of_output.size()); ++i) {
      if (rows.row_of_output[i] < 0) continue;
      const int row = rows.row_of_output[i];
      for (int k = rows.start[row]; k < rows.start[row + 1]; ++k) visit(i, rows.col[k], k);
    }
  };
  for_each([&](int, int j, int) { ++end[j + 1]; });
  for (int j = 0; j < num_inputs; ++j) end[j + 1] += end[j];
  JacobianOrder order;
  order.pattern.rows = static_cast<int>(rows.row_of_output.size());
  order.pattern.cols = num_inputs;
  order.pattern.row.resize(end.back());
  order.pattern.col.resize(end.back());
  order.source.resize(end.back());
  for_each([&](int i, int j, int k) {
    const int at = end[j]++;
    order.pattern.row[at] = i;
    order.pattern.col[at] = j;
    order.source[at] = k;
  });
  return order;
}

}  // namespace switchyard
