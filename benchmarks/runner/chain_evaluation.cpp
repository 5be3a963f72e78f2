// What one evaluation of a large sparse nonlinear program costs, as a backend asks for it.
//
//   chain_evaluation [VARIABLES ...]
//
// n variables in a ring, n rows sin(x_i) x_{i+1}^2 + x_i / 2 <= 1, the objective
// sum_i (x_{i+1} - x_i^2)^2: as 2n bindings of two shared functions, and as one function of n
// outputs and one of one. An evaluation asks the lowered sy_nlp, at a new point, for all there is:
// objective, gradient, constraints, Jacobian and Hessian; the last columns ask for one of them
// alone. `build` makes the program and records its functions, `lower` lowers it. Milliseconds of
// processor time, the best of several.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/lower/lowering.hpp"
#include "switchyard/error.hpp"
#include "switchyard/functions/make_function.hpp"

namespace {

using namespace switchyard;
using Made = std::unique_ptr<MathematicalProgram>;

constexpr double kInf = std::numeric_limits<double>::infinity();

template <class Work>
double BestMilliseconds(int turns, Work&& work) {
  double best = kInf;
  for (int k = 0; k < turns; ++k) {
    const std::clock_t start = std::clock();
    work();
    best = std::min(best, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return best;
}

const auto kRow = [](const auto& a, const auto& b) { return sin(a) * b * b + a / 2; };
const auto kTerm = [](const auto& a, const auto& b) {
  const auto t = b - a * a;
  return t * t;
};

Made AsManyBindings(int n) {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(n);
  const auto cost = std::make_shared<FunctionCost>(
      MakeFunction(2, [](const auto& v) { return kTerm(v[0], v[1]); }));
  const auto row = std::make_shared<FunctionConstraint>(
      MakeFunction(2, [](const auto& v) { return kRow(v[0], v[1]); }),
      Eigen::VectorXd::Constant(1, -kInf), Eigen::VectorXd::Constant(1, 1));
  for (int i = 0; i < n; ++i) {
    const VariableList neighbours{x[i], x[(i + 1) % n]};
    program->AddCost(cost, neighbours);
    program->AddConstraint(row, neighbours);
  }
  return program;
}

Made AsOneFunction(int n) {
  auto program = std::make_unique<MathematicalProgram>();
  const auto x = program->NewContinuousVariables(n);
  program->AddCost(
      [n](const auto& v) {
        auto sum = kTerm(v[0], v[1]);
        for (int i = 1; i < n; ++i) sum += kTerm(v[i], v[(i + 1) % n]);
        return sum;
      },
      x);
  program->AddConstraint(
      [n](const auto& v) {
        auto rows = v;
        for (int i = 0; i < n; ++i) rows[i] = kRow(v[i], v[(i + 1) % n]);
        return rows;
      },
      Eigen::VectorXd::Constant(n, -kInf), Eigen::VectorXd::Ones(n), x);
  return program;
}

/// A program as a backend sees it, and room for all that it can ask for.
class Asker {
 public:
  explicit Asker(const sy_nlp& nlp)
      : nlp_(nlp),
        x_(std::size_t(nlp.jacobian.cols), 0.3),
        multipliers_(std::size_t(nlp.num_constraints), 1.5),
        gradient_(x_.size()),
        constraints_(multipliers_.size()),
        jacobian_(std::size_t(nlp.jacobian.start[nlp.jacobian.cols])),
        hessian_(std::size_t(nlp.hessian.start[nlp.hessian.cols])) {}

  /// At a point where it has not been asked yet.
  void Ask(std::uint32_t want) {
    sy_evaluation e{};
    e.size = sizeof e;
    e.want = want;
    e.point = ++point_;
    x_[point_ % x_.size()] += 1e-3;
    e.x = x_.data();
    e.weight = 1;
    e.multipliers = multipliers_.data();
    e.objective = &objective_;
    e.gradient = gradient_.data();
    e.constraints = constraints_.data();
    e.jacobian = jacobian_.data();
    e.hessian = hessian_.data();
    Require(nlp_.evaluate(nlp_.context, &e) == SY_EVALUATED, "the program is not defined here");
  }

  /// A number that depends on everything: the same for both ways to write the program.
  [[nodiscard]] double Sum() const {
    double sum = objective_;
    for (const auto* all : {&gradient_, &constraints_, &jacobian_, &hessian_}) {
      for (const double v : *all) sum += v;
    }
    return sum;
  }

 private:
  const sy_nlp& nlp_;
  std::vector<double> x_, multipliers_;
  double objective_ = 0;
  std::vector<double> gradient_, constraints_, jacobian_, hessian_;
  std::uint64_t point_ = 0;
};

constexpr std::array<std::uint32_t, 5> kEach = {SY_OBJECTIVE, SY_GRADIENT, SY_CONSTRAINTS,
                                                SY_JACOBIAN, SY_HESSIAN};

double Measure(const std::string& name, Made (*make)(int), int n) {
  constexpr int kTurns = 21;
  constexpr int kFewTurns = 3;
  Made program;
  const double build = BestMilliseconds(kFewTurns, [&] { program = make(n); });
  const double lower = BestMilliseconds(kFewTurns, [&] { Lowering lowering(*program); });
  const Lowering lowering(*program);
  Asker asker(*lowering.problem().view().nlp);
  std::uint32_t everything = 0;
  for (const std::uint32_t one : kEach) everything |= one;
  const double all = BestMilliseconds(kTurns, [&] { asker.Ask(everything); });
  const double sum = asker.Sum();
  std::string line = fmt::format("{:<14}{:>8}{:>10.1f}{:>9.1f}{:>9.2f}{:>9.0f}  ", name, n, build,
                                 lower, all, 1e6 * all / n);
  for (const std::uint32_t one : kEach) {
    line += fmt::format("{:>9.2f}", BestMilliseconds(kTurns, [&] { asker.Ask(one); }));
  }
  fmt::print("{}\n", line);
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes = {5000, 10000, 20000, 40000};
  if (argc > 1) sizes.clear();
  for (int k = 1; k < argc; ++k) sizes.push_back(std::max(3, std::atoi(argv[k])));
  fmt::print("{:<14}{:>8}{:>10}{:>9}{:>9}{:>9}  {:>9}{:>9}{:>9}{:>9}{:>9}\n", "", "n", "build",
             "lower", "all", "ns / n", "objective", "gradient", "rows", "Jacobian", "Hessian");
  for (const int n : sizes) {
    const double many = Measure("bindings", AsManyBindings, n);
    const double one = Measure("one function", AsOneFunction, n);
    Require(std::abs(many - one) <= 1e-9 * std::abs(many), "the two programs differ: ", many,
            " and ", one);
  }
}
