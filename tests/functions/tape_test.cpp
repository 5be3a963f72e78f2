#include "switchyard/functions/tape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/model/said.hpp"

namespace switchyard {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double ConstantAt(const Tape& tape, Tape::Place place) {
  EXPECT_EQ(tape.steps()[place].op, Op::kConstant);
  return tape.steps()[place].constant;
}

TEST(Tape, BeginsWithItsInputs) {
  const Tape tape(3);
  ASSERT_EQ(tape.steps().size(), 3u);
  for (const Tape::Step& step : tape.steps()) EXPECT_EQ(step.op, Op::kInput);
  EXPECT_EQ(Said([] { Tape(-1); }), "tape: the number of inputs needs to be at least 0, got -1");
}

TEST(Tape, FoldsWhatIsKnownWithoutInputs) {
  Tape tape(0);
  const auto two = tape.Constant(2);
  EXPECT_EQ(ConstantAt(tape, tape.Apply(Op::kPower, two, tape.Constant(10))), 1024);
  EXPECT_EQ(ConstantAt(tape, tape.Apply(Op::kSqrt, two)), std::sqrt(2.0));
  EXPECT_EQ(ConstantAt(tape, tape.Apply(Op::kIfPositive, two, tape.Constant(5), two)), 5);
  EXPECT_TRUE(
      std::isnan(ConstantAt(tape, tape.Apply(Op::kDivide, tape.Constant(0), tape.Constant(0)))));
}

TEST(Tape, FoldsIdentities) {
  Tape tape(2);
  const auto zero = tape.Constant(0);
  const auto one = tape.Constant(1);
  const auto minus_one = tape.Constant(-1);
  const auto two = tape.Constant(2);
  const auto minus_x = tape.Apply(Op::kNegate, 0);
  EXPECT_EQ(tape.Apply(Op::kAdd, 0, zero), 0);
  EXPECT_EQ(tape.Apply(Op::kAdd, zero, 0), 0);
  EXPECT_EQ(tape.Apply(Op::kSubtract, 0, zero), 0);
  EXPECT_EQ(tape.Apply(Op::kSubtract, 0, 0), zero);
  EXPECT_EQ(tape.Apply(Op::kSubtract, zero, 0), minus_x);
  EXPECT_EQ(tape.Apply(Op::kNegate, minus_x), 0);
  EXPECT_EQ(tape.Apply(Op::kMultiply, one, 0), 0);
  EXPECT_EQ(tape.Apply(Op::kMultiply, 0, one), 0);
  EXPECT_EQ(tape.Apply(Op::kMultiply, 0, minus_one), minus_x);
  EXPECT_EQ(tape.Apply(Op::kMultiply, 0, zero), zero);
  EXPECT_EQ(tape.Apply(Op::kDivide, 0, one), 0);
  EXPECT_EQ(tape.Apply(Op::kDivide, zero, 0), zero);
  EXPECT_EQ(tape.Apply(Op::kPower, 0, zero), one);
  EXPECT_EQ(tape.Apply(Op::kPower, 0, one), 0);
  EXPECT_EQ(tape.Apply(Op::kPower, 0, two), tape.Apply(Op::kMultiply, 0, 0));
  EXPECT_EQ(tape.Apply(Op::kPower, one, 0), one);
  EXPECT_EQ(tape.Apply(Op::kMin, 0, 0), 0);
  EXPECT_EQ(tape.Apply(Op::kMax, 1, 1), 1);
  EXPECT_EQ(tape.Apply(Op::kIfPositive, 0, 1, 1), 1);
  EXPECT_EQ(tape.Apply(Op::kIfNonnegative, zero, 0, 1), 0);
  EXPECT_EQ(tape.Apply(Op::kIfPositive, zero, 0, 1), 1);
  EXPECT_EQ(tape.Apply(Op::kIfPositive, tape.Constant(kNaN), 0, 1), 1);
}

TEST(Tape, WritesNothingTwice) {
  Tape tape(2);
  const auto sum = tape.Apply(Op::kAdd, 0, 1);
  const auto sine = tape.Apply(Op::kSin, sum);
  const auto size = tape.steps().size();
  EXPECT_EQ(tape.Apply(Op::kAdd, 1, 0), sum);
  EXPECT_EQ(tape.Apply(Op::kSin, tape.Apply(Op::kAdd, 0, 1)), sine);
  EXPECT_EQ(tape.steps().size(), size);
  EXPECT_NE(tape.Apply(Op::kSubtract, 0, 1), tape.Apply(Op::kSubtract, 1, 0));
  EXPECT_NE(tape.Apply(Op::kMin, 0, 1), tape.Apply(Op::kMin, 1, 0));  // ties differ
  EXPECT_EQ(tape.Constant(kNaN), tape.Constant(kNaN));
  EXPECT_NE(tape.Constant(0.0), tape.Constant(-0.0));
}

TEST(Tape, KeepsThousandsOfStepsApart) {
  Tape tape(1);
  for (int k = 0; k < 5000; ++k) tape.Apply(Op::kMultiply, 0, tape.Constant(k + 2));
  const auto size = tape.steps().size();
  EXPECT_EQ(size, 1u + 2 * 5000);
  for (int k = 0; k < 5000; ++k) tape.Apply(Op::kMultiply, 0, tape.Constant(k + 2));
  EXPECT_EQ(tape.steps().size(), size);
}

TEST(Tape, IsEqualToOneWithTheSameSteps) {
  const auto made = [](double constant) {
    Tape tape(1);
    tape.AddOutput(tape.Apply(Op::kAdd, 0, tape.Constant(constant)));
    return tape;
  };
  EXPECT_EQ(made(3), made(3));
  EXPECT_EQ(made(kNaN), made(kNaN));
  EXPECT_FALSE(made(3) == made(4));
}

TEST(Tape, SaysWhichOperandIsWrong) {
  Tape tape(2);
  EXPECT_EQ(Said([&] { tape.Apply(Op::kAdd, 0, 2); }),
            "tape: operand 1 of add needs a place in [0, 2), got 2");
  EXPECT_EQ(Said([&] { tape.Apply(Op::kSin, -1); }),
            "tape: operand 0 of sin needs a place in [0, 2), got -1");
  EXPECT_EQ(Said([&] { tape.Apply(Op::kSin, 0, 1); }), "tape: sin needs 1 operands, got 2");
  EXPECT_EQ(Said([&] { tape.Apply(Op::kInput, 0); }), "tape: input needs 0 operands, got 1");
  EXPECT_EQ(Said([&] { tape.AddOutput(7); }), "tape: an output needs a place in [0, 2), got 7");
}

}  // namespace
}  // namespace switchyard
