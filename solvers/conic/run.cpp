#include "solvers/conic/run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "switchyard/problem_update.hpp"
#include "switchyard/safe_bound.hpp"

namespace switchyard::conic {
namespace {

using presolve::Answer;
using presolve::Meaning;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kDefaultTolerance = 1e-8;

/// The tolerance of all residuals and of the gap; where only one is given, it is that one.
double ToleranceOf(const sy_control& control) {
  if (std::isnan(control.feasibility) && std::isnan(control.optimality)) return kDefaultTolerance;
  return std::fmin(control.feasibility, control.optimality);
}

std::string Formatted(const char* format, auto... values) {
  char text[400];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

/// The largest multiplier.
double Largest(const Answer& a) {
  double largest = 0;
  for (const auto* duals : {&a.x_dual, &a.row_dual, &a.cone_dual}) {
    for (const double d : *duals) largest = std::max(largest, std::abs(d));
  }
  return largest;
}

/// sum side(x_dual) + sum side(row_dual) - g'cone_dual; duals against infinite sides count as 0.
double Worth(const ProblemData& p, const Answer& a) {
  double worth = 0;
  const auto add = [&](double d, double lower, double upper) {
    const double side = d > 0 ? lower : upper;
    if (d != 0 && std::isfinite(side)) worth += d * side;
  };
  for (std::size_t j = 0; j < a.x_dual.size() && !p.x_lower.empty(); ++j) {
    add(a.x_dual[j], p.x_lower[j], p.x_upper[j]);
  }
  for (std::size_t i = 0; i < a.row_dual.size(); ++i) {
    add(a.row_dual[i], p.row_lower[i], p.row_upper[i]);
  }
  for (std::size_t i = 0; i < a.cone_dual.size(); ++i) worth -= p.g[i] * a.cone_dual[i];
  return worth;
}

/// Duals of bounds that stand against an infinite side are what is left of stationarity: none.
void DropOpenDuals(const ProblemData& p, Answer& a) {
  for (std::size_t j = 0; j < a.x_dual.size(); ++j) {
    const double lower = p.x_lower.empty() ? -kInfinity : p.x_lower[j];
    const double upper = p.x_upper.empty() ? kInfinity : p.x_upper[j];
    if (std::isinf(a.x_dual[j] > 0 ? lower : upper)) a.x_dual[j] = 0;
  }
}

/// What is proven of boxes must not rest on a cone that is not there.
Problem WithoutConesThatAreOff(ProblemData p) {
  if (!p.cone_on.empty()) problem_detail::KeepCones(std::vector<std::uint8_t>(p.cone_on), p);
  p.cone_on.clear();
  return Problem(std::move(p));
}

}  // namespace

Run::Run(const Problem& problem, Prepared& prepared, const Options& options, const sy_host& host,
         const sy_control& control)
    : problem_(problem),
      prepared_(prepared),
      options_(options),
      host_(host),
      control_(control),
      begin_(std::chrono::steady_clock::now()),
      tolerance_(ToleranceOf(control)) {}

double Run::Seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

void Run::Solve(const Iterate* from) {
  if (control_.seconds <= 0) {
    termination_ = SY_TIME_LIMIT;
    return;
  }
  InteriorPointOptions options;
  options.tolerance = tolerance_;
  options.threads = control_.threads;
  options.recentering = options_.corrections;
  options.iteration_limit = static_cast<int>(std::min<std::int64_t>(
      options_.max_iterations, std::max<std::int64_t>(control_.iterations, 0)));
  InteriorPoint method(
      prepared_.form(), prepared_.kkt(), options,
      [this](int k, const Iterate& at, const Distance& d) { return Watch(k, at, d); },
      [this](Ending ending, const Iterate& at) { return Judge(ending, at); });
  Solution found = method.Solve(from);
  iterations_ = found.iterations;
  Conclude(std::move(found));
  Describe();
}

/// True: stop.
bool Run::Watch(int iteration, const Iterate& at, const Distance& distance) {
  Log(iteration, at, distance);
  if (control_.cancelled != nullptr && control_.cancelled(control_.context) != 0) {
    stopped_ = SY_CANCELLED;
  } else if (Tell(iteration, distance)) {
    stopped_ = SY_CANCELLED;
  } else if (Seconds() >= control_.seconds) {
    stopped_ = SY_TIME_LIMIT;
  } else if (ProvesCutoff(at, distance)) {
    stopped_ = SY_CUTOFF;
  }
  return stopped_.has_value();
}

bool Run::Tell(int iteration, const Distance& distance) const {
  if (control_.progress == nullptr) return false;
  sy_progress told{};
  told.size = sizeof told;
  told.iteration = iteration;
  told.seconds = Seconds();
  told.objective = distance.primal_objective + prepared_.form().offset;
  told.bound = -kInfinity;
  told.primal_residual = distance.primal;
  told.dual_residual = distance.dual;
  return control_.progress(control_.context, &told) != 0;
}

void Run::Log(int iteration, const Iterate& at, const Distance& d) const {
  if (control_.verbosity <= 0 || host_.log == nullptr) return;
  if (iteration == 0) {
    host_.log(host_.context, SY_LOG_INFO,
              "iteration  primal objective    dual objective   primal     dual      gap      tau "
              "   kappa");
  }
  const double offset = prepared_.form().offset;
  host_.log(
      host_.context, SY_LOG_INFO,
      Formatted("%9d %17.9e %17.9e %8.1e %8.1e %8.1e %8.1e %8.1e%s", iteration,
                d.primal_objective + offset, d.dual_objective + offset, d.primal, d.dual_terms,
                d.gap, at.tau, at.kappa, prepared_.kkt().twofold() ? "  twofold digits" : "")
          .c_str());
}

/// The dual objective of an iterate only says when to look: what is compared is the safe bound,
/// over boxes that hold all that is below the cutoff.
bool Run::ProvesCutoff(const Iterate& at, const Distance& distance) {
  if (!(control_.cutoff < kInfinity) || at.tau <= at.kappa) return false;
  if (distance.dual_objective + prepared_.form().offset < control_.cutoff) return false;
  if (!below_) {
    below_ = {ProvenBoxes(WithoutConesThatAreOff(problem_.data()).view(), control_.cutoff),
              Curvature(problem_.view())};
  }
  const Boxes& boxes = below_->boxes;
  if (boxes.infeasible) {
    proven_ = control_.cutoff;
  } else {  // the duals of cones that are off are 0
    const Answer answer = prepared_.Back(at, Meaning::kOptimum);
    const SafeBound safe =
        SafeDualBound(problem_.view(), answer.x.data(), answer.row_dual.data(),
                      answer.cone_dual.data(), boxes.lower.data(), boxes.upper.data(),
                      below_->curvature.empty() ? nullptr : below_->curvature.data());
    proven_ = std::max(proven_, std::min(safe.value, control_.cutoff));
  }
  return proven_ >= control_.cutoff;
}

/// Is it one in the problem as it was given?
bool Run::Judge(Ending ending, const Iterate& at) {
  if (ending == Ending::kOptimal) return JudgePoint(at);
  const bool infeasible = ending == Ending::kInfeasible;
  Answer answer = prepared_.Back(at, infeasible ? Meaning::kContradiction : Meaning::kRay);
  if (infeasible) {
    CloseStationarity(problem_.data(), answer);
    DropOpenDuals(problem_.data(), answer);
  }
  const bool holds =
      infeasible ? IsContradiction(problem_.data(), answer) : IsRay(problem_.data(), answer);
  if (!holds) return false;
  answer_ = std::move(answer);
  has_answer_ = true;
  return true;
}

// The best one so far is kept.
bool Run::JudgePoint(const Iterate& at) {
  Answer answer = prepared_.Back(at, Meaning::kOptimum);
  const AnswerErrors errors = ErrorsOf(problem_.data(), answer);
  if (!has_answer_ || errors.Worst() < errors_.Worst()) {
    answer_ = std::move(answer);
    errors_ = errors;
    has_answer_ = true;
  }
  return errors.Worst() <= tolerance_;
}

void Run::Conclude(Solution found) {
  switch (found.ending) {
    case Ending::kOptimal:
      ConcludeOptimal(std::move(found.at));
      return;
    case Ending::kInfeasible:
      termination_ = SY_INFEASIBLE;
      ScaleToWorth();
      return;
    case Ending::kUnbounded:
      termination_ = SY_UNBOUNDED;
      return;
    case Ending::kIterationLimit:
      termination_ = SY_ITERATION_LIMIT;
      break;
    case Ending::kStopped:
      termination_ = *stopped_;
      break;
    default:
      termination_ = SY_NUMERICAL_TROUBLE;
  }
  answer_ = Answer();
  has_answer_ = false;
  if (JudgePoint(found.at) && found.ending == Ending::kTrouble) {
    ConcludeOptimal(std::move(found.at));
    return;
  }
  CloseStationarity(problem_.data(), answer_);
  const SafeBound safe = SafeDualBound(problem_.view(), answer_.x.data(), answer_.row_dual.data(),
                                       answer_.cone_dual.data(), nullptr, nullptr);
  proven_ = std::max(proven_, safe.value);
}

// Stopped at a loose tolerance, the duals are to leave a bound: what they leave of stationarity is
// that of bounds.
void Run::ConcludeOptimal(Iterate at) {
  termination_ = SY_OPTIMAL;
  proven_ = std::max(proven_, std::min(errors_.objective, errors_.dual_objective));
  optimum_ = std::move(at);
  if (tolerance_ > kDefaultTolerance) CloseStationarity(problem_.data(), answer_);
}

/// A contradiction is worth 1, if it is worth anything but for rounding.
void Run::ScaleToWorth() {
  const double worth = Worth(problem_.data(), answer_);
  const double unit = 1 / (worth > 0 ? worth : Largest(answer_));
  for (auto* duals : {&answer_.x_dual, &answer_.row_dual, &answer_.cone_dual}) {
    for (double& d : *duals) d *= unit;
  }
}

void Run::Describe() {
  const presolve::Presolve& p = prepared_.presolve();
  const ProblemData& whole = problem_.data();
  const ProblemData& reduced = p.reduced();
  text_ = Formatted("presolved from %d variables and %d rows to %d and %d", whole.num_vars,
                    whole.num_rows() + whole.num_cone_rows(), reduced.num_vars,
                    reduced.num_rows() + reduced.num_cone_rows());
  if (prepared_.kkt().twofold()) text_ += "; the last steps with twofold digits";
  if (termination_ == SY_OPTIMAL || termination_ == SY_INFEASIBLE || termination_ == SY_UNBOUNDED ||
      termination_ == SY_CUTOFF) {
    return;
  }
  text_ += Formatted("; residuals: primal %.1e, dual %.1e, gap %.1e", errors_.primal, errors_.dual,
                     errors_.gap);
}

sy_point_kind Run::KindOf(double error) const {
  constexpr double kNearly = 1e-3;
  if (error <= tolerance_) return SY_FEASIBLE;
  return error <= kNearly ? SY_NEARLY_FEASIBLE : SY_INFEASIBLE_POINT;
}

void Run::Write(sy_result& result) const {
  const auto put = [](const std::vector<double>& from, double* to) {
    if (to != nullptr) std::copy(from.begin(), from.end(), to);
  };
  result.termination = termination_;
  result.primal = result.dual = SY_NO_POINT;
  result.objective = result.relaxed = kNaN;
  result.bound = proven_;
  result.seconds = Seconds();
  result.iterations = iterations_;
  result.nodes = 0;
  if (result.text != nullptr && result.text_size > 0) {
    std::snprintf(result.text, result.text_size, "%s", text_.c_str());
  }
  if (!has_answer_) return;
  if (termination_ != SY_INFEASIBLE) {
    const bool ray = termination_ == SY_UNBOUNDED;
    result.primal = ray ? SY_CERTIFICATE : KindOf(errors_.primal);
    if (!ray) result.objective = errors_.objective;
    put(answer_.x, result.x);
  }
  if (termination_ != SY_UNBOUNDED) {
    result.dual = termination_ == SY_INFEASIBLE ? SY_CERTIFICATE : KindOf(errors_.dual);
    put(answer_.x_dual, result.x_dual);
    put(answer_.row_dual, result.row_dual);
    put(answer_.cone_dual, result.cone_dual);
  }
}

}  // namespace switchyard::conic
