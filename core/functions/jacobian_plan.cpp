#include "core/functions/jacobian_plan.hpp"

#include <algorithm>
#include <utility>

#include "core/functions/jacobian_rows.hpp"
#include "core/functions/lists.hpp"

namespace switchyard {
namespace {

// The colours of a forward Jacobian where that is the one to choose; its columns are coloured only
// where the fewest colours that could do, those of the longest row, would win.
std::optional<std::vector<int>> ForwardColors(const Graph& graph, const JacobianRows& rows,
                                              JacobianMode mode) {
  const auto wins = [&](int num_colors) {
    return mode == JacobianMode::kForward ||
           (mode == JacobianMode::kByPredictedWork &&
            CompressedJacobian::Work(graph, num_colors) < static_cast<double>(rows.cone_arcs));
  };
  if (!wins(rows.longest)) return std::nullopt;
  std::vector<int> colors = CompressedJacobian::Colors(rows, graph.num_inputs);
  if (colors.empty() || !wins(1 + std::ranges::max(colors))) return std::nullopt;
  return colors;
}

}  // namespace

JacobianPlan::JacobianPlan(Graph* graph, Slot first, JacobianMode mode) : sums_(first) {
  const JacobianRows rows(*graph);
  JacobianOrder order = ColumnByColumn(rows, graph->num_inputs);
  if (auto colors = ForwardColors(*graph, rows, mode)) {
    compressed_.emplace(*graph, rows, order, std::move(*colors));
  } else {
    PlanReverse(graph, rows, order.source);
  }
  pattern = std::move(order.pattern);
}

void JacobianPlan::PlanReverse(Graph* graph, const JacobianRows& rows,
                               const std::vector<int>& order) {
  Cones cones(*graph);
  Lists<Product> adjoint(graph->num_nodes);  // of each node, as far as it is known
  std::vector<Product> products;
  std::vector<Slot> by_rows(rows.col.size());
  for (int row = 0; row < rows.size(); ++row) {
    adjoint.Add(rows.root[row], {Constants::kOne, Constants::kOne});
    int k = rows.start[row + 1];
    for (const int v : cones.Of(rows.root[row])) {
      adjoint.Take(v, &products);
      const Slot dv = sums_.Plan(products, &graph->constants);
      if (v < graph->num_inputs) by_rows[--k] = dv;
      for (const Arc& arc : graph->arcs(v)) adjoint.Add(arc.u, {dv, arc.derivative});
    }
  }
  entry_.reserve(order.size());
  for (const int source : order) entry_.push_back(by_rows[source]);
}

std::int64_t JacobianPlan::num_products() const {
  return compressed_ ? compressed_->num_products() : sums_.num_products();
}

void JacobianPlan::StoreConstants(Slot base) {
  sums_.Store(base);
  for (Slot& slot : entry_) slot = Constants::Stored(slot, base);
}

void JacobianPlan::Run(const Graph& graph, double* slots, double* tangents,
                       double* jacobian) const {
  if (compressed_) {
    compressed_->Run(graph, slots, tangents, jacobian);
    return;
  }
  sums_.Run(slots, graph.has_branches);
  for (const Slot slot : entry_) *jacobian++ = slots[slot];
}

}  // namespace switchyard
