#include "ipopt.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "IpoptConfig.h"
#include "linear/answer.hpp"
#include "proofs.hpp"
#include "switchyard/plugin.hpp"
#include "switchyard/problem_update.hpp"

namespace switchyard::ipopt {
namespace {

using linear::Duals;
using linear::Watch;

// Relative violation of a point that is feasible, where Ipopt has not said so itself.
constexpr double kFeasible = 1e-7;
// Relative gap to the bound of its duals of a point that is optimal, where Ipopt has not said so.
constexpr double kGap = 1e-8;

/// The largest violation of a row, relative to the row's largest term. The bounds hold.
double Violation(const sy_problem& p, const std::vector<double>& x) {
  std::vector<double> value(static_cast<std::size_t>(p.num_rows), 0.0);
  std::vector<double> largest(value.size(), 0.0);
  for (std::int32_t j = 0; p.A != nullptr && j < p.num_vars; ++j) {
    for (std::int32_t k = p.A->start[j]; k < p.A->start[j + 1]; ++k) {
      const auto i = static_cast<std::size_t>(p.A->row[k]);
      const double term = p.A->value[k] * x[static_cast<std::size_t>(j)];
      value[i] += term;
      largest[i] = std::max(largest[i], std::abs(term));
    }
  }
  double worst = 0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const double outside = std::max(p.row_lower[i] - value[i], value[i] - p.row_upper[i]);
    worst = std::max(worst, outside / (1 + largest[i]));
  }
  return worst;
}

/// The name of Ipopt's status.
const char* Words(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
      return "Solve_Succeeded";
    case Ipopt::Solved_To_Acceptable_Level:
      return "Solved_To_Acceptable_Level";
    case Ipopt::Infeasible_Problem_Detected:
      return "Infeasible_Problem_Detected";
    case Ipopt::Search_Direction_Becomes_Too_Small:
      return "Search_Direction_Becomes_Too_Small";
    case Ipopt::Diverging_Iterates:
      return "Diverging_Iterates";
    case Ipopt::User_Requested_Stop:
      return "User_Requested_Stop";
    case Ipopt::Feasible_Point_Found:
      return "Feasible_Point_Found";
    case Ipopt::Maximum_Iterations_Exceeded:
      return "Maximum_Iterations_Exceeded";
    case Ipopt::Restoration_Failed:
      return "Restoration_Failed";
    case Ipopt::Error_In_Step_Computation:
      return "Error_In_Step_Computation";
    case Ipopt::Maximum_CpuTime_Exceeded:
      return "Maximum_CpuTime_Exceeded";
    case Ipopt::Not_Enough_Degrees_Of_Freedom:
      return "Not_Enough_Degrees_Of_Freedom";
    case Ipopt::Invalid_Number_Detected:
      return "Invalid_Number_Detected";
    case Ipopt::Insufficient_Memory:
      return "Insufficient_Memory";
    default:
      return "another status";
  }
}

}  // namespace

void Solver::Load(const sy_problem& problem, std::uint64_t) {
  problem_ = Problem(problem);
  FillBounds();
  start_ = last_ = {};
  start_is_new_ = false;
}

void Solver::Update(const sy_update& update) {
  problem_.Apply(update);
  FillBounds();
}

void Solver::FillBounds() {
  problem_.Change([](ProblemData& d) {
    const auto n = static_cast<std::size_t>(d.num_vars);
    d.x_lower.resize(n, -kInfinity);
    d.x_upper.resize(n, kInfinity);
  });
}

void Solver::WarmStart(const sy_start& start) {
  const auto take = [](const double* from, std::int32_t count) {
    return from != nullptr ? std::vector<double>(from, from + count) : std::vector<double>();
  };
  const sy_problem& p = problem_.view();
  start_ = {take(start.x, p.num_vars), take(start.x_dual, p.num_vars),
            take(start.row_dual, p.num_rows)};
  start_is_new_ = true;
}

bool Solver::convex() const {
  const sy_problem& p = problem_.view();
  return p.P == nullptr || (p.flags & SY_PROBLEM_CONVEX) != 0;
}

// A start given since the last solve replaces what that solve left.
const Point& Solver::Begin(bool proceed) {
  const bool from_last = proceed && !start_is_new_ && !last_.x.empty();
  start_is_new_ = false;
  return from_last ? last_ : start_;
}

void Solver::Solve(const sy_control& control, sy_result& result) {
  Watch watch(control);
  linear::Clear(result);
  if (AnswerConstants(control, result)) {
    result.seconds = watch.Seconds();
    return;
  }
  const Point& start = Begin((control.flags & SY_CONTINUE) != 0);
  if (watch.Stopped(0)) {
    result.termination = watch.reason();
    linear::Say(result, "stopped before the first iteration");
  } else {
    Report(Run(problem_.view(), start, options_, host_, watch), watch, result);
  }
  result.seconds = watch.Seconds();
}

// Ipopt wants a variable that is not fixed.
bool Solver::AnswerConstants(const sy_control& control, sy_result& result) const {
  const sy_problem& p = problem_.view();
  const double tolerance =
      std::isnan(control.feasibility) ? options_.Real("tol") : control.feasibility;
  if (const auto proof = ContradictionOfConstants(p, tolerance)) {
    result.termination = SY_INFEASIBLE;
    linear::Put(result, *proof, SY_CERTIFICATE);
    linear::Say(result, "a row of constants does not hold");
    return true;
  }
  for (std::int32_t j = 0; j < p.num_vars; ++j) {
    if (p.x_lower[j] != p.x_upper[j]) return false;
  }
  result.termination = SY_OPTIMAL;
  const std::vector<double> none(static_cast<std::size_t>(p.num_rows), 0.0);
  ReportPoint({problem_.data().x_lower, {}, none}, result);
  result.bound = result.objective;
  linear::Say(result, "no variable that is not fixed");
  return true;
}

sy_termination Solver::Reason(const Found& found, const Watch& watch) const {
  switch (found.status) {
    case Ipopt::Solve_Succeeded:
      return convex() ? SY_OPTIMAL : SY_LOCALLY_OPTIMAL;
    case Ipopt::Infeasible_Problem_Detected:
      return SY_LOCALLY_INFEASIBLE;
    case Ipopt::User_Requested_Stop:
      return watch.reason();
    case Ipopt::Maximum_Iterations_Exceeded:
      return SY_ITERATION_LIMIT;
    case Ipopt::Maximum_CpuTime_Exceeded:
      return SY_TIME_LIMIT;
    case Ipopt::Invalid_Number_Detected:
      return SY_EVALUATION_FAILED;
    case Ipopt::Insufficient_Memory:
      return SY_MEMORY_LIMIT;
    default:
      return SY_NUMERICAL_TROUBLE;
  }
}

void Solver::Report(Found found, Watch& watch, sy_result& result) {
  result.termination = Reason(found, watch);
  result.iterations = found.iterations;
  linear::Say(result, Words(found.status));
  last_ = {};
  if (found.has_point) {
    ReportPoint(found.point, result);
    const sy_problem& p = problem_.view();
    Duals duals = linear::Complete(p, found.point.x.data(), found.point.row_dual);
    last_ = {std::move(found.point.x), std::move(duals.x), std::move(duals.row)};
  }
  if (result.termination == SY_LOCALLY_INFEASIBLE || found.status == Ipopt::Diverging_Iterates ||
      (result.termination == SY_NUMERICAL_TROUBLE && result.primal != SY_FEASIBLE)) {
    SeekProof(watch, result);
  } else if (result.termination == SY_NUMERICAL_TROUBLE && result.primal == SY_FEASIBLE &&
             result.objective - result.bound <= kGap * (1 + std::abs(result.objective))) {
    result.termination = SY_OPTIMAL;  // no step led further, and none was needed
  }
}

// A dual is feasible where its objective is a bound at all.
void Solver::ReportPoint(const Point& point, sy_result& result) const {
  const sy_problem& p = problem_.view();
  const bool solved = result.termination == SY_OPTIMAL || result.termination == SY_LOCALLY_OPTIMAL;
  const bool feasible = solved || Violation(p, point.x) <= kFeasible;
  result.primal = feasible ? SY_FEASIBLE : SY_INFEASIBLE_POINT;
  result.objective = Objective(p, point.x.data());
  linear::Put(result.x, point.x);
  const Duals duals = linear::Complete(p, point.x.data(), point.row_dual);
  const double bound = linear::DualObjective(p, point.x.data(), duals, linear::kRayNoise);
  linear::Put(result, duals, solved || bound > -kInfinity ? SY_FEASIBLE : SY_INFEASIBLE_POINT);
  if (convex()) result.bound = result.termination == SY_OPTIMAL ? result.objective : bound;
}

// "Infeasible" and "diverging" of Ipopt are local: a certificate makes them a verdict.
void Solver::SeekProof(Watch& watch, sy_result& result) {
  const sy_problem& p = problem_.view();
  const Feasibility rows = SeekFarkas(p, options_, host_, watch, result.iterations);
  result.iterations += rows.iterations;
  if (rows.farkas) {
    result.termination = SY_INFEASIBLE;
    result.primal = SY_NO_POINT;
    result.objective = linear::kNaN;
    result.bound = kInfinity;
    linear::Put(result, *rows.farkas, SY_CERTIFICATE);
  }
  if (rows.farkas || (!rows.has_point && result.primal != SY_FEASIBLE)) return;
  const Recession descent = SeekRay(p, options_, host_, watch, result.iterations);
  result.iterations += descent.iterations;
  if (!descent.ray) return;
  result.termination = SY_UNBOUNDED;
  result.primal = SY_CERTIFICATE;
  result.dual = SY_NO_POINT;
  result.objective = result.bound = -kInfinity;
  linear::Put(result.x, *descent.ray);
}

sy_solver Solver::Describe() {
  sy_solver t = {};
  t.id = "org.coin-or.ipopt";
  t.name = "ipopt";
  t.version = IPOPT_VERSION;
  t.license = IPOPT_VERSION_MAJOR > 3 || IPOPT_VERSION_MINOR >= 14 ? "EPL-2.0" : "EPL-1.0";
  t.accepts = SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS | SY_ACCEPTS_QUADRATIC_OBJECTIVE |
              SY_ACCEPTS_NONCONVEX_OBJECTIVE;
  // Of a nonconvex objective the optimum is a local one; MUMPS keeps global state.
  t.traits = SY_GIVES_DUALS | SY_GIVES_CERTIFICATES | SY_ONE_AT_A_TIME | SY_OPEN_OPTIONS;
  t.honors = SY_HONORS_THREADS | SY_HONORS_SECONDS | SY_HONORS_ITERATIONS | SY_HONORS_FEASIBILITY |
             SY_HONORS_OPTIMALITY | SY_HONORS_VERBOSITY | SY_HONORS_CANCELLED;
  t.updates = SY_UPDATES_BOUNDS | SY_UPDATES_VECTORS | SY_UPDATES_VALUES;
  t.options = OptionTable();
  return t;
}

}  // namespace switchyard::ipopt

SY_PLUGIN("ipopt", "1.0", switchyard::ipopt::Solver)
