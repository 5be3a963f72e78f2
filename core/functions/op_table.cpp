#include "core/functions/op_table.hpp"

#include <cstddef>

#include "core/functions/op_functions.hpp"

namespace switchyard {
namespace {

using namespace op_functions;
using enum Derivative;

constexpr auto kC = kComputed;

// op, name, operands, value; derivatives by a, b, c; by aa, ab, bb; what is computed of both.
constexpr std::array kTable = {
    OpFacts{Op::kConstant, "constant", 0, nullptr},
    OpFacts{Op::kInput, "input", 0, nullptr},
    OpFacts{Op::kAdd, "add", 2, Add, {kOne, kOne}},
    OpFacts{Op::kSubtract, "subtract", 2, Subtract, {kOne, kMinusOne}},
    OpFacts{Op::kMultiply, "multiply", 2, Multiply, {kB, kA}, {kZero, kOne, kZero}},
    OpFacts{
        Op::kDivide, "divide", 2, Divide, {kC, kC}, {kZero, kC, kC}, FirstOfDivide, SecondOfDivide},
    OpFacts{Op::kNegate, "negate", 1, Negate, {kMinusOne}},
    OpFacts{Op::kSqrt, "sqrt", 1, Sqrt, {kC}, {kC}, FirstOfSqrt, SecondOfSqrt},
    OpFacts{Op::kExp, "exp", 1, Exp, {kResult}, {kResult}},
    OpFacts{Op::kLog, "log", 1, Log, {kC}, {kC}, FirstOfLog, SecondOfLog},
    OpFacts{Op::kSin, "sin", 1, Sin, {kC}, {kC}, FirstOfSin, MinusResult},
    OpFacts{Op::kCos, "cos", 1, Cos, {kC}, {kC}, FirstOfCos, MinusResult},
    OpFacts{Op::kTan, "tan", 1, Tan, {kC}, {kC}, FirstOfTan, SecondOfTan},
    OpFacts{Op::kAsin, "asin", 1, Asin, {kC}, {kC}, FirstOfAsin, SecondOfAsin},
    OpFacts{Op::kAcos, "acos", 1, Acos, {kC}, {kC}, FirstOfAcos, SecondOfAcos},
    OpFacts{Op::kAtan, "atan", 1, Atan, {kC}, {kC}, FirstOfAtan, SecondOfAtan},
    OpFacts{Op::kSinh, "sinh", 1, Sinh, {kC}, {kResult}, FirstOfSinh},
    OpFacts{Op::kCosh, "cosh", 1, Cosh, {kC}, {kResult}, FirstOfCosh},
    OpFacts{Op::kTanh, "tanh", 1, Tanh, {kC}, {kC}, FirstOfTanh, SecondOfTanh},
    OpFacts{Op::kAbs, "abs", 1, Abs, {kC}, {}, FirstOfAbs},
    OpFacts{Op::kFloor, "floor", 1, Floor},
    OpFacts{Op::kCeil, "ceil", 1, Ceil},
    OpFacts{Op::kPower, "power", 2, Power, {kC, kC}, {kC, kC, kC}, FirstOfPower, SecondOfPower},
    OpFacts{Op::kAtan2, "atan2", 2, Atan2, {kC, kC}, {kC, kC, kC}, FirstOfAtan2, SecondOfAtan2},
    OpFacts{Op::kMin, "min", 2, Min, {kC, kC}, {}, FirstOfMin, nullptr, true},
    OpFacts{Op::kMax, "max", 2, Max, {kC, kC}, {}, FirstOfMax, nullptr, true},
    OpFacts{Op::kIfPositive,
            "if positive",
            3,
            IfPositive,
            {kZero, kC, kC},
            {},
            FirstOfIfPositive,
            nullptr,
            true},
    OpFacts{Op::kIfNonnegative,
            "if nonnegative",
            3,
            IfNonnegative,
            {kZero, kC, kC},
            {},
            FirstOfIfNonnegative,
            nullptr,
            true},
};

constexpr bool RowsStandInOrder() {
  for (std::size_t i = 0; i < kTable.size(); ++i) {
    if (kTable[i].op != static_cast<Op>(i)) return false;
  }
  return kTable.size() == static_cast<std::size_t>(Op::kIfNonnegative) + 1;
}
static_assert(RowsStandInOrder(), "row i is the operation of number i");

}  // namespace

const OpFacts kSquare = {Op::kMultiply, "square", 1, Square, {kC}, {kTwo}, FirstOfSquare};
const OpFacts kDivideByConstant = {Op::kDivide, "divide", 2, Divide, {kOneOverB}};
const OpFacts kPowerByConstant = {
    Op::kPower, "power", 2, Power, {kC}, {kC}, FirstOfPowerByBase, SecondOfPowerByBase};
const OpFacts kPowerOfConstant = {Op::kPower,
                                  "power",
                                  2,
                                  Power,
                                  {kZero, kC},
                                  {kZero, kZero, kC},
                                  FirstOfPowerByExponent,
                                  SecondOfPowerByExponent};

const OpFacts& FactsOf(Op op) { return kTable[static_cast<std::size_t>(op)]; }

int NumOperands(Op op) { return FactsOf(op).operands; }

}  // namespace switchyard
