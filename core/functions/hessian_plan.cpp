#include "core/functions/hessian_plan.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "core/functions/lists.hpp"

namespace switchyard {

class HessianPlanner {
 public:
  HessianPlanner(Graph* graph, HessianPlan* plan, std::int64_t most_terms)
      : graph_(*graph),
        plan_(*plan),
        room_(most_terms),
        adjoint_(graph->num_nodes),
        edges_(graph->num_nodes),
        bends_(graph->num_nodes, false) {}
  /// False where it would have too many terms.
  bool Plan(Slot weights);

 private:
  // A summand of h_uv, kept with the later node v.
  struct EdgeTerm {
    std::int32_t u;
    Product product;
  };

  void Eliminate(int v);
  void PushAdjoint(int v, Slot dv);
  void PushEdge(int v, int q, Slot h);
  void PushLoop(int v, Slot h);
  void ReadEntries(int v);
  // Adds to h_uw what two operands, u and w, have in common: twice where these are one node, once
  // for each order.
  void AddCross(int u, int w, Product product);
  void AddEdge(int u, int w, Product product) {
    --room_;
    edges_.Add(std::max(u, w), {std::min(u, w), product});
  }
  template <class Visit>
  void ForEachEdge(int v, Visit&& visit);
  Slot Sum(std::span<const Product> products) {
    return plan_.sums_.Plan(products, &graph_.constants);
  }

  Graph& graph_;
  HessianPlan& plan_;
  std::int64_t room_;  // for terms; nothing is pushed where there is none
  Lists<Product> adjoint_;
  Lists<EdgeTerm> edges_;
  std::vector<bool> bends_;  // something that is not linear is in v or below it
  std::vector<Product> products_;
  std::vector<EdgeTerm> terms_;
};

bool HessianPlanner::Plan(Slot weights) {
  for (int v = graph_.num_inputs; v < graph_.num_nodes; ++v) {
    bends_[v] = !graph_.curvatures(v).empty() ||
                std::ranges::any_of(graph_.arcs(v), [&](const Arc& a) { return bends_[a.u]; });
  }
  for (std::size_t i = 0; i < graph_.outputs.size(); ++i) {
    const Slot v = graph_.outputs[i];
    if (!Constants::Is(v)) adjoint_.Add(v, {weights + static_cast<Slot>(i), Constants::kOne});
  }
  for (int v = graph_.num_nodes; v-- > graph_.num_inputs && room_ >= 0;) Eliminate(v);
  if (room_ < 0) return false;
  plan_.pattern.rows = plan_.pattern.cols = graph_.num_inputs;
  for (int v = 0; v < graph_.num_inputs; ++v) ReadEntries(v);
  return true;
}

void HessianPlanner::Eliminate(int v) {
  if (!adjoint_.IsEmpty(v)) {
    adjoint_.Take(v, &products_);
    PushAdjoint(v, Sum(products_));
  }
  ForEachEdge(v, [&](int q, Slot h) {
    if (room_ < 0) return;
    q == v ? PushLoop(v, h) : PushEdge(v, q, h);
  });
}

void HessianPlanner::PushAdjoint(int v, Slot dv) {
  for (const Curvature& c : graph_.curvatures(v)) {
    if (c.is_diagonal) {
      AddEdge(c.u, c.w, {dv, c.derivative});
    } else {
      AddCross(c.u, c.w, {dv, c.derivative});
    }
  }
  for (const Arc& arc : graph_.arcs(v)) {
    if (bends_[arc.u]) adjoint_.Add(arc.u, {dv, arc.derivative});
  }
}

void HessianPlanner::PushEdge(int v, int q, Slot h) {
  for (const Arc& arc : graph_.arcs(v)) AddCross(arc.u, q, {h, arc.derivative});
}

void HessianPlanner::PushLoop(int v, Slot h) {
  const std::span<const Arc> arcs = graph_.arcs(v);
  for (std::size_t i = 0; i < arcs.size() && room_ >= 0; ++i) {
    const Slot pushed = Sum(std::array{Product{h, arcs[i].derivative}});
    AddEdge(arcs[i].u, arcs[i].u, {pushed, arcs[i].derivative});
    for (std::size_t j = 0; j < i; ++j) {
      AddCross(arcs[i].u, arcs[j].u, {pushed, arcs[j].derivative});
    }
  }
}

void HessianPlanner::AddCross(int u, int w, Product product) {
  AddEdge(u, w, product);
  if (u == w) AddEdge(u, w, product);
}

template <class Visit>
void HessianPlanner::ForEachEdge(int v, Visit&& visit) {
  edges_.Take(v, &terms_);
  std::ranges::stable_sort(terms_, {}, &EdgeTerm::u);
  for (std::size_t k = 0; k < terms_.size();) {
    const int u = terms_[k].u;
    products_.clear();
    for (; k < terms_.size() && terms_[k].u == u; ++k) products_.push_back(terms_[k].product);
    visit(u, Sum(products_));
  }
}

void HessianPlanner::ReadEntries(int v) {
  ForEachEdge(v, [&](int u, Slot h) {
    plan_.pattern.Add(u, v);
    plan_.entry_.push_back(h);
  });
}

HessianPlan::HessianPlan(Graph* graph, Slot weights, Slot first, std::int64_t most_terms)
    : sums_(first) {
  is_planned = HessianPlanner(graph, this, most_terms).Plan(weights);
  if (!is_planned) sums_ = SumsOfProducts(first);
}

void HessianPlan::StoreConstants(Slot base) {
  sums_.Store(base);
  for (Slot& slot : entry_) slot = Constants::Stored(slot, base);
}

void HessianPlan::Run(const Graph& graph, double* slots, double* hessian) const {
  sums_.Run(slots, graph.has_branches);
  for (const Slot slot : entry_) *hessian++ = slots[slot];
}

}  // namespace switchyard
