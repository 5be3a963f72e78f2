#include "nlopt.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "linear/answer.hpp"
#include "proofs.hpp"
#include "switchyard/plugin.hpp"
#include "switchyard/problem_update.hpp"

namespace switchyard::nlopt {
namespace {

using linear::Watch;

// Relative violation of a point that is nearly feasible.
constexpr double kNearly = 1e-3;

bool IsConvex(const sy_problem& p) {
  return (p.flags & SY_PROBLEM_CONVEX) != 0 || (p.P == nullptr && p.nlp == nullptr);
}

}  // namespace

void Solver::Supports(const sy_host&, const sy_problem& problem) {
  const std::int32_t rows = problem.num_rows;
  const std::int32_t nonlinear = problem.nlp != nullptr ? problem.nlp->num_constraints : 0;
  const double entries =
      static_cast<double>(problem.num_vars) * (static_cast<double>(rows) + nonlinear);
  if (entries <= kMostEntries) return;
  throw plugin::Failure(SY_E_UNSUPPORTED,
                        "NLopt's matrices are dense: " + std::to_string(problem.num_vars) +
                            " variables by " + std::to_string(rows) + " rows and " +
                            std::to_string(nonlinear) + " nonlinear constraints is more than " +
                            linear::Join(kMostEntries) + " numbers");
}

void Solver::Load(const sy_problem& problem, std::uint64_t) {
  Supports(host_, problem);
  problem_ = Problem(problem);
  Complete();
  start_.clear();
  last_.clear();
  start_is_new_ = false;
}

void Solver::Update(const sy_update& update) {
  problem_.Apply(update);
  if ((update.whole & SY_UPDATES_NLP) != 0) {  // other functions are convex, or not
    problem_.Change([&](ProblemData& d) { d.flags = update.problem->flags; });
  }
  Complete();
}

// All bounds, and no nlp that is empty.
void Solver::Complete() {
  problem_.Change([](ProblemData& d) {
    const auto n = static_cast<std::size_t>(d.num_vars);
    d.x_lower.resize(n, -kInfinity);
    d.x_upper.resize(n, kInfinity);
    const bool empty =
        d.nlp != nullptr && d.nlp->num_constraints == 0 && (d.nlp->provides & SY_OBJECTIVE) == 0;
    if (empty) d.nlp = nullptr;
  });
}

void Solver::WarmStart(const sy_start& start) {
  start_.clear();
  if (start.x != nullptr) start_.assign(start.x, start.x + problem_.view().num_vars);
  start_is_new_ = true;
}

// A start given since the last solve replaces what that solve left.
void Solver::Solve(const sy_control& control, sy_result& result) {
  Watch watch(control);
  linear::Clear(result);
  nlopt_srand(static_cast<unsigned long>(control.seed));
  const bool proceed = (control.flags & SY_CONTINUE) != 0 && !start_is_new_ && !last_.empty();
  start_is_new_ = false;
  if (watch.Stopped(0)) {
    result.termination = watch.reason();
    linear::Say(result, "stopped before the first evaluation");
  } else {
    Search search(problem_.view(), options_, host_, watch);
    const Found found = search.Go(proceed ? last_ : start_);
    result.iterations = search.evaluations();
    Report(found, result);
    last_ = found.point.x;
  }
  result.seconds = watch.Seconds();
}

void Solver::Report(const Found& found, sy_result& result) const {
  const sy_problem& p = problem_.view();
  result.termination = found.termination;
  linear::Say(result, found.words);
  if (found.termination == SY_UNBOUNDED) {
    result.primal = SY_CERTIFICATE;
    result.objective = result.bound = -kInfinity;
    linear::Put(result.x, *found.ray);
  } else if (found.termination == SY_INFEASIBLE) {
    result.bound = kInfinity;
    if (found.farkas) linear::Put(result, *found.farkas, SY_CERTIFICATE);
    if (found.farkas && result.nlp_dual != nullptr) {
      std::fill_n(result.nlp_dual, p.nlp != nullptr ? p.nlp->num_constraints : 0, 0.0);
    }
  } else {
    ReportPoint(found, result);
  }
}

void Solver::ReportPoint(const Found& found, sy_result& result) const {
  const Measured& point = found.point;
  if (!point.known) return;
  result.primal = found.feasible               ? SY_FEASIBLE
                  : point.violation <= kNearly ? SY_NEARLY_FEASIBLE
                                               : SY_INFEASIBLE_POINT;
  result.objective = point.objective;
  linear::Put(result.x, point.x);
  if (found.termination == SY_OPTIMAL) result.bound = point.objective;
  if (!point.multipliers) return;

  const sy_problem& p = problem_.view();
  const std::vector<double>& all = point.multipliers->constraint;
  const auto rows = all.begin() + p.num_rows;
  linear::Put(result, {point.multipliers->bound, {all.begin(), rows}},
              found.stationary ? SY_FEASIBLE : SY_INFEASIBLE_POINT);
  if (result.nlp_dual != nullptr) std::copy(rows, all.end(), result.nlp_dual);
  if (found.termination == SY_OPTIMAL || p.nlp != nullptr || !IsConvex(p)) return;
  result.bound = linear::DualObjective(
      p, point.x.data(), {point.multipliers->bound, {all.begin(), rows}}, linear::kRayNoise);
}

sy_solver Solver::Describe() {
  static const std::string version = [] {
    int major = 0;
    int minor = 0;
    int bugfix = 0;
    nlopt_version(&major, &minor, &bugfix);
    return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(bugfix);
  }();
  sy_solver t = {};
  t.id = "org.nlopt.nlopt";
  t.name = "nlopt";
  t.version = version.c_str();
  t.license = "MIT AND BSD-3-Clause AND LGPL-2.1-or-later";
  t.accepts = SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS | SY_ACCEPTS_QUADRATIC_OBJECTIVE |
              SY_ACCEPTS_NONCONVEX_OBJECTIVE | SY_ACCEPTS_NLP;
  // Its random numbers come from one place. Certificates are given where they are found, which
  // takes a dense program: that is no promise.
  t.traits = SY_GIVES_DUALS | SY_ONE_AT_A_TIME;
  t.honors = SY_HONORS_THREADS | SY_HONORS_SECONDS | SY_HONORS_ITERATIONS | SY_HONORS_TARGET |
             SY_HONORS_FEASIBILITY | SY_HONORS_OPTIMALITY | SY_HONORS_SEED | SY_HONORS_VERBOSITY |
             SY_HONORS_CANCELLED;
  t.updates = SY_UPDATES_BOUNDS | SY_UPDATES_VECTORS | SY_UPDATES_VALUES | SY_UPDATES_NLP;
  t.options = OptionTable();
  return t;
}

}  // namespace switchyard::nlopt

SY_PLUGIN("nlopt", "1.0", switchyard::nlopt::Solver)
