// core/functions/graph.hpp - a tape as derivatives see it: the operations that outputs need, and
// the local derivatives that are not zero by structure.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/functions/sums_of_products.hpp"
#include "switchyard/functions/tape.hpp"

namespace switchyard {

/// dv/du is read at `derivative`, v the node whose arc this is.
struct Arc {
  std::int32_t u;
  Slot derivative;
};

/// d2v / du dw is read at `derivative`; u and w are operands of v, and may be one node.
struct Curvature {
  std::int32_t u;
  std::int32_t w;
  Slot derivative;
  bool is_diagonal;  // by one operand twice; else by two operands, once for both orders
};

/// v = value(a, b, c) of what the slots hold. The k-th step writes slot num_inputs + k.
struct ValueStep {
  double (*value)(double a, double b, double c);
  Slot a;
  Slot b;
  Slot c;
};

/// Local derivatives of v, written from slot `d` on.
struct DerivativeStep {
  void (*compute)(double a, double b, double v, double* d);
  Slot a;
  Slot b;
  Slot v;
  Slot d;
};

/// Nodes are the inputs and the live operations that depend on inputs, in the order of the tape;
/// node v has its value in slot v. Linear operations that only one linear operation uses have no
/// arcs: the arcs of that one reach through them, so a sum of n terms is one node with n arcs
/// however it was written.
class Graph {
 public:
  explicit Graph(const Tape& tape);

  int num_inputs = 0;
  int num_nodes = 0;
  std::vector<Slot> outputs;  // a node or a constant
  std::vector<ValueStep> values;
  std::vector<DerivativeStep> first;
  std::vector<DerivativeStep> second;
  Constants constants;
  Slot num_slots = 0;  // of values and local derivatives
  bool has_branches = false;

  [[nodiscard]] std::span<const Arc> arcs(int v) const {
    return std::span(arcs_).subspan(arc_start_[v], arc_start_[v + 1] - arc_start_[v]);
  }
  [[nodiscard]] std::span<const Curvature> curvatures(int v) const {
    return std::span(curvatures_)
        .subspan(curvature_start_[v], curvature_start_[v + 1] - curvature_start_[v]);
  }
  [[nodiscard]] int num_arcs() const { return static_cast<int>(arcs_.size()); }

  void StoreConstants(Slot base);

 private:
  std::vector<int> arc_start_ = {0};
  std::vector<Arc> arcs_;
  std::vector<int> curvature_start_ = {0};
  std::vector<Curvature> curvatures_;

  friend class GraphBuilder;
};

}  // namespace switchyard
