// The direction of an iteration: its equations, and what becomes of them.
#include <algorithm>
#include <cmath>
#include <utility>

#include "solvers/conic/interior_point.hpp"
#include "solvers/conic/slacks.hpp"
#include "solvers/linalg/vector.hpp"

namespace switchyard::conic {

using linalg::AddMultiple;
using linalg::Dot;

// In units of what may be left of the equations: a solve that leaves more has lost the direction.
constexpr double kLost = 30;
constexpr double kHopeless = 1e6;  // leads nowhere

bool InteriorPoint::FindDirection() {
  if (!cones_.Scale(at_.s, at_.z, mu_)) return false;
  const double r = kkt_.proximal();
  double best = TryDirection(r, false);
  if (best <= kLost) {
    PrepareNext();
    return true;
  }
  if (TryDirection(r, true) <= kLost) return true;
  if (!kkt_.twofold()) {
    kkt_.TakeMoreDigits();
    return FindDirection();
  }
  double best_proximal = r;
  const bool slow = contraction_ < 1 && kkt_.raised_pivots() == 0;
  for (const double factor : {slow ? 1.0 / 30 : 30.0, slow ? 30.0 : 1.0 / 30, 1000.0}) {
    kkt_.set_proximal(r * factor);
    if (kkt_.proximal() == r) continue;
    const double left = TryDirection(r * factor, false);
    if (left <= kLost) return true;
    if (left < best) {
      best = left;
      best_proximal = kkt_.proximal();
    }
  }
  kkt_.set_proximal(best_proximal);
  return TryDirection(best_proximal, false) <= kHopeless;
}

/// Slow corrections: less of a proximal term has less to correct, and more digits next to nothing.
void InteriorPoint::PrepareNext() {
  constexpr double kSlow = 0.03;
  if (corrections_ < 2 || contraction_ <= kSlow) return;
  if (!kkt_.twofold() && corrections_ > 2) {
    kkt_.TakeMoreDigits();
  } else {
    kkt_.set_proximal(kkt_.proximal() / 10);
  }
}

/// What the worst solve left; infinite where there is no direction.
double InteriorPoint::TryDirection(double proximal, bool whole) {
  whole_ = whole;
  kkt_.set_proximal(proximal);
  left_ = contraction_ = 0;
  corrections_ = 0;
  kkt_.Factor(cones_);
  return Predict() && Correct() ? left_ : kInfinity;
}

/// What may be left of a step's equations, as it adds to the residuals: a hundredth of these, or of
/// what they may be in the end.
Kkt::Goal InteriorPoint::StepGoal() const {
  constexpr double kShare = 0.01, kLeast = 1e-14;
  const auto share = [&](double residual, double distance) {
    if (!(distance > 0)) return kShare * options_.tolerance * std::max(at_.tau, at_.kappa);
    return std::max(kShare * residual * std::max(1.0, options_.tolerance / distance), kLeast);
  };
  return {share(residuals_.norm_dual, residuals_.distance.dual_terms),
          share(residuals_.norm_primal, residuals_.distance.primal_terms)};
}

// The constant's direction (for dtau = 1, nothing else changed) solves the step's equations to the
// right side (-q, b, h). What x / tau, y / tau, z / tau leave of that is small near the end, and
// then so are all terms of what is solved here: for the difference from these. And the affine
// direction, to the end.
bool InteriorPoint::Predict() {
  const Shape& s = form_.shape;
  const double each = 1 / at_.tau;
  for (Index j = 0; j < s.vars; ++j) right_.x[j] = -each * residuals_.r.x[j];
  for (Index i = 0; i < s.equations; ++i) right_.y[i] = -each * residuals_.r.y[i];
  cones_.Multiply(at_.z, h_z_);  // s, but for rounding
  for (Index i = 0; i < s.slacks(); ++i) {
    right_.z[i] = -each * (residuals_.r.z[i] + at_.s[i] + h_z_[i]);
  }
  KktStep& c = constant_.d;
  const Kkt::Outcome outcome = kkt_.Solve(cones_, right_, StepGoal(), c);
  constant_left_ = outcome.left;
  corrections_ = outcome.corrections;
  contraction_ = outcome.contraction;
  // With (x_1, y_1, z_1) the constant's, the fourth equation's coefficient of dtau:
  // kappa / tau + z_1'(h - G x_1) + (x_1 - x / tau)'P (x_1 - x / tau).
  curvature_ = at_.kappa / at_.tau;
  if (form_.P.pattern.nonzeros() > 0) {
    std::fill(p_x_.begin(), p_x_.end(), 0.0);
    AddProduct(form_.P, 1, c.x.data(), p_x_.data());
    curvature_ += Dot(c.x, p_x_);
  }
  EachSlack(s, c.x, c.a_x, [&](Index slack, double g_x) {
    c.z[slack] += each * at_.z[slack];
    curvature_ -= c.z[slack] * (g_x + each * (at_.s[slack] + residuals_.r.z[slack]));
  });
  AddMultiple(each, at_.x, c.x);
  AddMultiple(each, at_.y, c.y);
  AddMultiple(each, residuals_.a_x, c.a_x);
  if (constant_left_ > kLost) whole_ = true;
  if (whole_) PrepareWhole();
  xi_ = at_.s;
  return Solve(predictor_, 1, at_.tau * at_.kappa);
}

// A step of share 1 - sigma towards feasibility, with what the predictor shows of second order.
bool InteriorPoint::Correct() {
  // Where recentering follows, it brings back what a bold target leaves behind.
  constexpr double kBold = 0.1;
  const double reach = Step(predictor_, 1);
  const double sigma = (cones_.symmetric() ? kBold : 1) * std::pow(1 - reach, 3);
  const double target = sigma * mu_;
  cones_.Correct(at_.s, at_.z, predictor_.ds, predictor_.d.z, target, xi_);
  double tau_kappa = at_.tau * at_.kappa + predictor_.tau * predictor_.kappa - target;
  if (!Solve(corrector_, 1 - sigma, tau_kappa)) return false;
  for (int k = 0; cones_.symmetric() && k < options_.recentering; ++k) {
    if (!Recenter(sigma, tau_kappa)) break;
  }
  return true;
}

/// A longer step, where what stands out at its end is brought back. False where it is none.
bool InteriorPoint::Recenter(double sigma, double& tau_kappa) {
  constexpr double kLongEnough = 0.9, kLonger = 0.3, kLow = 0.1, kHigh = 10, kGain = 1.01;
  const double step = Step(corrector_, 1);
  if (step > kLongEnough) return false;
  const double trial = std::min(1.0, step + kLonger);
  trial_s_ = at_.s;
  trial_z_ = at_.z;
  AddMultiple(trial, corrector_.ds, trial_s_);
  AddMultiple(trial, corrector_.d.z, trial_z_);
  const double target = std::max(sigma, 1e-3) * mu_;
  cones_.Recenter(trial_s_, trial_z_, at_.z, kLow * target, kHigh * target, xi_);
  const double pair = (at_.tau + trial * corrector_.tau) * (at_.kappa + trial * corrector_.kappa);
  tau_kappa -= cones::IntoRange(pair, kLow * target, kHigh * target);
  if (!Solve(recentered_, 1 - sigma, tau_kappa)) return false;
  if (Step(recentered_, 1) < kGain * step) return false;
  std::swap(corrector_, recentered_);
  return true;
}

/// The direction that takes `share` of the residuals away; xi_ says what becomes of s and z,
/// tau_kappa of tau and kappa: tau dkappa + kappa dtau = -tau_kappa.
bool InteriorPoint::Solve(Direction& direction, double share, double tau_kappa) {
  const Shape& s = form_.shape;
  const Residuals& r = residuals_;
  for (Index j = 0; j < s.vars; ++j) right_.x[j] = -share * r.r.x[j];
  for (Index i = 0; i < s.equations; ++i) right_.y[i] = -share * r.r.y[i];
  for (Index i = 0; i < s.slacks(); ++i) right_.z[i] = -share * r.r.z[i] - xi_[i];
  const KktStep& c = constant_.d;
  KktStep& d = direction.d;
  const double fourth = -share * r.tau - tau_kappa / at_.tau;
  Kkt::Outcome outcome;
  if (whole_) {
    outcome = SolveWhole(direction, fourth);
  } else {
    outcome = kkt_.Solve(cones_, right_, StepGoal(), d);
    direction.tau = (fourth - Fourth(d)) / curvature_;
    outcome.left += std::abs(direction.tau) * constant_left_;
  }
  AddMultiple(direction.tau, c.x, d.x);
  AddMultiple(direction.tau, c.y, d.y);
  AddMultiple(direction.tau, c.z, d.z);
  AddMultiple(direction.tau, c.a_x, d.a_x);
  direction.kappa = -(tau_kappa + at_.kappa * direction.tau) / at_.tau;
  cones_.Multiply(d.z, direction.ds);
  for (Index i = 0; i < s.slacks(); ++i) direction.ds[i] = -(xi_[i] + direction.ds[i]);
  if (s.cone_rows > 0) {
    for (Index i = 0; i < s.cone_rows; ++i) {
      h_z_[i] = d.a_x[i] - r.h[i] * direction.tau + share * r.r.z[i] - direction.ds[i];
    }
    cones_.Mend(h_z_, direction.ds);
  }
  left_ = std::max(left_, outcome.left);
  corrections_ = std::max(corrections_, outcome.corrections);
  contraction_ = std::max(contraction_, outcome.contraction);
  return std::isfinite(direction.tau) && std::isfinite(outcome.left);
}

/// What the fourth equation has of a step.
double InteriorPoint::Fourth(const KktStep& d) const {
  return -Dot(form_.q, d.x) - 2 / at_.tau * Dot(residuals_.p_x, d.x) +
         Dot(form_.b.data() + form_.shape.conic_rows(), d.y.data(), d.y.size()) +
         Dot(residuals_.h, d.z);
}

// Where equations contradict each other, or no point has a gradient of 0, the first three have no
// solution of their own for the constant: with the fourth they have, as that keeps dtau as small as
// it must be. So they are solved together, with the factors' answer to the constant as it is.
void InteriorPoint::PrepareWhole() {
  const Shape& s = form_.shape;
  if (more_.a_x.empty()) more_ = KktStep(s);
  for (Index j = 0; j < s.vars; ++j) right_.x[j] = -form_.q[j];
  std::copy_n(form_.b.begin() + s.conic_rows(), s.equations, right_.y.begin());
  right_.z = residuals_.h;
  kkt_.SolveOnce(cones_, right_, StepGoal(), constant_.d);
  constant_rest_ = kkt_.left();
  curvature_ =
      at_.kappa / at_.tau + residuals_.quadratic / (at_.tau * at_.tau) + Fourth(constant_.d);
}

/// To right_ and to `fourth`, by refinement.
Kkt::Outcome InteriorPoint::SolveWhole(Direction& direction, double fourth) {
  constexpr int kRounds = 20;
  constexpr double kStalled = 0.5;
  const Kkt::Goal goal = StepGoal();
  KktStep& d = direction.d;
  const auto add = [](double alpha, const Triple& from, Triple& to) {
    AddMultiple(alpha, from.x, to.x);
    AddMultiple(alpha, from.y, to.y);
    AddMultiple(alpha, from.z, to.z);
  };
  kkt_.SolveOnce(cones_, right_, goal, d);
  direction.tau = (fourth - Fourth(d)) / curvature_;
  Triple rest = kkt_.left();
  add(direction.tau, constant_rest_, rest);
  Kkt::Outcome outcome{kkt_.Measure(cones_, rest, goal), 0, 0};
  for (; outcome.left > 1 && outcome.corrections < kRounds; ++outcome.corrections) {
    kkt_.SolveOnce(cones_, rest, goal, more_);
    const double tau = -Fourth(more_) / curvature_;
    rest = kkt_.left();
    add(tau, constant_rest_, rest);
    const double left = kkt_.Measure(cones_, rest, goal);
    if (!(left < kStalled * outcome.left)) break;
    outcome.left = left;
    add(1, more_, d);
    AddMultiple(1, more_.a_x, d.a_x);
    direction.tau += tau;
  }
  return outcome;
}

double InteriorPoint::Step(const Direction& direction, double most) const {
  double step = most;
  if (direction.tau < 0) step = std::min(step, -at_.tau / direction.tau);
  if (direction.kappa < 0) step = std::min(step, -at_.kappa / direction.kappa);
  return cones_.Step(at_.s, at_.z, direction.ds, direction.d.z, step);
}

/// As far as the corrector's direction may be followed.
double InteriorPoint::LongStep() {
  double step = options_.step_fraction * Step(corrector_, 1 / options_.step_fraction);
  if (cones_.symmetric()) return step;
  constexpr double kBack = 0.8, kLeast = 1e-8;
  for (; step > kLeast; step *= kBack) {
    trial_s_ = at_.s;
    trial_z_ = at_.z;
    AddMultiple(step, corrector_.ds, trial_s_);
    AddMultiple(step, corrector_.d.z, trial_z_);
    const double tau_kappa =
        (at_.tau + step * corrector_.tau) * (at_.kappa + step * corrector_.kappa);
    const double mu = (Dot(trial_s_, trial_z_) + tau_kappa) / (cones_.degree() + 1);
    if (cones_.NearPath(trial_s_, trial_z_, mu)) break;
  }
  return step;
}

void InteriorPoint::Advance() {
  const double step = LongStep();
  AddMultiple(step, corrector_.d.x, at_.x);
  AddMultiple(step, corrector_.d.y, at_.y);
  AddMultiple(step, corrector_.d.z, at_.z);
  AddMultiple(step, corrector_.ds, at_.s);
  at_.tau += step * corrector_.tau;
  at_.kappa += step * corrector_.kappa;
}

}  // namespace switchyard::conic
