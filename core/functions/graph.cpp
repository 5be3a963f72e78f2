#include "core/functions/graph.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "core/functions/op_table.hpp"

namespace switchyard {
namespace {

using Place = Tape::Place;

std::vector<bool> Live(const Tape& tape) {
  std::vector<bool> live(tape.steps().size(), false);
  for (const Place place : tape.outputs()) live[place] = true;
  for (std::size_t p = live.size(); p-- > 0;) {
    if (!live[p]) continue;
    const Tape::Step& step = tape.steps()[p];
    for (int k = 0; k < NumOperands(step.op); ++k) live[step.operand[k]] = true;
  }
  return live;
}

bool IsConstant(const Tape& tape, Place place) { return tape.steps()[place].op == Op::kConstant; }

const OpFacts& FactsOf(const Tape& tape, const Tape::Step& step) {
  const auto [a, b, c] = step.operand;
  if (step.op == Op::kMultiply && a == b) return kSquare;
  if (step.op == Op::kDivide && IsConstant(tape, b)) return kDivideByConstant;
  if (step.op == Op::kPower && IsConstant(tape, b)) return kPowerByConstant;
  if (step.op == Op::kPower && IsConstant(tape, a)) return kPowerOfConstant;
  return FactsOf(step.op);
}

}  // namespace

class GraphBuilder {
 public:
  GraphBuilder(const Tape& tape, Graph* graph) : tape_(tape), graph_(*graph) {}
  void Build();

 private:
  // What is known of a node before sums are flattened.
  struct Node {
    std::array<Arc, 3> arc = {};
    int num_arcs = 0;
    bool depends = false;  // on an input, with a derivative
    bool is_linear = false;
    bool is_output = false;
    int uses = 0;   // arcs that lead here
    int user = -1;  // the last of them comes from here
  };

  void NumberNodes();
  void AddOperation(const Tape::Step& step);
  void AddFirst(const OpFacts& facts, const std::array<Slot, 3>& operand, int v);
  void AddSecond(const OpFacts& facts, const std::array<Slot, 3>& operand, int v);
  Slot SlotOf(Derivative derivative, const std::array<Slot, 3>& operand, int v);
  [[nodiscard]] bool Depends(Slot slot) const { return slot >= 0 && nodes_[slot].depends; }
  [[nodiscard]] bool IsAbsorbed(int v) const;
  void AddArcs(int v);
  void AddArcsOfSum(int v);

  const Tape& tape_;
  Graph& graph_;
  std::vector<bool> live_;
  std::vector<Slot> slot_;  // of each place
  std::vector<Node> nodes_;
  std::vector<std::pair<int, double>> pending_;       // scratch of AddArcsOfSum: node, factor
  std::vector<std::pair<int, double>> coefficients_;  // likewise
};

void GraphBuilder::Build() {
  NumberNodes();
  for (std::size_t p = tape_.num_inputs(); p < tape_.steps().size(); ++p) {
    if (live_[p] && slot_[p] >= 0) AddOperation(tape_.steps()[p]);
  }
  for (const Place place : tape_.outputs()) {
    graph_.outputs.push_back(slot_[place]);
    if (slot_[place] >= 0) nodes_[slot_[place]].is_output = true;
  }
  for (int v = 0; v < graph_.num_nodes; ++v) AddArcs(v);
}

void GraphBuilder::NumberNodes() {
  live_ = Live(tape_);
  slot_.assign(tape_.steps().size(), 0);
  for (std::size_t p = 0; p < live_.size(); ++p) {
    const Tape::Step& step = tape_.steps()[p];
    if (step.op == Op::kConstant) {
      slot_[p] = live_[p] ? graph_.constants.Of(step.constant) : 0;
    } else if (live_[p] || step.op == Op::kInput) {
      slot_[p] = graph_.num_nodes++;
    }
  }
  graph_.num_inputs = tape_.num_inputs();
  graph_.num_slots = graph_.num_nodes;
  nodes_.reserve(graph_.num_nodes);
  nodes_.resize(graph_.num_inputs);
  for (Node& input : nodes_) input.depends = true;
  graph_.curvature_start_.resize(graph_.num_inputs + 1, 0);
  graph_.values.reserve(graph_.num_nodes - graph_.num_inputs);
}

void GraphBuilder::AddOperation(const Tape::Step& step) {
  const OpFacts& facts = FactsOf(tape_, step);
  const int v = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  std::array<Slot, 3> operand;
  operand.fill(slot_[step.operand[0]]);  // what is not used reads the first
  for (int k = 1; k < facts.operands; ++k) operand[k] = slot_[step.operand[k]];
  graph_.values.push_back({facts.value, operand[0], operand[1], operand[2]});
  graph_.has_branches = graph_.has_branches || facts.selects;
  AddFirst(facts, operand, v);
  AddSecond(facts, operand, v);
  graph_.curvature_start_.push_back(static_cast<int>(graph_.curvatures_.size()));
}

void GraphBuilder::AddFirst(const OpFacts& facts, const std::array<Slot, 3>& operand, int v) {
  Node& node = nodes_[v];
  const Slot computed = graph_.num_slots;
  node.is_linear = true;
  for (int k = 0; k < facts.operands; ++k) {
    if (facts.first[k] == Derivative::kZero) continue;
    const Slot slot = SlotOf(facts.first[k], operand, v);
    if (!Depends(operand[k])) continue;
    node.depends = true;
    node.is_linear = node.is_linear && Constants::Is(slot);
    node.arc[node.num_arcs++] = {operand[k], slot};
    ++nodes_[operand[k]].uses;
    nodes_[operand[k]].user = v;
  }
  if (node.depends && facts.compute_first != nullptr) {
    graph_.first.push_back({facts.compute_first, operand[0], operand[1], v, computed});
  }
}

void GraphBuilder::AddSecond(const OpFacts& facts, const std::array<Slot, 3>& operand, int v) {
  constexpr std::array<std::pair<int, int>, 3> kPairs = {{{0, 0}, {0, 1}, {1, 1}}};
  const Slot computed = graph_.num_slots;
  bool is_used = false;
  for (std::size_t k = 0; k < kPairs.size(); ++k) {
    if (facts.second[k] == Derivative::kZero) continue;
    const auto [i, j] = kPairs[k];
    const Slot slot = SlotOf(facts.second[k], operand, v);
    if (!Depends(operand[i]) || !Depends(operand[j])) continue;
    graph_.curvatures_.push_back({operand[i], operand[j], slot, i == j});
    nodes_[v].is_linear = false;
    is_used = true;
  }
  if (is_used && facts.compute_second != nullptr) {
    graph_.second.push_back({facts.compute_second, operand[0], operand[1], v, computed});
  }
}

Slot GraphBuilder::SlotOf(Derivative derivative, const std::array<Slot, 3>& operand, int v) {
  switch (derivative) {
    case Derivative::kZero:
      return graph_.constants.Of(0);
    case Derivative::kOne:
      return Constants::kOne;
    case Derivative::kMinusOne:
      return graph_.constants.Of(-1);
    case Derivative::kTwo:
      return graph_.constants.Of(2);
    case Derivative::kA:
      return operand[0];
    case Derivative::kB:
      return operand[1];
    case Derivative::kResult:
      return v;
    case Derivative::kOneOverB:
      return graph_.constants.Of(1 / graph_.constants.Value(operand[1]));
    case Derivative::kComputed:
      return graph_.num_slots++;
  }
  return Constants::kOne;
}

bool GraphBuilder::IsAbsorbed(int v) const {
  const Node& node = nodes_[v];
  return node.is_linear && node.uses == 1 && !node.is_output && nodes_[node.user].is_linear;
}

void GraphBuilder::AddArcs(int v) {
  const Node& node = nodes_[v];
  if (!node.is_linear) {
    graph_.arcs_.insert(graph_.arcs_.end(), node.arc.begin(), node.arc.begin() + node.num_arcs);
  } else if (!IsAbsorbed(v)) {
    AddArcsOfSum(v);
  }
  graph_.arc_start_.push_back(static_cast<int>(graph_.arcs_.size()));
}

void GraphBuilder::AddArcsOfSum(int v) {
  coefficients_.clear();
  pending_.assign({{v, 1.0}});
  while (!pending_.empty()) {
    const auto [u, factor] = pending_.back();
    pending_.pop_back();
    for (int k = nodes_[u].num_arcs; k-- > 0;) {
      const Arc arc = nodes_[u].arc[k];
      const double coefficient = factor * graph_.constants.Value(arc.derivative);
      auto& list = IsAbsorbed(arc.u) ? pending_ : coefficients_;
      list.emplace_back(arc.u, coefficient);
    }
  }
  std::ranges::stable_sort(coefficients_, {}, [](const auto& c) { return c.first; });
  for (std::size_t k = 0; k < coefficients_.size();) {
    const int u = coefficients_[k].first;
    double sum = 0;
    for (; k < coefficients_.size() && coefficients_[k].first == u; ++k) {
      sum += coefficients_[k].second;
    }
    graph_.arcs_.push_back({u, graph_.constants.Of(sum)});
  }
}

Graph::Graph(const Tape& tape) { GraphBuilder(tape, this).Build(); }

void Graph::StoreConstants(Slot base) {
  for (Slot& output : outputs) output = Constants::Stored(output, base);
  for (ValueStep& s : values) {
    s.a = Constants::Stored(s.a, base);
    s.b = Constants::Stored(s.b, base);
    s.c = Constants::Stored(s.c, base);
  }
  for (std::vector<DerivativeStep>* steps : {&first, &second}) {
    for (DerivativeStep& s : *steps) {
      s.a = Constants::Stored(s.a, base);
      s.b = Constants::Stored(s.b, base);
    }
  }
  for (Arc& arc : arcs_) arc.derivative = Constants::Stored(arc.derivative, base);
}

}  // namespace switchyard
