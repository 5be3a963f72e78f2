#include "core/functions/compressed_jacobian.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace switchyard {
namespace {

constexpr int kLanes = CompressedJacobian::kLanes;
constexpr double kWorkOfProduct = 0.25;

int Sweeps(int num_colors) { return (num_colors + kLanes - 1) / kLanes; }

}  // namespace

double CompressedJacobian::Work(const Graph& graph, int num_colors) {
  const double products = static_cast<double>(graph.num_arcs() + graph.num_nodes) * kLanes;
  return kWorkOfProduct * products * Sweeps(num_colors);
}

std::vector<int> CompressedJacobian::Colors(const JacobianRows& rows, int num_inputs) {
  std::vector<std::vector<int>> rows_of(num_inputs);
  for (int i = 0; i < rows.size(); ++i) {
    for (const int j : rows.cols(i)) rows_of[j].push_back(i);
  }
  std::vector<int> color(num_inputs, -1);
  std::vector<int> taken_for(num_inputs + 1, -1);  // the column that a colour is closed to
  for (int j = 0; j < num_inputs; ++j) {
    for (const int i : rows_of[j]) {
      for (const int other : rows.cols(i)) {
        if (color[other] >= 0) taken_for[color[other]] = j;
      }
    }
    color[j] = 0;
    while (taken_for[color[j]] == j) ++color[j];
  }
  return color;
}

CompressedJacobian::CompressedJacobian(const Graph& graph, const JacobianRows& rows,
                                       const JacobianOrder& order, std::vector<int> colors)
    : color_(std::move(colors)),
      num_arcs_(graph.num_arcs()),
      num_tangents_(graph.num_nodes * kLanes) {
  for (const int color : color_) num_sweeps_ = std::max(num_sweeps_, color / kLanes + 1);
  const SparsityPattern& pattern = order.pattern;
  entry_start_.assign(num_sweeps_ + 1, 0);
  for (const int j : pattern.col) ++entry_start_[color_[j] / kLanes + 1];
  for (int s = 0; s < num_sweeps_; ++s) entry_start_[s + 1] += entry_start_[s];
  std::vector<int> end(entry_start_.begin(), entry_start_.end() - 1);
  entry_.resize(pattern.size());
  for (int k = 0; k < pattern.size(); ++k) {
    const int color = color_[pattern.col[k]];
    const int root = rows.root[rows.row_of_output[pattern.row[k]]];
    entry_[end[color / kLanes]++] = {k, root * kLanes + color % kLanes};
  }
}

std::int64_t CompressedJacobian::num_products() const {
  return std::int64_t{num_sweeps_} * num_arcs_ * kLanes;
}

void CompressedJacobian::Run(const Graph& graph, const double* slots, double* tangents,
                             double* jacobian) const {
  for (int s = 0; s < num_sweeps_; ++s) {
    std::fill_n(tangents, graph.num_inputs * kLanes, 0.0);
    for (int j = 0; j < graph.num_inputs; ++j) {
      if (color_[j] / kLanes == s) tangents[j * kLanes + color_[j] % kLanes] = 1;
    }
    graph.has_branches ? Sweep<true>(graph, slots, tangents) : Sweep<false>(graph, slots, tangents);
    for (int k = entry_start_[s]; k < entry_start_[s + 1]; ++k) {
      jacobian[entry_[k].k] = tangents[entry_[k].tangent];
    }
  }
}

template <bool guarded>
void CompressedJacobian::Sweep(const Graph& graph, const double* slots, double* tangents) const {
  for (int v = graph.num_inputs; v < graph.num_nodes; ++v) {
    std::array<double, kLanes> sum = {};
    for (const Arc& arc : graph.arcs(v)) {
      const double d = slots[arc.derivative];
      const double* const u = tangents + std::ptrdiff_t{arc.u} * kLanes;
      if constexpr (guarded) {
        if (d == 0) continue;
        for (int l = 0; l < kLanes; ++l) sum[l] += u[l] == 0 ? 0 : d * u[l];
      } else {
        for (int l = 0; l < kLanes; ++l) sum[l] += d * u[l];
      }
    }
    std::copy_n(sum.data(), kLanes, tangents + std::ptrdiff_t{v} * kLanes);
  }
}

}  // namespace switchyard
