#include "search.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "linear/answer.hpp"
#include "plan.hpp"
#include "proofs.hpp"
#include "start.hpp"

namespace switchyard::nlopt {
namespace {

constexpr double kFeasible = 1e-7;
constexpr double kStationary = 1e-6;
// The gradient of the violation where no step makes it smaller.
constexpr double kStuck = 1e-5;
// What a search without derivatives may still gain from a point where it has converged.
constexpr double kSettled = 1e-7;
constexpr int kSettlings = 6;
// The part of a violation that a run must take away to be followed by another.
constexpr double kHalf = 0.5;
// An objective below this may have been stopped in its fall by rounding errors alone.
constexpr double kDeep = -1e12;

constexpr const char* kEnded = "a function ended the solve";

double Asked(double wish, double otherwise) { return std::isnan(wish) ? otherwise : wish; }

template <class... Parts>
std::string Text(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

}  // namespace

Search::Search(const sy_problem& problem, const Options& options, const sy_host& host,
               linear::Watch& watch)
    : problem_(problem),
      options_(options),
      host_(host),
      watch_(watch),
      stop_([&watch] { return watch.Stopped(); }),
      functions_(problem),
      judge_(functions_, Asked(watch.control().feasibility, kFeasible),
             Asked(watch.control().optimality, kStationary), stop_),
      program_(functions_, watch, judge_.feasible()) {}

Found Search::Go(const std::vector<double>& x) {
  const bool fixed = program_.moving().empty();
  const Order first = fixed ? Order() : FirstOrder(options_, program_);
  const bool defined = MoveToStart(x, functions_);
  found_.point.x = start_ = functions_.x();
  if (functions_.aborted()) {
    Ends(SY_EVALUATION_FAILED, kEnded);
  } else if (!defined && !AnyIs(first.nest, kGlobal)) {
    Ends(SY_EVALUATION_FAILED, "the functions are not defined where the solve starts");
  } else {
    if (defined) Keep(found_.point.x);
    const bool broken = defined && BreaksConstants();
    if (!broken && fixed) {
      found_.stationary = Ends(SY_OPTIMAL, "no variable that is not fixed");
    } else if (!broken && functions_.has_gradients()) {
      const bool given = std::any_of(x.begin(), x.end(), [](double v) { return !std::isnan(v); });
      GoByGradients(first, given);
    } else if (!broken) {
      GoWithoutGradients(first);
    }
  }
  if (found_.termination == SY_NOT_SOLVED) EndUnsolved();
  found_.feasible = IsFeasible();
  return std::move(found_);
}

void Search::GoByGradients(const Order& first, bool given) {
  const bool local = !AnyIs(first.nest, kGlobal);
  const bool stationary = judge_.IsStationary(found_.point);
  if (stationary && local && (given || IsConvex())) {
    Solved();
    return;
  }
  // 0 is often a saddle point or a maximum, where no gradient leads away: a run that ends elsewhere
  // is to be preferred.
  found_.point.multipliers.reset();
  if (!Step(first, stationary ? Aside(found_.point.x) : found_.point.x) || Solved()) return;
  limited_ = ended_.result == NLOPT_MAXEVAL_REACHED;
  if (limited_ && local) return;
  const std::vector<Order> later = LaterOrders(options_, first, program_);
  for (const Order& order : later) {
    if (!IsFeasible() && !Regain()) return;
    if (!Step(order) || Solved()) return;
  }
  if (IsFeasible()) return;
  later.empty() ? HasNoFeasiblePoint() : Regain();
}

void Search::GoWithoutGradients(const Order& first) {
  if (!Step(first)) return;
  limited_ = ended_.result == NLOPT_MAXEVAL_REACHED;
  if (limited_ && (!AnyIs(first.nest, kGlobal) || options_.Integer("polish") == 0)) return;
  for (int k = 0; k < kSettlings; ++k) {
    const Measured before = found_.point;
    const bool held = judge_.IsFeasible(before);
    if (!held && HasNoFeasiblePoint()) return;
    if (!Step(AgainOrder(options_, first, !Converged(), before.x, program_))) return;
    if (!IsFeasible()) {
      if (found_.point.violation > kHalf * before.violation) return;
    } else if (held && Converged() &&
               before.objective - found_.point.objective <=
                   kSettled * (1 + std::abs(before.objective))) {
      Ends(SY_LOCALLY_OPTIMAL, "it has converged, and there are no derivatives to check it by");
      return;
    }
  }
}

/// Did the last run find no way on?
bool Search::Converged() const { return ended_.converged() || program_.halt() == Halt::kStands; }

/// A constraint of fixed variables alone is what it is.
bool Search::BreaksConstants() {
  const std::int32_t i = program_.BrokenConstant();
  if (i < 0) return false;
  const bool row = i < problem_.num_rows;
  return (row && HasNoFeasiblePoint()) ||
         Ends(SY_INFEASIBLE, Text(row ? "row[" : "c[", row ? i : i - problem_.num_rows,
                                  "] is constant, and outside of its sides"));
}

// ---- One step ------------------------------------------------------------------------------

/// One run from the point, and to a better one. False where the search is over.
bool Search::Step(const Order& order, const std::vector<double>& from) {
  if (functions_.MoveTo(from.data())) program_.Scale();
  const std::int64_t before = program_.evaluations();
  constexpr double kTenth = 0.1;
  const double asked = watch_.control().feasibility;
  const double tolerance = options_.Has("constraint_tol") || std::isnan(asked)
                               ? options_.Real("constraint_tol")
                               : std::min(kTenth * asked, options_.Real("constraint_tol"));
  ended_ = Run(order, options_, tolerance, from, watch_, program_);
  runs_ += Text(runs_.empty() ? "" : ", ", NameOf(order), ": ", Words());
  if (!Halted()) {
    Keep(ended_.x);
    if (!judge_.IsStationary(found_.point)) Keep(program_.last());
    const bool polished = options_.Integer("polish") != 0;
    if (polished || AnyIs(order.nest, kGradients)) judge_.Refine(found_.point);
    if (watch_.reason() != SY_NOT_SOLVED) Halted();
  }
  Log(Text("NLopt ", NameOf(order), ": ", Words(), " after ", program_.evaluations() - before,
           " evaluations, objective ", found_.point.objective, ", violation ",
           found_.point.violation));
  return found_.termination == SY_NOT_SOLVED;
}

/// How the last run ended.
const char* Search::Words() const {
  const Halt why = program_.halt();
  return why == Halt::kStands  ? "stood still"
         : why == Halt::kIdles ? "gained nothing"
                               : nlopt_result_to_string(ended_.result);
}

void Search::Log(const std::string& line) const {
  if (watch_.control().verbosity > 0 && host_.log != nullptr) {
    host_.log(host_.context, SY_LOG_INFO, line.c_str());
  }
}

/// Was the run stopped from outside, or by what its points showed? Then the best of all is the
/// point, and what is known of it must do: the functions are not to be called again.
bool Search::Halted() {
  if (ended_.result == NLOPT_MAXTIME_REACHED) watch_.Stop(SY_TIME_LIMIT);
  const Halt why = program_.halt();
  const bool stopped = watch_.reason() != SY_NOT_SOLVED;
  if (!stopped && why != Halt::kAborted && why != Halt::kFalls) return false;
  const Visited& best = program_.best();
  if (!best.x.empty()) found_.point = {true, best.x, best.objective, best.violation, std::nullopt};
  if (why == Halt::kAborted) return Ends(SY_EVALUATION_FAILED, kEnded);
  if (stopped) return Ends(watch_.reason());
  return HasNoFeasiblePoint() || HasRay() ||
         Ends(SY_NUMERICAL_TROUBLE, "the objective falls without end");
}

bool Search::Solved() {
  if (!judge_.IsStationary(found_.point)) return false;
  if (found_.point.objective < kDeep && HasRay()) return true;
  found_.stationary = true;
  return Ends(IsConvex() ? SY_OPTIMAL : SY_LOCALLY_OPTIMAL);
}

/// Seeks a feasible point, whatever its objective: from the point, and a little beside where that
/// leads, lest the violation be stationary for being largest there. False where there is none, here
/// or anywhere.
bool Search::Regain() {
  if (HasNoFeasiblePoint()) return false;
  std::vector<double> from = found_.point.x;
  for (int k = 0; k < 2; ++k) {
    if (!Step(FeasibilityOrder(program_), from)) return false;
    if (IsFeasible() || !ViolationIsStationary(ended_.x)) return true;
    from = Aside(ended_.x);
  }
  found_.point = {true, ended_.x, functions_.objective(), functions_.Violation(), std::nullopt};
  Ends(SY_LOCALLY_INFEASIBLE,
       Text("the violation ", found_.point.violation, " is the least one around"));
  return false;
}

/// Do rows and bounds alone contradict each other? Asked once, and from where the search began: it
/// may have gone too far away to tell.
bool Search::HasNoFeasiblePoint() {
  if (std::exchange(sought_proof_, true)) return false;
  found_.farkas = SeekFarkas(problem_, start_, stop_);
  return found_.farkas.has_value() && Ends(SY_INFEASIBLE, "rows and bounds contradict each other");
}

/// Of a program that has a feasible point: is there a way down without end?
bool Search::HasRay() {
  found_.ray = SeekRay(problem_, stop_);
  return found_.ray.has_value() && Ends(SY_UNBOUNDED, "the objective falls along a ray");
}

bool Search::ViolationIsStationary(const std::vector<double>& x) {
  if (!functions_.MoveTo(x.data()) || !functions_.Differentiate()) return false;
  return program_.SlopeOfViolation() <= kStuck;
}

// ---- Points --------------------------------------------------------------------------------

bool Search::IsConvex() const {
  return (problem_.flags & SY_PROBLEM_CONVEX) != 0 ||
         (problem_.P == nullptr && problem_.nlp == nullptr);
}

/// A little away from x, by another step in each variable.
std::vector<double> Search::Aside(std::vector<double> x) const {
  constexpr double kAside = 1e-2;
  for (std::size_t j = 0; j < x.size(); ++j) {
    const double step = kAside * (1 + std::abs(x[j])) / (1 + 0.1 * static_cast<double>(j % 7));
    const double aside = x[j] + step <= problem_.x_upper[j] ? x[j] + step : x[j] - step;
    x[j] = std::max(aside, problem_.x_lower[j]);
  }
  return x;
}

// ---- The end -------------------------------------------------------------------------------

bool Search::Ends(sy_termination termination, const std::string& words) {
  found_.termination = termination;
  found_.words = words + (words.empty() || runs_.empty() ? "" : "; ") + runs_;
  return true;
}

void Search::EndUnsolved() {
  const bool feasible = IsFeasible();
  if (feasible && !limited_ && (HasNoFeasiblePoint() || HasRay())) return;
  if (watch_.Stopped()) {
    Ends(watch_.reason());
    return;
  }
  std::string words;
  if (!feasible) {
    words = Text("no feasible point was found; the violation is ", found_.point.violation);
  } else if (const auto& m = found_.point.multipliers) {
    words = Text("not stationary: the residual is ", m->residual, ", the gap ", m->gap);
  } else if (functions_.has_gradients()) {
    words = "too large to be checked";
  }
  if (functions_.aborted()) {
    Ends(SY_EVALUATION_FAILED, kEnded);
  } else if (!found_.point.known) {
    Ends(SY_EVALUATION_FAILED, "the functions are defined nowhere");
  } else if (limited_) {
    Ends(SY_ITERATION_LIMIT, words);
  } else if (program_.undefined() > 0) {
    Ends(SY_EVALUATION_FAILED, "the functions are not defined where the steps lead; " + words);
  } else {
    Ends(SY_NUMERICAL_TROUBLE, words);
  }
}

}  // namespace switchyard::nlopt
