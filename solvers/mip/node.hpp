// solvers/mip/node.hpp - the tree: nodes as what was decided since their parent, and those that are
// open.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "solvers/mip/node_boxes.hpp"

namespace switchyard::mip {

/// What a child was made by, for pseudocosts: a variable moved by `distance` from its value.
struct Step {
  std::int32_t variable = -1;  // -1: more than one
  bool up = false;
  double distance = 0;
  double from = 0;  // the parent's bound
};

struct Node {
  std::shared_ptr<const Node> parent;
  std::vector<VariableBox> decided;
  std::shared_ptr<const NodeBoxes> base;  // propagated, of an ancestor; nullptr: the root's
  double bound = -kInfinity;              // proven: of what it holds
  int depth = 0;
  Step step;
  std::int64_t number = 0;  // in the order in which they were opened
};
using NodePointer = std::shared_ptr<const Node>;

/// Everything that was decided on the way to a node.
template <class Impose>
void EachDecision(const Node& node, Impose&& impose) {
  for (const Node* n = &node; n != nullptr; n = n->parent.get()) {
    for (const VariableBox& box : n->decided) impose(box);
  }
}

/// Open nodes, the one with the least bound first; of equals the deepest, then the latest.
class OpenNodes {
 public:
  [[nodiscard]] bool empty() const { return heap_.empty(); }
  [[nodiscard]] std::size_t size() const { return heap_.size(); }
  [[nodiscard]] double least_bound() const {
    return heap_.empty() ? kInfinity : heap_.front()->bound;
  }
  void Push(NodePointer node) {
    heap_.push_back(std::move(node));
    std::push_heap(heap_.begin(), heap_.end(), Later);
  }
  NodePointer Pop() {
    std::pop_heap(heap_.begin(), heap_.end(), Later);
    NodePointer node = std::move(heap_.back());
    heap_.pop_back();
    return node;
  }

 private:
  static bool Later(const NodePointer& a, const NodePointer& b) {
    if (a->bound != b->bound) return a->bound > b->bound;
    if (a->depth != b->depth) return a->depth < b->depth;
    return a->number < b->number;
  }

  std::vector<NodePointer> heap_;
};

}  // namespace switchyard::mip
