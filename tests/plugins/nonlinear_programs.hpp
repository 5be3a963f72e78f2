// nonlinear_programs.hpp - nonlinear programs written by hand, and the checks of abi.h's optimality
// conditions.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "programs.hpp"

namespace switchyard::test {

using Vector = std::vector<double>;
using Matrix = std::vector<Vector>;  // by rows

/// f and lower <= c(x) <= upper with dense derivatives; what is empty is not provided.
struct Functions {
  Vector lower, upper;
  std::function<double(const Vector&)> f;
  std::function<Vector(const Vector&)> gradient;
  std::function<Vector(const Vector&)> c;
  std::function<Matrix(const Vector&)> jacobian;
  std::function<Matrix(const Vector&, double, const double*)> hessian;  // of weight f + y'c
  Matrix jacobian_pattern, hessian_pattern;        // not 0 where there may be an entry
  std::function<sy_verdict(const Vector&)> judge;  // asked first at every point
};

/// The program in place, as a host holds it: a record over the functions, which counts and checks
/// the calls.
class HandWritten {
 public:
  HandWritten(ProblemData data, Functions functions)
      : functions_(std::move(functions)),
        jacobian_(Dense(functions_.jacobian_pattern, data.num_vars)),
        hessian_(Dense(functions_.hessian_pattern, data.num_vars)),
        data_(std::move(data)) {
    hessian_.rows = data_.num_vars;
    nlp_.size = sizeof nlp_;
    nlp_.context = this;
    nlp_.evaluate = [](void* context, sy_evaluation* e) noexcept {
      return static_cast<HandWritten*>(context)->Evaluate(*e);
    };
    Renew();
  }
  HandWritten(const HandWritten&) = delete;
  HandWritten& operator=(const HandWritten&) = delete;

  [[nodiscard]] const sy_problem& problem() const { return problem_.view(); }
  [[nodiscard]] const ProblemData& data() const { return data_; }
  [[nodiscard]] const Functions& functions() const { return functions_; }
  [[nodiscard]] std::size_t num_constraints() const { return functions_.lower.size(); }

  /// Changes the functions, patterns kept, or the flags of the problem.
  template <class Edit>
  void Change(Edit&& edit) {
    edit(functions_, data_);
    Renew();
  }

  std::int64_t calls = 0;
  std::uint32_t wanted = 0;        // SY_OBJECTIVE ...: all that was ever asked for
  double farthest_outside = 0;     // of the bounds of the variables
  std::int64_t wrong_numbers = 0;  // of points: calls with one that another x has
  std::int64_t calls_after_abort = 0;

 private:
  void Renew() {
    const auto provided = [](bool has, std::uint32_t what) { return has ? what : 0; };
    nlp_.provides = provided(bool(functions_.f), SY_OBJECTIVE) |
                    provided(bool(functions_.gradient), SY_GRADIENT) |
                    provided(bool(functions_.c), SY_CONSTRAINTS) |
                    provided(bool(functions_.jacobian), SY_JACOBIAN) |
                    provided(bool(functions_.hessian), SY_HESSIAN);
    nlp_.num_constraints = static_cast<std::int32_t>(functions_.lower.size());
    nlp_.lower = functions_.lower.data();
    nlp_.upper = functions_.upper.data();
    nlp_.jacobian = jacobian_.View();
    nlp_.hessian = hessian_.View();
    data_.nlp = &nlp_;
    problem_ = Problem(data_);
  }

  sy_verdict Evaluate(sy_evaluation& e) {
    ++calls;
    if (aborted_) ++calls_after_abort;
    wanted |= e.want;
    const Vector x(e.x, e.x + data_.num_vars);
    if (points_.try_emplace(e.point, x).first->second != x) ++wrong_numbers;
    for (std::size_t j = 0; j < x.size() && !data_.x_lower.empty(); ++j) {
      farthest_outside =
          std::max({farthest_outside, data_.x_lower[j] - x[j], x[j] - data_.x_upper[j]});
    }
    const sy_verdict verdict = functions_.judge ? functions_.judge(x) : SY_EVALUATED;
    aborted_ = verdict == SY_ABORT;
    if (verdict == SY_EVALUATED) Answer(e, x);
    return verdict;
  }

  void Answer(sy_evaluation& e, const Vector& x) const {
    const auto asked = [&](std::uint32_t what) { return (e.want & what) != 0; };
    const auto give = [](const Vector& values, double* to) {
      std::copy(values.begin(), values.end(), to);
    };
    if (asked(SY_OBJECTIVE)) *e.objective = functions_.f(x);
    if (asked(SY_GRADIENT)) give(functions_.gradient(x), e.gradient);
    if (asked(SY_CONSTRAINTS)) give(functions_.c(x), e.constraints);
    if (asked(SY_JACOBIAN)) GiveEntries(functions_.jacobian(x), jacobian_, e.jacobian);
    if (!asked(SY_HESSIAN)) return;
    GiveEntries(functions_.hessian(x, e.weight, e.multipliers), hessian_, e.hessian);
  }

  static void GiveEntries(const Matrix& dense, const Csc& pattern, double* to) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(pattern.cols); ++j) {
      for (auto k = pattern.start[j]; k < pattern.start[j + 1]; ++k) {
        to[k] = dense[static_cast<std::size_t>(pattern.row[static_cast<std::size_t>(k)])][j];
      }
    }
  }

  Functions functions_;
  Csc jacobian_, hessian_;
  ProblemData data_;
  sy_nlp nlp_{};
  Problem problem_;
  std::map<std::uint64_t, Vector> points_;  // by their numbers
  bool aborted_ = false;
};

/// An answer with the duals of c.
struct NonlinearAnswer : Answer {
  Vector nlp_dual;
};

inline NonlinearAnswer Solve(BareSolver& solver, const HandWritten& program,
                             const sy_control& control = Freely()) {
  NonlinearAnswer a;
  const auto vars = static_cast<std::size_t>(program.data().num_vars);
  a.x.assign(vars, kNaN);
  a.x_dual.assign(vars, kNaN);
  a.row_dual.assign(program.data().row_lower.size(), kNaN);
  a.nlp_dual.assign(program.num_constraints(), kNaN);
  char text[256] = "";
  a.result.size = sizeof a.result;
  a.result.x = a.x.data();
  a.result.x_dual = a.x_dual.data();
  a.result.row_dual = a.row_dual.data();
  a.result.nlp_dual = a.nlp_dual.data();
  a.result.text = text;
  a.result.text_size = sizeof text;
  EXPECT_EQ(solver.table().solve(solver.instance(), &control, &a.result, &solver.error()), SY_OK)
      << solver.error().text;
  a.text = text;
  return a;
}

/// From `x`, in a new instance.
inline NonlinearAnswer SolveFrom(const Named& named, const HandWritten& program, const Vector& x) {
  BareSolver solver(named);
  solver.Load(program.problem());
  sy_start start = {};
  start.size = sizeof start;
  start.x = x.data();
  solver.WarmStart(start);
  return Solve(solver, program);
}

inline bool IsSolved(const NonlinearAnswer& a) {
  return a.result.termination == SY_OPTIMAL || a.result.termination == SY_LOCALLY_OPTIMAL;
}

/// How near solvers come: those with duals by the optimality conditions, others by small steps.
inline double ToleranceOf(const BareSolver& solver) {
  return solver.Has(SY_GIVES_DUALS) ? 1e-6 : 1e-4;
}

/// Px + q + grad f - A'row_dual - J'nlp_dual - x_dual, its largest entry.
inline double Stationarity(const HandWritten& program, const NonlinearAnswer& a) {
  const Functions& functions = program.functions();
  const ProblemData& d = program.data();
  Vector rest = d.q;
  SymmetricMultiplyAdd(d.P.View(), 1, a.x.data(), rest.data());
  TransposedMultiplyAdd(d.A.View(), -1, a.row_dual.data(), rest.data());
  const Vector gradient = functions.f ? functions.gradient(a.x) : Vector(rest.size(), 0.0);
  const Matrix jacobian = functions.c ? functions.jacobian(a.x) : Matrix();
  double worst = 0;
  for (std::size_t j = 0; j < rest.size(); ++j) {
    double entry = rest[j] + gradient[j] - a.x_dual[j];
    for (std::size_t i = 0; i < jacobian.size(); ++i) entry -= jacobian[i][j] * a.nlp_dual[i];
    worst = std::max(worst, std::abs(entry));
  }
  return worst;
}

/// The largest |d| min(1, distance to the side d stands against): 0 where signs and complementarity
/// are as abi.h has them.
inline double Slackness(const Vector& dual, const Vector& value, const Vector& lower,
                        const Vector& upper) {
  double worst = 0;
  for (std::size_t k = 0; k < dual.size(); ++k) {
    const double distance = dual[k] > 0 ? value[k] - lower[k] : upper[k] - value[k];
    worst = std::max(worst, std::abs(dual[k]) * std::min(1.0, std::abs(distance)));
  }
  return worst;
}

/// Feasible, with the objective it says, and where there are duals a point of the optimality
/// conditions.
inline void ExpectLocalOptimum(const HandWritten& program, const BareSolver& solver,
                               const NonlinearAnswer& a) {
  ASSERT_TRUE(IsSolved(a)) << a.text << " (" << a.result.termination << ")";
  ASSERT_EQ(a.result.primal, SY_FEASIBLE);
  const ProblemData& d = program.data();
  const Functions& functions = program.functions();
  const double scale = 1 + std::abs(a.result.objective);
  const double tolerance = ToleranceOf(solver) * scale;
  EXPECT_LE(Violation(d, a.x), tolerance);
  const Vector c = functions.c ? functions.c(a.x) : Vector();
  for (std::size_t i = 0; i < c.size(); ++i) {
    EXPECT_GE(c[i], functions.lower[i] - tolerance) << "c[" << i << "]";
    EXPECT_LE(c[i], functions.upper[i] + tolerance) << "c[" << i << "]";
  }
  const double f = functions.f ? functions.f(a.x) : 0;
  EXPECT_NEAR(a.result.objective, Objective(program.problem(), a.x.data()) + f, 1e-9 * scale);
  EXPECT_LE(a.result.bound, a.result.objective + tolerance);
  EXPECT_LE(program.farthest_outside, 0) << "asked outside the bounds";
  EXPECT_EQ(program.wrong_numbers, 0);
  if (!solver.Has(SY_GIVES_DUALS)) return;
  ASSERT_EQ(a.result.dual, SY_FEASIBLE);
  EXPECT_LE(Stationarity(program, a), 1e-9 * scale);
  Vector rows(d.row_lower.size(), 0.0);
  MultiplyAdd(d.A.View(), 1, a.x.data(), rows.data());
  EXPECT_LE(Slackness(a.x_dual, a.x, d.x_lower, d.x_upper), 10 * tolerance);
  EXPECT_LE(Slackness(a.row_dual, rows, d.row_lower, d.row_upper), 10 * tolerance);
  EXPECT_LE(Slackness(a.nlp_dual, c, functions.lower, functions.upper), 10 * tolerance);
}

/// A problem of variables in a box and no rows or costs.
inline ProblemData Box(Vector lower, Vector upper) {
  Vector q(lower.size(), 0.0);
  return Linear(std::move(q), std::move(lower), std::move(upper), {}, {}, {});
}

inline ProblemData Free(std::size_t vars) {
  return Box(Vector(vars, -kInfinity), Vector(vars, kInfinity));
}

}  // namespace switchyard::test
