// core/functions/jacobian_plan.hpp - how the Jacobian of a graph is computed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/functions/compressed_jacobian.hpp"
#include "core/functions/graph.hpp"
#include "core/functions/sums_of_products.hpp"
#include "switchyard/functions/function.hpp"

namespace switchyard {

enum class JacobianMode : std::uint8_t { kByPredictedWork, kReverse, kForward };

/// Reverse: the adjoint of each node in an output's own cone is a planned sum of products
///   dy/du = sum over v of (dy/dv) (dv/du).
/// Forward: CompressedJacobian.
class JacobianPlan {
 public:
  /// Its sums are written from slot `first` on.
  JacobianPlan(Graph* graph, Slot first, JacobianMode mode);

  /// Column by column. To be moved away by whoever made the plan.
  SparsityPattern pattern;

  [[nodiscard]] Slot end() const { return sums_.end(); }
  [[nodiscard]] std::int64_t num_products() const;
  [[nodiscard]] bool is_forward() const { return compressed_.has_value(); }
  /// Numbers that Run needs beside the slots.
  [[nodiscard]] int num_tangents() const { return compressed_ ? compressed_->num_tangents() : 0; }

  void StoreConstants(Slot base);
  void Run(const Graph& graph, double* slots, double* tangents, double* jacobian) const;

 private:
  void PlanReverse(Graph* graph, const JacobianRows& rows, const std::vector<int>& order);

  SumsOfProducts sums_;
  std::vector<Slot> entry_;  // where the k-th entry is, in reverse
  std::optional<CompressedJacobian> compressed_;
};

}  // namespace switchyard
