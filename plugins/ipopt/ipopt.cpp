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
// The same without a bound: the error of the optimality conditions.
constexpr double kStationary = 1e-6;

bool IsSolved(sy_termination termination) {
  return termination == SY_OPTIMAL || termination == SY_LOCALLY_OPTIMAL;
}

/// The wish of the host where it is the stricter one.
double Stricter(double own, double asked) { return std::isnan(asked) ? own : std::min(own, asked); }

}  // namespace

void Solver::Supports(const sy_host&, const sy_problem& problem) {
  if (problem.nlp == nullptr) return;
  const auto lacks = [&](std::uint32_t what) { return (problem.nlp->provides & what) == 0; };
  const auto refuse = [](const char* what) {
    throw plugin::Failure(SY_E_UNSUPPORTED, std::string("Ipopt needs ") + what +
                                                "; the nonlinear functions come without");
  };
  if (HasObjective(problem) && lacks(SY_GRADIENT)) refuse("the gradient of the objective");
  if (!HasConstraints(problem)) return;
  if (lacks(SY_CONSTRAINTS)) refuse("the values of the constraints");
  if (lacks(SY_JACOBIAN)) refuse("the Jacobian of the constraints");
}

void Solver::Load(const sy_problem& problem, std::uint64_t) {
  Supports(host_, problem);
  problem_ = Problem(problem);
  FillBounds();
  start_ = last_ = {};
  start_is_new_ = false;
}

// Other functions are convex or not on their own account.
void Solver::Update(const sy_update& update) {
  if (update.problem != nullptr) Supports(host_, *update.problem);
  problem_.Apply(update);
  if ((update.whole & SY_UPDATES_NLP) != 0) {
    problem_.Change([&](ProblemData& d) { d.flags = update.problem->flags; });
  }
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
            take(start.row_dual, p.num_rows),
            take(start.nlp_dual, HasConstraints(p) ? p.nlp->num_constraints : 0)};
  start_is_new_ = true;
}

bool Solver::convex() const {
  const sy_problem& p = problem_.view();
  const bool linear = p.P == nullptr && !HasFunctions(p);
  return linear || (p.flags & SY_PROBLEM_CONVEX) != 0;
}

// A start given since the last solve replaces what that solve left.
const Point& Solver::Begin(bool proceed) {
  const bool from_last = proceed && !start_is_new_ && !last_.x.empty();
  start_is_new_ = false;
  return from_last ? last_ : start_;
}

void Solver::Solve(const sy_control& control, sy_result& result) {
  Watch watch(control);
  Functions functions(problem_.view(), watch);
  linear::Clear(result);
  if (!AnswerConstants(control, functions, result)) {
    const Point& start = Begin((control.flags & SY_CONTINUE) != 0);
    const Session session = {options_, host_, watch};
    if (watch.Stopped(0)) {
      result.termination = watch.reason();
      linear::Say(result, "stopped before the first iteration");
    } else {
      Report(Run(problem_.view(), functions, start, session), functions, session, result);
    }
  }
  result.seconds = watch.Seconds();
}

// Ipopt wants a variable that is not fixed.
bool Solver::AnswerConstants(const sy_control& control, Functions& functions,
                             sy_result& result) const {
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
  functions.Finish();
  const double allowed = std::isnan(control.feasibility) ? kFeasible : control.feasibility;
  const auto none = [](std::int32_t count) {
    return std::vector<double>(static_cast<std::size_t>(count), 0.0);
  };
  const std::int32_t constraints = HasConstraints(p) ? p.nlp->num_constraints : 0;
  const auto at =
      Measure(p, functions, {problem_.data().x_lower, {}, none(p.num_rows), none(constraints)});
  if (!at) {
    result.termination = SY_EVALUATION_FAILED;
    linear::Say(result, functions.ended() ? "a function ended the solve"
                                          : "all variables are fixed where the functions are not "
                                            "defined");
  } else if (constraints > 0 && at->violation > allowed) {
    result.termination = SY_INFEASIBLE;
    result.bound = kInfinity;
    linear::Say(result, "all variables are fixed where the constraints do not hold");
  } else {
    result.termination = SY_OPTIMAL;
    ReportPoint(*at, control, result);
    result.bound = result.objective;
    linear::Say(result, "no variable that is not fixed");
  }
  return true;
}

sy_termination Solver::Reason(const Found& found, const std::optional<Measured>& at,
                              const Functions& functions, const sy_control& control) const {
  const sy_termination solved = convex() ? SY_OPTIMAL : SY_LOCALLY_OPTIMAL;
  if (functions.ended()) return SY_EVALUATION_FAILED;
  switch (found.status) {
    case Ipopt::Solve_Succeeded:
      return at ? solved : SY_EVALUATION_FAILED;
    case Ipopt::Infeasible_Problem_Detected:
      return SY_LOCALLY_INFEASIBLE;
    case Ipopt::Maximum_Iterations_Exceeded:
      return SY_ITERATION_LIMIT;
    case Ipopt::Maximum_CpuTime_Exceeded:
      return SY_TIME_LIMIT;
    case Ipopt::Invalid_Number_Detected:
      return SY_EVALUATION_FAILED;
    case Ipopt::Insufficient_Memory:
      return SY_MEMORY_LIMIT;
    default:
      break;
  }
  // No step led further, and perhaps none was needed.
  const bool none_needed = HasFunctions(problem_.view()) && at &&
                           at->violation <= Stricter(kFeasible, control.feasibility) &&
                           at->optimality <= Stricter(kStationary, control.optimality);
  return none_needed ? solved : SY_NUMERICAL_TROUBLE;
}

void Solver::Report(Found found, Functions& functions, const Session& session, sy_result& result) {
  functions.Finish();
  std::optional<Measured> at;
  if (found.has_point) at = Measure(problem_.view(), functions, std::move(found.point));
  result.termination = found.status == Ipopt::User_Requested_Stop && !functions.ended()
                           ? session.watch.reason()
                           : Reason(found, at, functions, session.watch.control());
  result.iterations = found.iterations;
  linear::Say(result, Words(found, at, functions));
  last_ = {};
  if (at) {
    ReportPoint(*at, session.watch.control(), result);
    last_ = std::move(at->point);
  }
  if (result.termination == SY_LOCALLY_INFEASIBLE || found.status == Ipopt::Diverging_Iterates ||
      (result.termination == SY_NUMERICAL_TROUBLE && result.primal != SY_FEASIBLE)) {
    SeekProof(session, result);
  } else if (result.termination == SY_NUMERICAL_TROUBLE && result.primal == SY_FEASIBLE &&
             result.objective - result.bound <= kGap * (1 + std::abs(result.objective))) {
    result.termination = SY_OPTIMAL;  // no step led further, and none was needed
  }
}

// A dual is feasible where its objective is a bound at all; with functions there is no such bound,
// and the optimality conditions decide.
void Solver::ReportPoint(const Measured& at, const sy_control& control, sy_result& result) const {
  const sy_problem& p = problem_.view();
  const bool solved = IsSolved(result.termination);
  result.primal = solved || at.violation <= kFeasible ? SY_FEASIBLE : SY_INFEASIBLE_POINT;
  result.objective = at.objective;
  linear::Put(result.x, at.point.x);
  linear::Put(result.nlp_dual, at.point.nlp_dual);
  const Duals duals = {at.point.x_dual, at.point.row_dual};
  if (HasFunctions(p)) {
    const double asked = std::isnan(control.optimality) ? 0 : control.optimality;
    const bool holds = solved && at.optimality <= std::max(kStationary, asked);
    linear::Put(result, duals, holds ? SY_FEASIBLE : SY_INFEASIBLE_POINT);
    return;
  }
  const double bound = linear::DualObjective(p, at.point.x.data(), duals, linear::kRayNoise);
  linear::Put(result, duals, solved || bound > -kInfinity ? SY_FEASIBLE : SY_INFEASIBLE_POINT);
  if (convex()) result.bound = result.termination == SY_OPTIMAL ? result.objective : bound;
}

// "Infeasible" and "diverging" of Ipopt are local: a certificate makes them a verdict. Linear rows
// that contradict each other do so whatever the functions are; a ray says nothing of these.
void Solver::SeekProof(const Session& session, sy_result& result) const {
  const sy_problem& p = problem_.view();
  if (HasFunctions(p) && p.num_rows == 0) return;
  const Feasibility rows = SeekFarkas(p, session, result.iterations);
  result.iterations += rows.iterations;
  if (rows.farkas) {
    result.termination = SY_INFEASIBLE;
    result.primal = SY_NO_POINT;
    result.objective = linear::kNaN;
    result.bound = kInfinity;
    linear::Put(result, *rows.farkas, SY_CERTIFICATE);
    if (HasConstraints(p) && result.nlp_dual != nullptr) {
      std::fill_n(result.nlp_dual, p.nlp->num_constraints, 0.0);
    }
    return;
  }
  if (HasFunctions(p) || (!rows.has_point && result.primal != SY_FEASIBLE)) return;
  SeekUnboundedness(session, result);
}

void Solver::SeekUnboundedness(const Session& session, sy_result& result) const {
  const Recession descent = SeekRay(problem_.view(), session, result.iterations);
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
              SY_ACCEPTS_NONCONVEX_OBJECTIVE | SY_ACCEPTS_NLP;
  // Where a program is not convex the optimum is a local one; MUMPS keeps global state.
  t.traits = SY_NEEDS_GRADIENT | SY_GIVES_DUALS | SY_GIVES_CERTIFICATES | SY_ONE_AT_A_TIME |
             SY_OPEN_OPTIONS;
  t.honors = SY_HONORS_THREADS | SY_HONORS_SECONDS | SY_HONORS_ITERATIONS | SY_HONORS_FEASIBILITY |
             SY_HONORS_OPTIMALITY | SY_HONORS_VERBOSITY | SY_HONORS_CANCELLED;
  t.updates = SY_UPDATES_BOUNDS | SY_UPDATES_VECTORS | SY_UPDATES_VALUES | SY_UPDATES_NLP;
  t.options = OptionTable();
  return t;
}

}  // namespace switchyard::ipopt

SY_PLUGIN("ipopt", "1.0", switchyard::ipopt::Solver)
