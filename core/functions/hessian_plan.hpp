// core/functions/hessian_plan.hpp - how the Hessian of w'f is computed: edge pushing.
#pragma once

#include <cstdint>
#include <vector>

#include "core/functions/graph.hpp"
#include "core/functions/sums_of_products.hpp"
#include "switchyard/functions/function.hpp"

namespace switchyard {

/// Nodes are eliminated from the last to the first (Gower, Mello 2012). What is left of w'f is then
/// a function L of the nodes not yet eliminated, known by its gradient, the adjoints dL/dv, and by
/// its second derivatives h_uv, the edges. To eliminate v = v(u_1, .., u_k) is the chain rule:
///   h_{u_i q}   += h_vq (dv/du_i)                          for each edge to another node q
///   h_{u_i u_j} += h_vv (dv/du_i)(dv/du_j) + (dL/dv) d2v/du_i du_j
///   dL/du_i     += (dL/dv)(dv/du_i).
/// Which edges come to be is known without their values, so all of it is planned once.
class HessianPlan {
 public:
  /// Summands of edges: a plan takes up to some 40 bytes and 50 ns for each.
  static constexpr std::int64_t kMostTerms = 100'000'000;

  /// The weights w are read from slot `weights` on; the sums are written from slot `first` on.
  HessianPlan(Graph* graph, Slot weights, Slot first, std::int64_t most_terms = kMostTerms);

  /// False where there would be more than most_terms; then there is no plan.
  bool is_planned = true;
  /// The upper triangle, column by column. To be moved away by whoever made the plan.
  SparsityPattern pattern;

  [[nodiscard]] Slot end() const { return sums_.end(); }
  [[nodiscard]] std::int64_t num_products() const { return sums_.num_products(); }

  void StoreConstants(Slot base);
  void Run(const Graph& graph, double* slots, double* hessian) const;

 private:
  SumsOfProducts sums_;
  std::vector<Slot> entry_;  // where the k-th entry is

  friend class HessianPlanner;
};

}  // namespace switchyard
