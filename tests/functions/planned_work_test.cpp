// What an evaluation costs, by the operations that are planned.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <vector>

#include "core/functions/tape_function.hpp"
#include "tests/model/said.hpp"

namespace switchyard {
namespace {

using Eigen::VectorXd;
using Place = Tape::Place;

PlannedWork WorkOf(const Tape& tape) { return TapeFunction(tape).Work(); }

// Outputs exp(x_i x_{i+1}).
Tape Chain(int n) {
  Tape tape(n + 1);
  for (int i = 0; i < n; ++i) {
    tape.AddOutput(tape.Apply(Op::kExp, tape.Apply(Op::kMultiply, i, i + 1)));
  }
  return tape;
}

// The sum of term(i) from the left, as a loop writes it.
template <class Term>
Place Sum(Tape* tape, Term&& term) {
  Place sum = tape->Constant(0);
  for (int i = 0; i < tape->num_inputs(); ++i) sum = tape->Apply(Op::kAdd, sum, term(i));
  return sum;
}

Tape Norm(int n) {
  Tape tape(n);
  tape.AddOutput(
      tape.Apply(Op::kSqrt, Sum(&tape, [&](Place i) { return tape.Apply(Op::kMultiply, i, i); })));
  return tape;
}

TEST(PlannedWork, OfAChainIsLinear) {
  const PlannedWork small = WorkOf(Chain(1000));
  const PlannedWork large = WorkOf(Chain(4000));
  EXPECT_EQ(large.values, 4 * small.values);
  EXPECT_EQ(large.jacobian, 4 * small.jacobian);
  EXPECT_EQ(large.hessian, 4 * small.hessian);
  EXPECT_LE(small.jacobian, 2 * 1000);
  EXPECT_LE(small.hessian, 10 * 1000);
}

TEST(PlannedWork, OfASumOfSeparateTermsIsLinear) {
  Tape tape(1000);
  tape.AddOutput(Sum(&tape, [&](Place i) { return tape.Apply(Op::kExp, i); }));
  const TapeFunction f(tape);
  EXPECT_EQ(f.hessian().size(), 1000);
  EXPECT_EQ(f.Work().jacobian, 0);  // the derivatives are the values of exp
  EXPECT_LE(f.Work().hessian, 1000);
}

TEST(PlannedWork, OfANormIsQuadratic) {
  const int n = 200;
  const TapeFunction f(Norm(n));
  EXPECT_EQ(f.hessian().size(), n * (n + 1) / 2);
  EXPECT_LE(f.Work().hessian, n * (n + 1) / 2 + 3 * n);
  EXPECT_EQ(f.Work().jacobian, n);
}

TEST(PlannedWork, OfALinearFunctionIsNone) {
  Tape tape(50);
  const Place sum = Sum(&tape, [&](Place i) {
    return tape.Apply(Op::kMultiply, tape.Constant(i + 2), tape.Apply(Op::kNegate, i));
  });
  tape.AddOutput(tape.Apply(Op::kDivide, sum, tape.Constant(3)));
  const TapeFunction f(tape);
  EXPECT_EQ(f.Work().derivatives, 0);
  EXPECT_EQ(f.Work().jacobian, 0);
  EXPECT_EQ(f.Work().hessian, 0);
  EXPECT_EQ(f.hessian().size(), 0);
}

TEST(PlannedWork, OfAHessianLeavesOutWhatIsLinear) {
  Tape tape(2);  // 3 s + exp(x_0) and 5 s + exp(x_1) with s = x_0 + 2 x_1
  const Place sum = tape.Apply(Op::kAdd, 0, tape.Apply(Op::kMultiply, tape.Constant(2), 1));
  for (const int i : {0, 1}) {
    const Place linear = tape.Apply(Op::kMultiply, sum, tape.Constant(3 + 2 * i));
    tape.AddOutput(tape.Apply(Op::kAdd, linear, tape.Apply(Op::kExp, i)));
  }
  EXPECT_EQ(WorkOf(tape).hessian, 2);  // w_i exp(x_i)
}

TEST(PlannedWork, OfWhatNoOutputNeedsIsNone) {
  Tape tape = Chain(10);
  const PlannedWork before = WorkOf(tape);
  tape.Apply(Op::kSin, tape.Apply(Op::kMultiply, 3, 7));
  const PlannedWork after = WorkOf(tape);
  EXPECT_EQ(after.values, before.values);
  EXPECT_EQ(after.derivatives, before.derivatives);
}

TEST(PlannedWork, OfAHessianIsGivenUpWhereItIsTooLarge) {
  const Tape tape = Norm(100);
  const TapeFunction f(tape, {.most_hessian_terms = 5000});
  EXPECT_FALSE(f.has_hessian());
  EXPECT_EQ(f.Work().hessian, 0);
  const VectorXd x = VectorXd::Constant(100, 2);
  std::vector<double> ours(100);
  f.Evaluate({.x = x.data(), .jacobian = ours.data()});
  for (const double d : ours) EXPECT_DOUBLE_EQ(d, 0.1);
  EXPECT_EQ(
      Said([&] { f.Evaluate({.x = x.data(), .weights = ours.data(), .hessian = ours.data()}); }),
      "function: its Hessian is too large, so it has none");
  EXPECT_TRUE(TapeFunction(tape, {.most_hessian_terms = 20000}).has_hessian());
}

TEST(PlannedWork, GoesForwardWhereOutputsShareTheirOperations) {
  Tape tape(2);  // 30 outputs along one recursion
  Place p = 0;
  for (int k = 0; k < 30; ++k) {
    p = tape.Apply(Op::kSin, tape.Apply(Op::kMultiply, p, 1));
    tape.AddOutput(p);
  }
  EXPECT_TRUE(WorkOf(tape).jacobian_is_forward);
  EXPECT_FALSE(WorkOf(Chain(30)).jacobian_is_forward);
  EXPECT_FALSE(WorkOf(Norm(30)).jacobian_is_forward);
}

}  // namespace
}  // namespace switchyard
