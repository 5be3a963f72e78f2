// Expressions evaluated, searched, rewritten and compared: each node once, however often it is
// used.
#include <algorithm>
#include <array>
#include <set>
#include <unordered_set>

#include "core/functions/op_table.hpp"
#include "core/symbolic/node.hpp"
#include "core/symbolic/terms.hpp"
#include "switchyard/error.hpp"
#include "switchyard/symbolic/expression.hpp"
#include "switchyard/symbolic/variable_names.hpp"

namespace switchyard {
namespace {

// A value for each node of an order.
using NodeValues = std::vector<double>;

double Sum(const Expression& e, const std::function<double(Variable)>& value,
           const NodeOrder& order, const NodeValues& of_node) {
  double sum = e.constant();
  for (const auto& [variable, coefficient] : e.linear()) sum += coefficient * value(variable);
  for (const auto& [node, coefficient] : e.nonlinear()) {
    sum += coefficient * of_node[order.place(node.get())];
  }
  return sum;
}

Expression Rewritten(const Expression& e, const Expression::Substitution& replacement,
                     const NodeOrder& order, const std::vector<Expression>& of_node) {
  Expression result = e.constant();
  for (const auto& [variable, coefficient] : e.linear()) {
    const auto found = replacement.find(variable);
    if (found == replacement.end()) {
      result.Add(coefficient, variable);
    } else {
      result.Add(coefficient, found->second);
    }
  }
  for (const auto& [node, coefficient] : e.nonlinear()) {
    result.Add(coefficient, of_node[order.place(node.get())]);
  }
  return result;
}

// The node made anew from other operands, through the operators that fold.
Expression Remade(Op op, std::vector<Expression> operands) {
  switch (op) {
    case Op::kMultiply:
      return std::move(operands[0]) * std::move(operands[1]);
    case Op::kDivide:
      return std::move(operands[0]) / std::move(operands[1]);
    case Op::kPower:
      return pow(std::move(operands[0]), std::move(operands[1]));
    default:
      return MakeExpression(op, std::move(operands));
  }
}

bool SameLinear(const Expression& a, const Expression& b) {
  auto s = a.MergedLinear();
  auto t = b.MergedLinear();
  const auto by_id = [](const auto& u, const auto& v) {
    return u.variable.get_id() < v.variable.get_id();
  };
  std::sort(s.begin(), s.end(), by_id);
  std::sort(t.begin(), t.end(), by_id);
  return std::equal(s.begin(), s.end(), t.begin(), t.end(), [](const auto& u, const auto& v) {
    return u.coefficient == v.coefficient && u.variable.equal_to(v.variable);
  });
}

}  // namespace

bool Expression::is_constant() const { return nonlinear_.empty() && Merged(linear_).empty(); }

double Expression::Evaluate(const std::function<double(Variable)>& value) const {
  const NodeOrder order(*this);
  NodeValues of_node;
  of_node.reserve(order.nodes().size());
  for (const ExpressionNode* node : order.nodes()) {
    std::array<double, 3> operand = {};
    std::transform(node->operands().begin(), node->operands().end(), operand.begin(),
                   [&](const Expression& e) { return Sum(e, value, order, of_node); });
    of_node.push_back(FactsOf(node->op()).value(operand[0], operand[1], operand[2]));
  }
  return Sum(*this, value, order, of_node);
}

double Expression::Evaluate(const Values& values) const {
  return Evaluate([&](Variable v) {
    const auto found = values.find(v);
    if (found == values.end()) {
      Refuse("the value of ", to_string(60), ": ", NameOf(v), " has no value");
    }
    return found->second;
  });
}

std::vector<Variable> Expression::GetVariables() const {
  std::vector<Variable> found;
  std::unordered_set<Variable> seen;
  ForEachExpression(std::span(this, 1), [&](const Expression& e) {
    for (const LinearTerm& t : Merged(e.linear_)) {
      if (seen.insert(t.variable).second) found.push_back(t.variable);
    }
  });
  return found;
}

Expression Expression::Substitute(const Substitution& replacement) const {
  const NodeOrder order(*this);
  std::vector<Expression> of_node;
  of_node.reserve(order.nodes().size());
  for (const ExpressionNode* node : order.nodes()) {
    std::vector<Expression> operands;
    operands.reserve(node->operands().size());
    for (const Expression& e : node->operands()) {
      operands.push_back(Rewritten(e, replacement, order, of_node));
    }
    of_node.push_back(Remade(node->op(), std::move(operands)));
  }
  return Rewritten(*this, replacement, order, of_node);
}

Expression Expression::Substitute(Variable variable, const Expression& replacement) const {
  return Substitute(Substitution{{variable, replacement}});
}

bool Expression::EqualTo(const Expression& other) const {
  using Nodes = std::pair<const ExpressionNode*, const ExpressionNode*>;
  std::vector<std::pair<const Expression*, const Expression*>> open = {{this, &other}};
  std::set<Nodes> compared;
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    if (a->constant_ != b->constant_ || a->nonlinear_.size() != b->nonlinear_.size() ||
        !SameLinear(*a, *b)) {
      return false;
    }
    for (std::size_t i = 0; i < a->nonlinear_.size(); ++i) {
      const auto& s = a->nonlinear_[i];
      const auto& t = b->nonlinear_[i];
      if (s.coefficient != t.coefficient || s.node->op() != t.node->op()) return false;
      if (s.node == t.node || !compared.insert({s.node.get(), t.node.get()}).second) continue;
      for (std::size_t k = 0; k < s.node->operands().size(); ++k) {
        open.emplace_back(&s.node->operand(k), &t.node->operand(k));
      }
    }
  }
  return true;
}

}  // namespace switchyard
