#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/symbolic/columns.hpp"
#include "core/symbolic/node.hpp"
#include "switchyard/error.hpp"
#include "switchyard/functions/tape.hpp"
#include "switchyard/symbolic/decompose.hpp"

namespace switchyard {
namespace {

using Place = Tape::Place;

// Writes expressions on a tape, each node once; the tape itself finds operations that are equal
// without being shared.
class Writer {
 public:
  Writer(std::span<const Expression> expressions, const std::vector<Variable>& inputs)
      : order_(expressions), tape_(static_cast<int>(inputs.size())) {
    for (std::size_t i = 0; i < inputs.size(); ++i) input_[inputs[i]] = static_cast<Place>(i);
    for (const ExpressionNode* node : order_.nodes()) of_node_.push_back(Write(*node));
    for (const Expression& e : expressions) tape_.AddOutput(Write(e));
  }

  [[nodiscard]] const Tape& tape() const { return tape_; }

 private:
  // sum + coefficient * term; `sum` is -1 where nothing stands in it yet.
  Place Plus(Place sum, double coefficient, Place term) {
    const double size = std::abs(coefficient);
    const Place scaled = size == 1 ? term : tape_.Apply(Op::kMultiply, tape_.Constant(size), term);
    if (sum < 0) return coefficient < 0 ? tape_.Apply(Op::kNegate, scaled) : scaled;
    return tape_.Apply(coefficient < 0 ? Op::kSubtract : Op::kAdd, sum, scaled);
  }

  Place Write(const Expression& e) {
    Place sum = e.constant() == 0 ? -1 : tape_.Constant(e.constant());
    for (const auto& [variable, coefficient] : e.MergedLinear()) {
      sum = Plus(sum, coefficient, input_.at(variable));
    }
    for (const auto& [node, coefficient] : e.nonlinear()) {
      sum = Plus(sum, coefficient, of_node_[order_.place(node.get())]);
    }
    return sum < 0 ? tape_.Constant(0) : sum;
  }

  Place Write(const ExpressionNode& node) {
    std::array<Place, 3> operand = {};
    for (std::size_t i = 0; i < node.operands().size(); ++i) operand[i] = Write(node.operand(i));
    switch (node.operands().size()) {
      case 1:
        return tape_.Apply(node.op(), operand[0]);
      case 2:
        return tape_.Apply(node.op(), operand[0], operand[1]);
      default:
        return tape_.Apply(node.op(), operand[0], operand[1], operand[2]);
    }
  }

  NodeOrder order_;
  Tape tape_;
  std::unordered_map<Variable, Place> input_;
  std::vector<Place> of_node_;
};

// Infinite constants may stand in a min, a max or a comparison; only NaN is no number.
void RequireNumbers(std::span<const Expression> expressions) {
  const auto is_nan = [](const auto& term) { return std::isnan(term.coefficient); };
  ForEachExpression(expressions, [&is_nan](const Expression& e) {
    if (std::isnan(e.constant()) || std::any_of(e.linear().begin(), e.linear().end(), is_nan) ||
        std::any_of(e.nonlinear().begin(), e.nonlinear().end(), is_nan)) {
      Refuse(e.to_string(60), " has a coefficient that is not a number");
    }
  });
}

}  // namespace

CompiledExpressions CompileExpressions(const ExpressionVectorRef& e) {
  const std::span expressions(e.data(), static_cast<std::size_t>(e.size()));
  RequireNumbers(expressions);
  Columns inputs(expressions);
  ForEachExpression(expressions, [&inputs](const Expression& one) {
    for (const auto& t : one.MergedLinear()) (void)inputs.Of(t.variable);
  });
  const Writer writer(expressions, inputs.variables());
  return {CompileTape(writer.tape()),
          Eigen::Map<const VectorXDecisionVariable>(inputs.variables().data(), inputs.size())};
}

}  // namespace switchyard
