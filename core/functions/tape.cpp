#include "switchyard/functions/tape.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>

#include "core/functions/op_table.hpp"
#include "switchyard/error.hpp"

namespace switchyard {
namespace {

using Place = Tape::Place;

// Of the bits, so that 0 and -0 are two constants and a NaN is itself.
bool SameStep(const Tape::Step& s, const Tape::Step& t) {
  return s.op == t.op && s.operand == t.operand &&
         std::bit_cast<std::uint64_t>(s.constant) == std::bit_cast<std::uint64_t>(t.constant);
}

std::size_t Hash(const Tape::Step& step) {
  std::uint64_t h =
      std::bit_cast<std::uint64_t>(step.constant) ^ static_cast<std::uint64_t>(step.op);
  for (const Place place : step.operand) {
    h = (h ^ (h >> 32) ^ static_cast<std::uint32_t>(place)) * 0x9e3779b97f4a7c15u;
  }
  return static_cast<std::size_t>(h ^ (h >> 29));
}

bool Commutes(Op op) { return op == Op::kAdd || op == Op::kMultiply; }

}  // namespace

Tape::Tape(int num_inputs) : num_inputs_(num_inputs) {
  Require(num_inputs >= 0, "tape: the number of inputs needs to be at least 0, got ", num_inputs);
  steps_.resize(static_cast<std::size_t>(num_inputs), Step{.op = Op::kInput});
}

Place Tape::Constant(double value) { return Find({.op = Op::kConstant, .constant = value}); }

Place Tape::Apply(Op op, Place a) {
  CheckOperands(op, {a, -1, -1}, 1);
  return Written(op, {a, -1, -1});
}

Place Tape::Apply(Op op, Place a, Place b) {
  CheckOperands(op, {a, b, -1}, 2);
  return Written(op, {a, b, -1});
}

Place Tape::Apply(Op op, Place a, Place b, Place c) {
  CheckOperands(op, {a, b, c}, 3);
  return Written(op, {a, b, c});
}

void Tape::AddOutput(Place place) {
  Require(place >= 0 && place < std::ssize(steps_), "tape: an output needs a place in [0, ",
          steps_.size(), "), got ", place);
  outputs_.push_back(place);
}

bool operator==(const Tape& s, const Tape& t) {
  return s.num_inputs_ == t.num_inputs_ && s.outputs_ == t.outputs_ &&
         std::ranges::equal(s.steps_, t.steps_, SameStep);
}

void Tape::CheckOperands(Op op, std::array<Place, 3> operand, int given) const {
  Require(op <= Op::kIfNonnegative && NumOperands(op) == given,
          "tape: ", op <= Op::kIfNonnegative ? FactsOf(op).name : "an unknown operation", " needs ",
          op <= Op::kIfNonnegative ? NumOperands(op) : 0, " operands, got ", given);
  for (int k = 0; k < given; ++k) {
    Require(operand[k] >= 0 && operand[k] < std::ssize(steps_), "tape: operand ", k, " of ",
            FactsOf(op).name, " needs a place in [0, ", steps_.size(), "), got ", operand[k]);
  }
}

bool Tape::IsConstant(Place place) const { return steps_[place].op == Op::kConstant; }

bool Tape::Is(Place place, double value) const {
  return IsConstant(place) && steps_[place].constant == value;
}

Place Tape::Simplified(Op op, std::array<Place, 3> operand) {
  const auto [a, b, c] = operand;
  switch (op) {
    case Op::kNegate:
      return steps_[a].op == Op::kNegate ? steps_[a].operand[0] : -1;
    case Op::kAdd:
      return Is(a, 0) ? b : Is(b, 0) ? a : -1;
    case Op::kSubtract:
      if (a == b) return Constant(0);
      return Is(b, 0) ? a : Is(a, 0) ? Apply(Op::kNegate, b) : -1;
    case Op::kMultiply:
      if (Is(a, 0) || Is(b, 0)) return Constant(0);
      if (Is(a, 1) || Is(b, 1)) return Is(a, 1) ? b : a;
      return Is(a, -1) ? Apply(Op::kNegate, b) : Is(b, -1) ? Apply(Op::kNegate, a) : -1;
    case Op::kDivide:
      return Is(a, 0) ? Constant(0) : Is(b, 1) ? a : -1;
    case Op::kPower:
      if (Is(b, 0) || Is(a, 1)) return Constant(1);
      return Is(b, 1) ? a : Is(b, 2) ? Apply(Op::kMultiply, a, a) : -1;
    case Op::kMin:
    case Op::kMax:
      return a == b ? a : -1;
    case Op::kIfPositive:
    case Op::kIfNonnegative:
      if (IsConstant(a)) return FactsOf(op).value(steps_[a].constant, 1, 0) == 1 ? b : c;
      return b == c ? b : -1;
    default:
      return -1;
  }
}

Place Tape::Written(Op op, std::array<Place, 3> operand) {
  std::array<double, 3> value = {};
  bool all_constant = true;
  for (int k = 0; k < NumOperands(op); ++k) {
    all_constant = all_constant && IsConstant(operand[k]);
    value[k] = steps_[operand[k]].constant;
  }
  if (all_constant) return Constant(FactsOf(op).value(value[0], value[1], value[2]));
  if (const Place simpler = Simplified(op, operand); simpler >= 0) return simpler;
  if (Commutes(op) && operand[0] > operand[1]) std::swap(operand[0], operand[1]);
  return Find({.op = op, .operand = operand});
}

Place Tape::Find(const Step& step) {
  if (4 * (steps_.size() + 1) > 3 * table_.size()) Rehash();
  const std::size_t mask = table_.size() - 1;
  std::size_t at = Hash(step) & mask;
  while (table_[at] >= 0) {
    if (SameStep(steps_[table_[at]], step)) return table_[at];
    at = (at + 1) & mask;
  }
  table_[at] = static_cast<Place>(steps_.size());
  steps_.push_back(step);
  return table_[at];
}

void Tape::Rehash() {
  table_.assign(std::bit_ceil(2 * steps_.size() + 16), -1);
  const std::size_t mask = table_.size() - 1;
  for (std::size_t place = num_inputs_; place < steps_.size(); ++place) {
    std::size_t at = Hash(steps_[place]) & mask;
    while (table_[at] >= 0) at = (at + 1) & mask;
    table_[at] = static_cast<Place>(place);
  }
}

}  // namespace switchyard
