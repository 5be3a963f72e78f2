// core/symbolic/node.hpp - the nonlinear terms of expressions, and the order in which they are
// walked.
#pragma once

#include <algorithm>
#include <concepts>
#include <memory>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "switchyard/functions/tape.hpp"
#include "switchyard/symbolic/expression.hpp"

namespace switchyard {

/// An operation on expressions, of which at least one is not constant; constant once made.
class ExpressionNode {
 public:
  ExpressionNode(Op op, std::vector<Expression> operands)
      : op_(op), operands_(std::move(operands)) {}
  /// Takes apart, in a loop, what only this node holds: a chain of a million nodes is no depth of
  /// calls.
  ~ExpressionNode();
  ExpressionNode(const ExpressionNode&) = delete;
  ExpressionNode& operator=(const ExpressionNode&) = delete;

  [[nodiscard]] Op op() const { return op_; }
  [[nodiscard]] const std::vector<Expression>& operands() const { return operands_; }
  [[nodiscard]] const Expression& operand(std::size_t i) const { return operands_[i]; }

 private:
  Op op_;
  std::vector<Expression> operands_;
};

/// The operation on these operands, folded where they are constant: what all builders of
/// expressions end in.
Expression MakeExpression(Op op, std::vector<Expression> operands);
template <std::same_as<Expression>... E>
Expression MakeExpression(Op op, E... operands) {
  std::vector<Expression> all;
  all.reserve(sizeof...(E));
  (all.push_back(std::move(operands)), ...);
  return MakeExpression(op, std::move(all));
}

/// Is it a constant by its form, without any terms?
inline bool HasNoTerms(const Expression& e) { return e.linear().empty() && e.nonlinear().empty(); }
/// The variable where the expression is 1 * variable and nothing else, else nullptr.
inline const Variable* BareVariable(const Expression& e) {
  const bool bare = e.constant() == 0 && e.nonlinear().empty() && e.linear().size() == 1 &&
                    e.linear().front().coefficient == 1;
  return bare ? &e.linear().front().variable : nullptr;
}

/// Is it a power with a constant whole exponent of at least 1? (2 and more: 1 is folded away.)
bool IsWholePower(const ExpressionNode& node);

/// Calls `visit` for each of the expressions and of the operands under them, as they are read from
/// left to right; what stands under a node that is used again, once.
template <class Visit>
void ForEachExpression(std::span<const Expression> roots, const Visit& visit);

/// The nodes under some expressions, each once, those of operands before what is made of them.
class NodeOrder {
 public:
  explicit NodeOrder(std::span<const Expression> roots);
  explicit NodeOrder(const Expression& root) : NodeOrder(std::span(&root, 1)) {}

  [[nodiscard]] const std::vector<const ExpressionNode*>& nodes() const { return nodes_; }
  [[nodiscard]] std::size_t place(const ExpressionNode* node) const { return place_.at(node); }

 private:
  std::vector<const ExpressionNode*> nodes_;
  std::unordered_map<const ExpressionNode*, std::size_t> place_;
};

template <class Visit>
void ForEachExpression(std::span<const Expression> roots, const Visit& visit) {
  std::unordered_set<const ExpressionNode*> seen;
  std::vector<const Expression*> open;
  for (const Expression& root : roots) {
    open.push_back(&root);
    while (!open.empty()) {
      const Expression& e = *open.back();
      open.pop_back();
      visit(e);
      const std::size_t before = open.size();
      for (const auto& term : e.nonlinear()) {
        if (!seen.insert(term.node.get()).second) continue;
        for (const Expression& operand : term.node->operands()) open.push_back(&operand);
      }
      std::reverse(open.begin() + static_cast<std::ptrdiff_t>(before), open.end());
    }
  }
}

}  // namespace switchyard
