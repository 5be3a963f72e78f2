// core/functions/op_table.hpp - the one table of what is known of each elementary operation.
//
// A new operation is an Op, a row and the functions that the row names.
#pragma once

#include <array>
#include <cstdint>

#include "switchyard/functions/tape.hpp"

namespace switchyard {

/// What a derivative of v = op(a, b, c) is.
enum class Derivative : std::uint8_t {
  kZero,  // for every a, b, c: the operation is not taken to depend on it
  kOne,
  kMinusOne,
  kTwo,
  kA,  // the operand a itself
  kB,
  kResult,    // v
  kOneOverB,  // of a constant b
  kComputed,  // what compute_first or compute_second writes
};

struct OpFacts {
  Op op;
  const char* name;
  int operands;
  double (*value)(double a, double b, double c);
  std::array<Derivative, 3> first = {};   // by a, b, c
  std::array<Derivative, 3> second = {};  // by aa, ab, bb
  // Write the derivatives that are kComputed, in their order; null where there is none.
  void (*compute_first)(double a, double b, double v, double* d) = nullptr;
  void (*compute_second)(double a, double b, double v, double* d) = nullptr;
  // v is one of the operands; the others add nothing, even where they are not defined.
  bool selects = false;
};

const OpFacts& FactsOf(Op op);

// Operations that a tape says by a general one, and whose derivatives are simpler.
extern const OpFacts kSquare;            // a a
extern const OpFacts kDivideByConstant;  // a / b, no derivative by b
extern const OpFacts kPowerByConstant;   // a^b, no derivative by b
extern const OpFacts kPowerOfConstant;   // a^b, no derivative by a

}  // namespace switchyard
