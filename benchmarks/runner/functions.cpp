// What functions cost that are given by their operations: compiling, values, all derivatives.
//
//   functions
//
// chain n: n outputs sin(x_i) x_{i+1}^2 + x_i / 2 of n + 1 inputs. tiny: 5 operations of 2 inputs.
// norm n: the root of a sum of n squares, whose Hessian is dense. shooting n: the 2n states of a
// pendulum under n inputs, each a function of all inputs before it. Times are the best of several;
// `all` is values, Jacobian and Hessian in one call.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>
#include <vector>

#include "switchyard/functions/tape.hpp"

namespace {

using namespace switchyard;
using Place = Tape::Place;

template <class Work>
double BestMilliseconds(int turns, Work&& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < turns; ++k) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> passed =
        std::chrono::steady_clock::now() - start;
    best = std::min(best, passed.count());
  }
  return best;
}

Tape Chain(int n) {
  Tape tape(n + 1);
  for (int i = 0; i < n; ++i) {
    const Place square = tape.Apply(Op::kMultiply, i + 1, i + 1);
    const Place product = tape.Apply(Op::kMultiply, tape.Apply(Op::kSin, i), square);
    tape.AddOutput(tape.Apply(Op::kAdd, product, tape.Apply(Op::kDivide, i, tape.Constant(2))));
  }
  return tape;
}

// (sin(x y) + x) exp(y)
Tape Tiny(int) {
  Tape tape(2);
  const Place sine = tape.Apply(Op::kSin, tape.Apply(Op::kMultiply, 0, 1));
  tape.AddOutput(tape.Apply(Op::kMultiply, tape.Apply(Op::kAdd, sine, 0), tape.Apply(Op::kExp, 1)));
  return tape;
}

Tape Norm(int n) {
  Tape tape(n);
  Place sum = tape.Constant(0);
  for (int i = 0; i < n; ++i) sum = tape.Apply(Op::kAdd, sum, tape.Apply(Op::kMultiply, i, i));
  tape.AddOutput(tape.Apply(Op::kSqrt, sum));
  return tape;
}

Tape Shooting(int n) {
  Tape tape(n + 2);
  const Place step = tape.Constant(0.05);
  Place angle = n;
  Place speed = n + 1;
  for (int k = 0; k < n; ++k) {
    const Place acceleration = tape.Apply(Op::kSubtract, k, tape.Apply(Op::kSin, angle));
    angle = tape.Apply(Op::kAdd, angle, tape.Apply(Op::kMultiply, step, speed));
    speed = tape.Apply(Op::kAdd, speed, tape.Apply(Op::kMultiply, step, acceleration));
    tape.AddOutput(angle);
    tape.AddOutput(speed);
  }
  return tape;
}

void Measure(const std::string& name, Tape (*make)(int), int n) {
  const double record = BestMilliseconds(3, [&] { (void)make(n); });
  const Tape tape = make(n);
  const double compile = BestMilliseconds(3, [&] { (void)CompileTape(tape); });
  const auto f = CompileTape(tape);
  const std::vector<double> x(f->num_vars(), 0.3);
  const std::vector<double> w(f->num_outputs(), 1.5);
  std::vector<double> values(f->num_outputs());
  std::vector<double> jacobian(f->jacobian().row.size());
  std::vector<double> hessian(f->hessian().row.size());
  const Evaluation only_values{.x = x.data(), .values = values.data()};
  const Evaluation all{.x = x.data(),
                       .values = values.data(),
                       .jacobian = jacobian.data(),
                       .weights = w.data(),
                       .hessian = hessian.data()};
  const int calls = std::max(1, 100000 / static_cast<int>(tape.steps().size()));
  const auto time = [&](const Evaluation& wanted) {
    const auto evaluate = [&] {
      for (int k = 0; k < calls; ++k) f->Evaluate(wanted);
    };
    return BestMilliseconds(20, evaluate) / calls;
  };
  const double operations = static_cast<double>(tape.steps().size()) - f->num_vars();
  const double each = time(only_values);
  const double whole = time(all);
  fmt::print("{:<14}{:>10.0f}{:>9.2f}{:>9.2f}{:>11.5f}{:>11.5f}{:>9.1f}{:>9.1f}\n",
             fmt::format("{} {}", name, n), operations, record, compile, each, whole,
             1e6 * each / operations, 1e6 * whole / operations);
}

}  // namespace

int main() {
  fmt::print("{:<14}{:>10}{:>9}{:>9}{:>11}{:>11}{:>9}{:>9}\n", "", "operations", "record",
             "compile", "values", "all", "values", "all");
  fmt::print("{:<14}{:>10}{:>9}{:>9}{:>11}{:>11}{:>9}{:>9}\n", "", "", "ms", "ms", "ms", "ms",
             "ns/op", "ns/op");
  for (const int n : {10000, 20000, 40000}) Measure("chain", Chain, n);
  Measure("tiny", Tiny, 5);
  for (const int n : {100, 200, 400}) Measure("norm", Norm, n);
  for (const int n : {100, 200, 400}) Measure("shooting", Shooting, n);
}
