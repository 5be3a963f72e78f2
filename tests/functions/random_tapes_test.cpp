// Tapes at random beside an evaluation that shares nothing with how they are compiled: hyper-dual
// numbers a + a_1 e_1 + a_2 e_2 + a_12 e_1 e_2 with e_1^2 = e_2^2 = 0, whose last part is a second
// derivative to rounding.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "core/functions/tape_function.hpp"
#include "switchyard/functions/check_derivatives.hpp"
#include "switchyard/functions/tape.hpp"
#include "tests/functions/evaluated.hpp"
#include "tests/functions/formulas.hpp"

namespace switchyard {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct HyperDual {
  double v = 0;
  double d1 = 0;
  double d2 = 0;
  double d12 = 0;
};

HyperDual Apply(Op op, const HyperDual& a, const HyperDual& b, const HyperDual& c) {
  if (op == Op::kIfPositive) return a.v > 0 ? b : c;
  if (op == Op::kIfNonnegative) return a.v >= 0 ? b : c;
  const auto row = std::find_if(kFormulas.begin(), kFormulas.end(),
                                [&](const OpFormula& f) { return f.op == op; });
  const auto [v, va, vb, vaa, vab, vbb] = row->formula(a.v, b.v);
  return {v, va * a.d1 + vb * b.d1, va * a.d2 + vb * b.d2,
          va * a.d12 + vb * b.d12 + vaa * a.d1 * a.d2 + vab * (a.d1 * b.d2 + a.d2 * b.d1) +
              vbb * b.d1 * b.d2};
}

std::vector<HyperDual> Outputs(const Tape& tape, const VectorXd& x, int i, int j) {
  std::vector<HyperDual> at;
  for (const Tape::Step& step : tape.steps()) {
    const int here = static_cast<int>(at.size());
    const auto operand = [&](int k) {
      return step.operand[k] < 0 ? HyperDual{} : at[step.operand[k]];
    };
    if (step.op == Op::kInput) {
      at.push_back({x[here], here == i ? 1.0 : 0.0, here == j ? 1.0 : 0.0, 0});
    } else if (step.op == Op::kConstant) {
      at.push_back({step.constant, 0, 0, 0});
    } else {
      at.push_back(Apply(step.op, operand(0), operand(1), operand(2)));
    }
  }
  std::vector<HyperDual> y;
  for (const auto place : tape.outputs()) y.push_back(at[place]);
  return y;
}

Evaluated ByHyperDuals(const Tape& tape, const VectorXd& x, const VectorXd& w) {
  const int n = tape.num_inputs();
  const int m = static_cast<int>(tape.outputs().size());
  Evaluated out{VectorXd::Zero(m), MatrixXd::Zero(m, n), MatrixXd::Zero(n, n)};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const auto y = Outputs(tape, x, i, j);
      for (int k = 0; k < m; ++k) {
        out.values[k] = y[k].v;
        out.jacobian(k, i) = y[k].d1;
        out.hessian(i, j) += w[k] * y[k].d12;
      }
    }
  }
  return out;
}

// Operations that are defined for all operands; of the others such compositions.
class RandomTape {
 public:
  RandomTape(unsigned seed, bool smooth) : random_(seed), smooth_(smooth), tape(2 + Below(5)) {
    for (int k = 0; k < tape.num_inputs(); ++k) places_.push_back(k);
    const int operations = 3 + Below(38);
    for (int k = 0; k < operations; ++k) places_.push_back(Operation());
    const int outputs = 1 + Below(4);
    for (int k = 0; k < outputs; ++k) tape.AddOutput(places_[places_.size() - 1 - Below(5)]);
    tape.AddOutput(tape.outputs()[0]);  // one place twice
  }

 private:
  using Place = Tape::Place;

  int Below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  Place Any() { return places_[Below(static_cast<int>(places_.size()))]; }
  Place Number() { return tape.Constant(0.25 * (Below(17) - 8)); }
  Place Positive(Place a) {
    return tape.Apply(Op::kAdd, tape.Apply(Op::kMultiply, a, a), tape.Constant(0.7));
  }
  Place Bounded(Place a) { return tape.Apply(Op::kSin, a); }

  Place Operation() {
    constexpr std::array kUnary = {Op::kSin, Op::kCos, Op::kTanh, Op::kAtan, Op::kNegate};
    constexpr std::array kOfBounded = {Op::kExp, Op::kSinh, Op::kCosh, Op::kTan};
    constexpr std::array kOfPositive = {Op::kSqrt, Op::kLog};
    constexpr std::array kBinary = {Op::kAdd, Op::kSubtract, Op::kMultiply};
    constexpr std::array kKinks = {Op::kMin, Op::kMax};
    const Place a = Any();
    const Place b = Any();
    switch (Below(smooth_ ? 11 : 14)) {
      case 0:
        return tape.Apply(kUnary[Below(5)], a);
      case 1:
        return tape.Apply(kOfBounded[Below(4)], Bounded(a));
      case 2:
        return tape.Apply(kOfPositive[Below(2)], Positive(a));
      case 3:
        return tape.Apply(Op::kDivide, a, Positive(b));
      case 4:
        return tape.Apply(Op::kPower, Positive(a), Bounded(b));
      case 5:
        return tape.Apply(Op::kPower, Positive(a), Number());
      case 6:
        return tape.Apply(Op::kAtan2, a, Positive(b));
      case 7:
        return tape.Apply(kBinary[Below(3)], a, Number());
      case 8:
        return tape.Apply(Op::kDivide, a, tape.Constant(-4));
      case 11:
        return tape.Apply(kKinks[Below(2)], a, b);
      case 12:
        return tape.Apply(Op::kIfPositive, a, b, Any());
      case 13:
        return tape.Apply(Op::kAbs, a);
      default:
        return tape.Apply(kBinary[Below(3)], a, b);
    }
  }

  std::mt19937 random_;
  bool smooth_;
  std::vector<Place> places_;

 public:
  Tape tape;
};

VectorXd RandomVector(int size, unsigned seed) {
  std::mt19937 source(seed);
  std::normal_distribution<double> normal;
  return VectorXd::NullaryExpr(size, [&] { return normal(source); });
}

void ExpectNear(const MatrixXd& ours, const MatrixXd& theirs, double tolerance) {
  if (ours.size() == 0) return;
  const double scale = std::max(1.0, theirs.cwiseAbs().maxCoeff());
  EXPECT_LE((ours - theirs).cwiseAbs().maxCoeff(), tolerance * scale) << "ours\n"
                                                                      << ours << "\ntheirs\n"
                                                                      << theirs;
}

TEST(RandomTapes, HaveTheDerivativesOfHyperDuals) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    const Tape tape = RandomTape(seed, false).tape;
    const VectorXd x = RandomVector(tape.num_inputs(), seed);
    const VectorXd w = RandomVector(static_cast<int>(tape.outputs().size()), seed + 1);
    const Evaluated theirs = ByHyperDuals(tape, x, w);
    for (const JacobianMode mode : {JacobianMode::kReverse, JacobianMode::kForward}) {
      const Evaluated ours = At(TapeFunction(tape, {.jacobian = mode}), x, w);
      ExpectNear(ours.values, theirs.values, 1e-12);
      ExpectNear(ours.jacobian, theirs.jacobian, 1e-11);
      ExpectNear(ours.hessian, theirs.hessian, 1e-10);
    }
    if (HasFailure()) return;
  }
}

TEST(RandomTapes, HaveTheDerivativesOfDifferences) {
  int checked = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Tape tape = RandomTape(seed, true).tape;
    const auto f = CompileTape(tape);
    const VectorXd x = RandomVector(tape.num_inputs(), seed);
    if (At(*f, x).hessian.cwiseAbs().maxCoeff() > 1e3) continue;  // steps are for smooth functions
    const DerivativeReport report = CheckDerivatives(*f, x);
    EXPECT_TRUE(report.agrees()) << to_string(report);
    ++checked;
  }
  EXPECT_GT(checked, 200);
}

TEST(RandomTapes, DoNotDependOnWhatWasEvaluatedBefore) {
  const Tape first = RandomTape(1, false).tape;
  const Tape second = RandomTape(2, false).tape;
  const TapeFunction f(first);
  const TapeFunction g(second);
  const VectorXd x = RandomVector(f.num_vars(), 3);
  const Evaluated alone = At(f, x);
  (void)At(g, RandomVector(g.num_vars(), 4));
  const Evaluated after = At(f, x);
  EXPECT_EQ(alone.values, after.values);
  EXPECT_EQ(alone.jacobian, after.jacobian);
  EXPECT_EQ(alone.hessian, after.hessian);
}

}  // namespace
}  // namespace switchyard
