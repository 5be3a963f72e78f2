#include "solvers/conic/interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solvers/linalg/vector.hpp"

namespace switchyard::conic {

using linalg::AddMultiple;
using linalg::Dot;

namespace {

// Entries of A and L. Below, threads are longer on their way to a loop than the loop takes.
constexpr double kWorthSharing = 1.5e5;

int ThreadsFor(const Form& form, const Kkt& kkt, int threads) {
  const double entries = form.A.nonzeros() + kkt.factors().factor_size();
  return entries >= kWorthSharing ? threads : 1;
}

}  // namespace

InteriorPoint::InteriorPoint(const Form& form, Kkt& kkt, const InteriorPointOptions& options,
                             Watch watch, Judge judge)
    : form_(form),
      kkt_(kkt),
      workers_(ThreadsFor(form, kkt, options.threads)),
      cones_(form, &workers_),
      options_(options),
      watch_(std::move(watch)),
      judge_(std::move(judge)),
      residuals_(form, &workers_),
      right_(form.shape) {
  const Shape& s = form.shape;
  for (Direction* d : {&constant_, &predictor_, &corrector_, &recentered_}) {
    d->d = KktStep(s);
    d->ds.resize(s.slacks());
  }
  xi_.resize(s.slacks());
  p_x_.resize(s.vars);
  h_z_.resize(s.slacks());
}

Solution InteriorPoint::Solve(const Iterate* from) {
  kkt_.Restart();
  Start();
  if (from != nullptr) BlendIn(*from);
  for (int k = 0;; ++k) {
    residuals_.Compute(at_);
    mu_ = (Dot(at_.s, at_.z) + at_.tau * at_.kappa) / (cones_.degree() + 1);
    if (const auto ending = Finished(k)) return Conclude(*ending, k);
    if (!FindDirection()) return Conclude(Ending::kTrouble, k);
    Advance();
  }
}

// With H = 1: for a quadratic objective the minimizer of 1/2 x'Px + q'x + 1/2 |G x - h|^2, whose
// residual serves as both s and -z; else the least-norm s and the least-norm z. Then both are moved
// inside.
void InteriorPoint::Start() {
  const Shape& s = form_.shape;
  at_ = {Vector(s.vars), Vector(s.equations), Vector(s.slacks()), Vector(s.slacks()), 1, 1};
  if (!cones_.symmetric()) {
    cones_.Center(at_.s);
    cones_.Center(at_.z);
    return;
  }
  cones_.ScaleByIdentity();
  kkt_.Factor(cones_);
  KktStep found(s);
  const auto solve = [&](bool costs, bool sides) {
    for (Index j = 0; j < s.vars; ++j) right_.x[j] = costs ? -form_.q[j] : 0;
    for (Index i = 0; i < s.equations; ++i) {
      right_.y[i] = sides ? form_.b[s.conic_rows() + i] : 0;
    }
    right_.z = sides ? residuals_.h : Vector(s.slacks());
    kkt_.Solve(cones_, right_, {1e-8, 1e-8}, found);
  };
  const bool quadratic = form_.P.pattern.nonzeros() > 0;
  solve(quadratic, true);
  at_.x = found.x;
  for (Index i = 0; i < s.slacks(); ++i) at_.s[i] = -found.z[i];
  if (!quadratic) solve(true, false);
  at_.y = found.y;
  at_.z = found.z;
  Shift(at_.s);
  Shift(at_.z);
}

// What is near the old solution is near the boundary, and far from the path; what is between it and
// where one would start otherwise is near enough to both (Skajaa, Andersen and Ye, Math.
// Programming Comput. 5, 2013).
void InteriorPoint::BlendIn(const Iterate& from) {
  constexpr double kOld = 0.98;
  const auto blend = [&](const Vector& old, Vector& v) {
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = kOld * old[i] / from.tau + (1 - kOld) * v[i];
  };
  blend(from.x, at_.x);
  blend(from.y, at_.y);
  blend(from.z, at_.z);
  blend(from.s, at_.s);
  at_.kappa *= 1 - kOld;
}

void InteriorPoint::Shift(Vector& v) const {
  constexpr double kInside = 1e-3;
  const double depth = cones_.Depth(v);
  if (depth > kInside || v.empty()) return;
  Vector center(v.size());
  cones_.Center(center);
  AddMultiple(1 - depth, center, v);
}

std::optional<Ending> InteriorPoint::Finished(int iteration) {
  // Iterations without a better one: where rounding may be the reason, and where it is not; and
  // those that the judge did not take.
  constexpr int kFew = 3, kPatience = 30, kRejected = 10;
  const bool stop = watch_ && watch_(iteration, at_, residuals_.distance);
  KeepBest(iteration);
  if (const auto ending = Arrived()) {
    if (!judge_ || judge_(*ending, at_)) return ending;
    if (++rejected_ > kRejected) return Ending::kTrouble;
  }
  if (stop) return Ending::kStopped;
  if (iteration >= options_.iteration_limit) return Ending::kIterationLimit;
  const bool by_terms = best_distance_.WorstByTerms() <= options_.tolerance;
  if (iteration > best_iteration_ + (by_terms ? kFew : kPatience)) return Ending::kTrouble;
  return std::nullopt;
}

/// Where the iterate seems to have come to.
std::optional<Ending> InteriorPoint::Arrived() {
  const Distance& d = residuals_.distance;
  if (d.Worst() <= options_.tolerance) return Ending::kOptimal;
  if (left_ > 1 && d.WorstByTerms() <= options_.tolerance) return Ending::kOptimal;
  if (at_.tau < at_.kappa) {
    if (d.infeasible <= options_.tolerance) return Ending::kInfeasible;
    if (d.unbounded <= options_.tolerance) return Ending::kUnbounded;
  }
  return std::nullopt;
}

// An iterate that would do is better than one that would not.
void InteriorPoint::KeepBest(int iteration) {
  const Distance& d = residuals_.distance;
  const double worst = d.Worst() * d.WorstByTerms();
  const bool does = d.WorstByTerms() <= options_.tolerance;
  const bool did = best_distance_.WorstByTerms() <= options_.tolerance;
  if (best_iteration_ >= 0 && (does == did ? !(worst < 0.9 * best_worst_) : did)) return;
  best_ = at_;
  best_distance_ = d;
  best_worst_ = worst;
  best_iteration_ = iteration;
}

Solution InteriorPoint::Conclude(Ending ending, int iteration) {
  const bool arrived =
      ending == Ending::kOptimal || ending == Ending::kInfeasible || ending == Ending::kUnbounded;
  if (arrived) return {ending, at_, residuals_.distance, iteration};
  const bool would_do = best_distance_.WorstByTerms() <= options_.tolerance;
  if (would_do && (!judge_ || judge_(Ending::kOptimal, best_))) ending = Ending::kOptimal;
  return {ending, best_, best_distance_, iteration};
}

}  // namespace switchyard::conic
