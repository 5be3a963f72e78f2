#include "program.hpp"

#include <algorithm>
#include <cmath>

namespace switchyard::nlopt {
namespace {

// An objective that falls below this falls without end.
constexpr double kBottom = -1e20;
// What a run that goes by gradients is told of a constraint outside the domain: worse than all.
constexpr double kOutside = 1e10;
// The largest entry of the objective's gradient after scaling.
constexpr double kSteep = 100;

}  // namespace

Program::Program(Functions& functions, linear::Watch& watch, double feasible)
    : functions_(functions),
      watch_(watch),
      feasible_(feasible),
      place_(functions.x().size(), -1),
      scale_(static_cast<std::size_t>(functions.num_constraints()), 1.0),
      x_(functions.x().size()) {
  const sy_problem& p = functions.problem();
  for (std::int32_t j = 0; j < p.num_vars; ++j) {
    x_[static_cast<std::size_t>(j)] = p.x_lower[j];
    if (p.x_lower[j] == p.x_upper[j]) continue;
    place_[static_cast<std::size_t>(j)] = static_cast<std::int32_t>(moving_.size());
    moving_.push_back(j);
  }
  last_.reserve(x_.size());
  last_gradient_.resize(moving_.size());
  best_.x.reserve(x_.size());
  const Csc& normals = functions.normals();
  for (std::int32_t i = 0; i < functions.num_constraints(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    bool speaks = !functions.HasPattern(i);
    for (std::int32_t k = normals.start[at]; k < normals.start[at + 1]; ++k) {
      const auto entry = static_cast<std::size_t>(k);
      const bool moves = place_[static_cast<std::size_t>(normals.row[entry])] >= 0;
      speaks = speaks || (moves && (i >= p.num_rows || normals.value[entry] != 0));
    }
    const bool bounded = std::isfinite(functions.lower(i)) || std::isfinite(functions.upper(i));
    if (speaks && bounded) spoken_.push_back(i);
  }
}

std::vector<double> Program::Moving(const std::vector<double>& x) const {
  std::vector<double> y;
  y.reserve(moving_.size());
  for (const std::int32_t j : moving_) y.push_back(x[static_cast<std::size_t>(j)]);
  return y;
}

void Program::Scale() {
  const auto largest = [this](const double* values, std::int32_t from, std::int32_t to,
                              const std::int32_t* variable) {
    double most = 0;
    for (std::int32_t k = from; k < to; ++k) {
      const std::int32_t j = variable != nullptr ? variable[k] : k;
      if (place_[static_cast<std::size_t>(j)] >= 0) most = std::max(most, std::abs(values[k]));
    }
    return most;
  };
  const bool differentiated = functions_.has_gradients() && functions_.Differentiate();
  const Csc& normals = functions_.normals();
  for (const std::int32_t i : spoken_) {
    const auto at = static_cast<std::size_t>(i);
    if (i >= functions_.problem().num_rows && !differentiated) continue;
    scale_[at] = 1 / std::max(1.0, largest(normals.value.data(), normals.start[at],
                                           normals.start[at + 1], normals.row.data()));
  }
  if (!differentiated) return;
  const std::vector<double>& gradient = functions_.gradient();
  const double steep =
      largest(gradient.data(), 0, static_cast<std::int32_t>(gradient.size()), nullptr);
  objective_scale_ = 1 / std::max(1.0, steep / kSteep);
}

std::size_t Program::num_equations() const {
  return static_cast<std::size_t>(
      std::count_if(spoken_.begin(), spoken_.end(),
                    [this](std::int32_t i) { return functions_.lower(i) == functions_.upper(i); }));
}

Demand Program::Demands() const {
  const std::size_t equations = num_equations();
  return {functions_.has_gradients(), equations > 0, equations < spoken_.size(), moving_.size()};
}

std::int32_t Program::BrokenConstant() const {
  for (std::int32_t i = 0; i < functions_.num_constraints(); ++i) {
    if (std::binary_search(spoken_.begin(), spoken_.end(), i)) continue;
    if (functions_.Violation(i) > feasible_) return i;
  }
  return -1;
}

void Program::Begin(nlopt_opt run, Aim aim, Equations equations, unsigned bits) {
  run_ = run;
  aim_ = aim;
  by_gradients_ = (bits & kGradients) != 0;
  patience_ = Patience(moving_.size(), (bits & kGlobal) != 0);
  halt_ = Halt::kNone;
  undefined_ = 0;
  worst_ = -kInfinity;
  last_.clear();
  equations_.conditions.clear();
  inequalities_.conditions.clear();
  nlopt_set_min_objective(run, &ObjectiveOf, this);
  if (aim == Aim::kViolation) return;
  for (const std::int32_t i : spoken_) {
    const double lower = functions_.lower(i);
    const double upper = functions_.upper(i);
    const double scale = scale_[static_cast<std::size_t>(i)];
    if (lower == upper && equations == Equations::kAsTheyAre) {
      equations_.conditions.push_back({i, 1, upper, scale});
      continue;
    }
    if (std::isfinite(upper)) inequalities_.conditions.push_back({i, 1, upper, scale});
    if (std::isfinite(lower)) inequalities_.conditions.push_back({i, -1, lower, scale});
  }
}

void Program::AddConditions(double tolerance) {
  const auto tolerances = [tolerance](const Group& group) {
    std::vector<double> all;
    for (const Condition& c : group.conditions) {
      all.push_back(tolerance * (1 + c.scale * std::abs(c.bound)));
    }
    return all;
  };
  const auto size = [](const Group& group) { return unsigned(group.conditions.size()); };
  if (size(equations_) > 0) {
    nlopt_add_equality_mconstraint(run_, size(equations_), &ConditionsOf, &equations_,
                                   tolerances(equations_).data());
  }
  if (size(inequalities_) > 0) {
    nlopt_add_inequality_mconstraint(run_, size(inequalities_), &ConditionsOf, &inequalities_,
                                     tolerances(inequalities_).data());
  }
}

double Program::ObjectiveOf(unsigned, const double* y, double* gradient, void* data) noexcept {
  return static_cast<Program*>(data)->Evaluate(y, gradient);
}

// NLopt may leave the bounds by a rounding error, and LD_SLSQP goes on from a step that is NaN.
bool Program::Take(const double* y) {
  const sy_problem& p = functions_.problem();
  bool stands = true;
  for (std::size_t k = 0; k < moving_.size(); ++k) {
    const std::int32_t j = moving_[k];
    if (std::isnan(y[k])) continue;
    const double inside = std::clamp(y[k], p.x_lower[j], p.x_upper[j]);
    double& mine = x_[static_cast<std::size_t>(j)];
    stands = stands && mine == inside;
    mine = inside;
  }
  return stands;
}

double Program::Evaluate(const double* y, double* gradient) {
  patience_.Count(Take(y));
  ++evaluations_;
  const bool defined =
      functions_.MoveTo(x_.data()) && (gradient == nullptr || functions_.Differentiate());
  const double violation = defined ? See() : std::nan("");
  watch_.TellResiduals(evaluations_, defined ? functions_.objective() : std::nan(""), violation,
                       std::nan(""));
  if (functions_.aborted()) Stop(Halt::kAborted);
  if (watch_.Stopped(evaluations_)) Stop(Halt::kWatch);
  if (patience_.stands()) Stop(Halt::kStands);
  if (patience_.idles()) Stop(Halt::kIdles);
  if (!defined) return Undefined(gradient);
  if (gradient != nullptr) {
    std::fill(gradient, gradient + moving_.size(), 0.0);
    if (aim_ == Aim::kObjective) {
      for (std::size_t k = 0; k < moving_.size(); ++k) {
        gradient[k] =
            objective_scale_ * functions_.gradient()[static_cast<std::size_t>(moving_[k])];
      }
    }
  }
  const double value =
      aim_ == Aim::kObjective ? objective_scale_ * functions_.objective() : Violations(gradient);
  if (gradient != nullptr) {
    std::copy(gradient, gradient + moving_.size(), last_gradient_.begin());
  }
  worst_ = std::max(worst_, value);
  return value;
}

// A line search takes a shorter step from an infinite value. What interpolates values cannot take
// it: there the point is as bad as the worst that was seen, and then some.
double Program::Undefined(double* gradient) {
  ++undefined_;
  if (gradient != nullptr) std::copy(last_gradient_.begin(), last_gradient_.end(), gradient);
  if (by_gradients_) return kInfinity;
  return std::isfinite(worst_) ? worst_ + 1 + std::abs(worst_) : kOutside;
}

double Program::See() {
  last_.assign(x_.begin(), x_.end());
  const double objective = functions_.objective();
  const double violation = functions_.Violation();
  const bool holds = violation <= feasible_;
  const bool held = !best_.x.empty() && best_.violation <= feasible_;
  const bool better = held ? holds && objective < best_.objective
                           : holds || best_.x.empty() || violation < best_.violation;
  if (better) {
    best_.x.assign(x_.begin(), x_.end());
    best_.objective = objective;
    best_.violation = violation;
  }
  patience_.See(objective, violation, holds);
  if (holds && objective <= watch_.control().target) watch_.Stop(SY_TARGET);
  if (holds && objective <= kBottom) Stop(Halt::kFalls);
  return violation;
}

void Program::Stop(Halt why) {
  if (halt_ == Halt::kNone) halt_ = why;
  nlopt_force_stop(run_);
}

void Program::AddNormal(std::int32_t constraint, double factor, double* gradient) const {
  const Csc& normals = functions_.normals();
  const auto at = static_cast<std::size_t>(constraint);
  for (std::int32_t k = normals.start[at]; k < normals.start[at + 1]; ++k) {
    const auto entry = static_cast<std::size_t>(k);
    const std::int32_t to = place_[static_cast<std::size_t>(normals.row[entry])];
    if (to >= 0) gradient[to] += factor * normals.value[entry];
  }
}

double Program::Violations(double* gradient) const {
  double sum = 0;
  for (const std::int32_t i : spoken_) {
    const double value = functions_.value(i);
    const double inside = std::clamp(value, functions_.lower(i), functions_.upper(i));
    const double scale = scale_[static_cast<std::size_t>(i)];
    const double outside = scale * (value - inside);
    if (outside == 0) continue;
    sum += 0.5 * outside * outside;
    if (gradient != nullptr) AddNormal(i, outside * scale, gradient);
  }
  return sum;
}

double Program::SlopeOfViolation() const {
  constexpr double kAtBound = 1e-9;
  std::vector<double> gradient(moving_.size(), 0.0);
  const double size = std::sqrt(2 * Violations(gradient.data()));
  const sy_problem& p = functions_.problem();
  double most = 0;
  for (std::size_t k = 0; k < moving_.size(); ++k) {
    const std::int32_t j = moving_[k];
    const double x = functions_.x()[static_cast<std::size_t>(j)];
    const double side = gradient[k] > 0 ? p.x_lower[j] : p.x_upper[j];
    if (std::abs(x - side) > kAtBound * (1 + std::abs(x))) {
      most = std::max(most, std::abs(gradient[k]));
    }
  }
  return most / size;
}

void Program::ConditionsOf(unsigned m, double* values, unsigned n, const double* y,
                           double* gradients, void* data) noexcept {
  const Group& group = *static_cast<Group*>(data);
  Program& program = *group.program;
  Functions& functions = program.functions_;
  program.Take(y);
  const bool defined =
      functions.MoveTo(program.x_.data()) && (gradients == nullptr || functions.Differentiate());
  if (gradients != nullptr) std::fill(gradients, gradients + std::size_t{m} * n, 0.0);
  for (unsigned i = 0; i < m; ++i) {
    const Condition& c = group.conditions[i];
    const double value = c.scale * c.sign * (functions.value(c.constraint) - c.bound);
    const bool known = defined || (!program.by_gradients_ && std::isfinite(value));
    values[i] = known ? value : program.by_gradients_ ? kOutside : 1;
    if (gradients != nullptr) {
      program.AddNormal(c.constraint, c.scale * c.sign, gradients + std::size_t{i} * n);
    }
  }
}

}  // namespace switchyard::nlopt
