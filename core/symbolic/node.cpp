#include "core/symbolic/node.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace switchyard {
namespace {

using Nodes = std::vector<std::shared_ptr<const ExpressionNode>>;

// The nodes of the operands' terms, last first: a stack then gives them from left to right.
template <class Visit>
void ForEachChildFromTheRight(const ExpressionNode& node, const Visit& visit) {
  for (auto e = node.operands().rbegin(); e != node.operands().rend(); ++e) {
    for (auto t = e->nonlinear().rbegin(); t != e->nonlinear().rend(); ++t) visit(t->node);
  }
}

void AppendChildren(const ExpressionNode& node, Nodes* nodes) {
  ForEachChildFromTheRight(node, [nodes](const auto& child) { nodes->push_back(child); });
}

}  // namespace

ExpressionNode::~ExpressionNode() {
  Nodes last;  // that are held here, perhaps for the last time
  AppendChildren(*this, &last);
  operands_.clear();
  while (!last.empty()) {
    const auto node = std::move(last.back());
    last.pop_back();
    // With this as its only holder the children outlive it by `last`, and its end is a short one.
    if (node.use_count() == 1) AppendChildren(*node, &last);
  }
}

bool IsWholePower(const ExpressionNode& node) {
  if (node.op() != Op::kPower || !HasNoTerms(node.operand(1))) return false;
  const double exponent = node.operand(1).constant();
  return exponent >= 1 && exponent == std::floor(exponent) && std::isfinite(exponent);
}

NodeOrder::NodeOrder(std::span<const Expression> roots) {
  struct Visit {
    const ExpressionNode* node;
    bool operands_done;
  };
  std::vector<Visit> open;
  for (const Expression& root : roots) {
    for (const auto& term : root.nonlinear()) {
      open.push_back({term.node.get(), false});
      while (!open.empty()) {
        const Visit visit = open.back();
        open.pop_back();
        if (place_.contains(visit.node)) continue;
        if (visit.operands_done) {
          place_.emplace(visit.node, nodes_.size());
          nodes_.push_back(visit.node);
          continue;
        }
        open.push_back({visit.node, true});
        ForEachChildFromTheRight(*visit.node, [&](const auto& child) {
          if (!place_.contains(child.get())) open.push_back({child.get(), false});
        });
      }
    }
  }
}

}  // namespace switchyard
