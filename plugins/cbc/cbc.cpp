// CBC behind the table of switchyard/abi.h.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "CbcConfig.h"
#include "coin/host_log.hpp"
#include "coin/proofs.hpp"
#include "linear/answer.hpp"
#include "linear/start.hpp"
#include "search.hpp"
#include "switchyard/plugin.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::cbc {

using coin::ClpSession;
using coin::ClpWatch;
using linear::Given;
using linear::Watch;

class Solver {
 public:
  static sy_solver Describe();
  explicit Solver(const sy_host& host)
      : log_(host), quiet_(host), settings_(OptionTable(), "CBC") {}

  void SetOption(std::string_view name, const sy_value& value) { settings_.Set(name, value); }
  void Load(const sy_problem& problem, std::uint64_t updates);
  void WarmStart(const sy_start& start) {
    start_ = linear::Start(start, problem_.num_vars, problem_.num_rows);
  }
  void Solve(const sy_control& control, sy_result& result);

 private:
  [[nodiscard]] OsiClpSolverInterface Relaxation(const sy_control& control, ClpSession& session);
  bool SolveRelaxation(OsiClpSolverInterface& solver, Watch& watch, sy_result& result) const;
  void Branch(OsiClpSolverInterface& solver, ClpSession& session, sy_result& result);
  std::vector<double> CompleteStart(const OsiClpSolverInterface& relaxation) const;
  [[nodiscard]] bool Feasible(const std::vector<double>& x, double tolerance) const;
  [[nodiscard]] bool IsInteger(std::int32_t j) const {
    return problem_.integer != nullptr && problem_.integer[j] != 0;
  }
  [[nodiscard]] bool AnyInteger() const {
    return problem_.integer != nullptr &&
           std::any_of(problem_.integer, problem_.integer + problem_.num_vars,
                       [](std::uint8_t i) { return i != 0; });
  }

  coin::HostLog log_;
  coin::HostLog quiet_;
  linear::Settings settings_;
  linear::Start start_;
  sy_problem problem_{};  // borrowed: the host keeps it in place
};

void Solver::Load(const sy_problem& problem, std::uint64_t) {
  problem_ = problem;
  start_ = {};
}

OsiClpSolverInterface Solver::Relaxation(const sy_control& control, ClpSession& session) {
  const std::int32_t n = problem_.num_vars;
  const std::int32_t m = problem_.num_rows;
  const Csc none(m, n);
  const sy_csc a = problem_.A != nullptr ? *problem_.A : none.View();
  OsiClpSolverInterface solver;
  solver.passInMessageHandler(&quiet_);
  solver.loadProblem(n, m, a.start, a.row, a.value, Given(problem_.x_lower, n, -kInfinity).data(),
                     Given(problem_.x_upper, n, kInfinity).data(), Given(problem_.q, n, 0).data(),
                     Given(problem_.row_lower, m, -kInfinity).data(),
                     Given(problem_.row_upper, m, kInfinity).data());
  solver.setDblParam(OsiObjOffset, -problem_.offset);
  for (std::int32_t j = 0; j < n; ++j) {
    if (IsInteger(j)) solver.setInteger(j);
  }
  if (!std::isnan(control.feasibility)) solver.setDblParam(OsiPrimalTolerance, control.feasibility);
  if (!std::isnan(control.optimality)) solver.setDblParam(OsiDualTolerance, control.optimality);
  const ClpWatch stop(session);
  solver.getModelPtr()->passInEventHandler(&stop);
  return solver;
}

void Solver::Solve(const sy_control& control, sy_result& result) {
  Watch watch(control);
  linear::Clear(result);
  if (problem_.num_vars == 0) {
    constexpr double kTolerance = 1e-7;
    linear::AnswerWithoutVariables(problem_, kTolerance, result);
  } else {
    ClpSession session{watch, !AnyInteger()};
    log_.SetVerbosity(std::min(control.verbosity, 1));
    OsiClpSolverInterface solver = Relaxation(control, session);
    if (SolveRelaxation(solver, watch, result)) Branch(solver, session, result);
  }
  result.seconds = watch.Seconds();
}

// The relaxation is the answer of a problem without integers; else it is where the search begins:
// true where that is wanted.
bool Solver::SolveRelaxation(OsiClpSolverInterface& solver, Watch& watch, sy_result& result) const {
  solver.initialSolve();
  ClpSimplex& clp = *solver.getModelPtr();
  if (!watch.Stopped() && !coin::ProvesItsVerdict(clp)) coin::SeekProof(clp, watch);
  const bool integers = AnyInteger();
  result.iterations = solver.getIterationCount();
  linear::Say(result, "linear relaxation: CLP status " + std::to_string(clp.problemStatus()));
  if (watch.reason() != SY_NOT_SOLVED) {
    result.termination = watch.reason();
  } else if (solver.isProvenPrimalInfeasible()) {
    result.termination = SY_INFEASIBLE;
  } else if (solver.isProvenDualInfeasible()) {
    result.termination = integers ? SY_INFEASIBLE_OR_UNBOUNDED : SY_UNBOUNDED;
  } else if (!solver.isProvenOptimal()) {
    result.termination = SY_NUMERICAL_TROUBLE;
  } else {
    const std::vector<double> x(solver.getColSolution(),
                                solver.getColSolution() + problem_.num_vars);
    result.bound = result.relaxed = Objective(problem_, x.data());
    linear::Put(result.relaxed_x, x);
    if (integers) return true;
    result.termination = SY_OPTIMAL;
    result.primal = SY_FEASIBLE;
    result.objective = result.relaxed;
    result.relaxed = linear::kNaN;
    linear::Put(result.x, x);
  }
  return false;
}

void Solver::Branch(OsiClpSolverInterface& solver, ClpSession& session, sy_result& result) {
  const sy_control& control = session.watch.control();
  std::vector<double> best = CompleteStart(solver);
  double objective = best.empty() ? kInfinity : Objective(problem_, best.data());
  if (objective <= control.target) {
    session.watch.Stop(SY_TARGET);
  }
  cbc::Found found;
  if (session.watch.Stopped()) {
    found.termination = session.watch.reason();
    found.bound = result.bound;
  } else {
    found = Search(solver, settings_, std::min(objective, control.cutoff), log_, quiet_, session);
  }
  if (found.x) {
    const double value = Objective(problem_, found.x->data());
    if (value <= objective) {
      best = *found.x;
      objective = value;
    }
  }
  // A search below a limit that finds nothing proves that limit.
  if (found.termination == SY_INFEASIBLE && !best.empty() && objective <= control.cutoff) {
    found.termination = SY_OPTIMAL;
    found.bound = objective;
  } else if (found.termination == SY_INFEASIBLE && control.cutoff < kInfinity) {
    found.termination = SY_CUTOFF;
    found.bound = control.cutoff;
  }
  result.termination = found.termination;
  result.iterations += found.iterations;
  result.nodes = found.nodes;
  result.bound = std::min(found.bound, objective);
  linear::Say(result, found.text);
  if (best.empty()) return;
  constexpr double kLoosest = 1e-5;
  result.primal = Feasible(best, kLoosest) ? SY_FEASIBLE : SY_INFEASIBLE_POINT;
  result.objective = objective;
  linear::Put(result.x, best);
}

// The start with its integers fixed and the rest solved for; empty where it says too little or is
// infeasible.
std::vector<double> Solver::CompleteStart(const OsiClpSolverInterface& relaxation) const {
  if (start_.x.empty()) return {};
  OsiClpSolverInterface fixed(relaxation);
  for (std::int32_t j = 0; j < problem_.num_vars; ++j) {
    const double x = start_.x[static_cast<std::size_t>(j)];
    if (!IsInteger(j)) continue;
    if (std::isnan(x)) return {};
    fixed.setColBounds(j, std::round(x), std::round(x));
  }
  fixed.resolve();
  std::vector<double> x(fixed.getColSolution(), fixed.getColSolution() + problem_.num_vars);
  constexpr double kTight = 1e-6;
  return fixed.isProvenOptimal() && Feasible(x, kTight) ? x : std::vector<double>();
}

bool Solver::Feasible(const std::vector<double>& x, double tolerance) const {
  std::vector<double> rows(static_cast<std::size_t>(problem_.num_rows), 0.0);
  if (problem_.A != nullptr) MultiplyAdd(*problem_.A, 1, x.data(), rows.data());
  const auto fits = [tolerance](double value, const double* lower, const double* upper,
                                std::size_t k) {
    const double room = tolerance * std::max(1.0, std::abs(value));
    return (lower == nullptr || value >= lower[k] - room) &&
           (upper == nullptr || value <= upper[k] + room);
  };
  for (std::size_t j = 0; j < x.size(); ++j) {
    if (!fits(x[j], problem_.x_lower, problem_.x_upper, j)) return false;
    if (IsInteger(static_cast<std::int32_t>(j)) && std::abs(x[j] - std::round(x[j])) > tolerance) {
      return false;
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!fits(rows[i], problem_.row_lower, problem_.row_upper, i)) return false;
  }
  return true;
}

sy_solver Solver::Describe() {
  sy_solver t = {};
  t.id = "org.coin-or.cbc";
  t.name = "cbc";
  t.version = CBC_VERSION;
  t.license = "EPL-2.0";
  t.accepts = SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS | SY_ACCEPTS_INTEGER;
  t.integer_accepts = t.accepts;
  t.traits = SY_PROVES_GLOBAL | SY_GIVES_BOUND;
  t.honors = SY_HONORS_THREADS | SY_HONORS_SECONDS | SY_HONORS_ITERATIONS | SY_HONORS_NODES |
             SY_HONORS_CUTOFF | SY_HONORS_TARGET | SY_HONORS_FEASIBILITY | SY_HONORS_OPTIMALITY |
             SY_HONORS_INTEGRALITY | SY_HONORS_ABSOLUTE_GAP | SY_HONORS_RELATIVE_GAP |
             SY_HONORS_SEED | SY_HONORS_VERBOSITY | SY_HONORS_CANCELLED;
  t.options = OptionTable();
  return t;
}

}  // namespace switchyard::cbc

SY_PLUGIN("cbc", "1.0", switchyard::cbc::Solver)
