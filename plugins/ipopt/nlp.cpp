#include "nlp.hpp"

#include <algorithm>
#include <cmath>

#include "linear/answer.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::ipopt {
namespace {

// Half the width of an equation where Ipopt would refuse it as one too many.
constexpr double kLoose = 1e-9;

bool Known(const std::vector<double>& values, std::int32_t count) {
  return values.size() == static_cast<std::size_t>(count) &&
         std::none_of(values.begin(), values.end(), [](double v) { return std::isnan(v); });
}

void Give(const Places& places, std::int32_t* row, std::int32_t* col) {
  std::copy(places.row.begin(), places.row.end(), row);
  std::copy(places.col.begin(), places.col.end(), col);
}

}  // namespace

bool Point::Complete(const sy_problem& p) const {
  return Known(x, p.num_vars) && Known(x_dual, p.num_vars) && Known(row_dual, p.num_rows) &&
         (!HasConstraints(p) || Known(nlp_dual, p.nlp->num_constraints));
}

Program::Program(const sy_problem& problem, const Shape& shape, Functions& functions,
                 const Point& start, linear::Watch& watch, const Setting& setting)
    : p_(problem),
      shape_(shape),
      functions_(functions),
      start_(start),
      watch_(watch),
      setting_(setting),
      activity_(static_cast<std::size_t>(problem.num_rows)),
      multipliers_(HasConstraints(problem) ? std::size_t(problem.nlp->num_constraints) : 0) {}

template <class Visit>
void Program::ForEachConstraint(Visit&& visit) const {
  Index k = 0;
  for (const std::int32_t i : shape_.rows) {
    visit(k++, p_.row_lower[i], p_.row_upper[i], static_cast<std::size_t>(i), true);
  }
  for (const std::int32_t i : shape_.constraints) {
    visit(k++, p_.nlp->lower[i], p_.nlp->upper[i], static_cast<std::size_t>(i), false);
  }
}

bool Program::get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian,
                           IndexStyleEnum& style) {
  n = p_.num_vars;
  m = static_cast<Index>(shape_.rows.size() + shape_.constraints.size());
  jacobian = static_cast<Index>(shape_.jacobian.size());
  hessian = static_cast<Index>(shape_.hessian.size());
  style = C_STYLE;
  return true;
}

// Ipopt widens all sides a little. Functions need not be defined outside the bounds, so these are
// given as much narrower, where there is room.
bool Program::get_bounds_info(Index n, Number* x_l, Number* x_u, Index, Number* g_l, Number* g_u) {
  std::copy(p_.x_lower, p_.x_lower + n, x_l);
  std::copy(p_.x_upper, p_.x_upper + n, x_u);
  for (Index j = 0; HasFunctions(p_) && j < n; ++j) {
    const auto width = [this](double side) {
      return std::isinf(side) ? 0 : setting_.widening * std::max(1.0, std::abs(side));
    };
    const double below = width(x_l[j]);
    const double above = width(x_u[j]);
    if (x_u[j] - x_l[j] <= 4 * (below + above)) continue;
    x_l[j] += below;
    x_u[j] -= above;
  }
  ForEachConstraint([&](Index k, double lower, double upper, std::size_t, bool) {
    const bool loosened = shape_.loosens_equations() && lower == upper;
    const double width = loosened ? kLoose * std::max(1.0, std::abs(lower)) : 0;
    g_l[k] = lower - width;
    g_u[k] = upper + width;
  });
  return true;
}

bool Program::get_starting_point(Index n, bool init_x, Number* x, bool init_z, Number* z_L,
                                 Number* z_U, Index, bool init_lambda, Number* lambda) {
  for (Index j = 0; init_x && j < n; ++j) {
    const auto at = static_cast<std::size_t>(j);
    const bool known = at < start_.x.size() && !std::isnan(start_.x[at]);
    x[j] = std::clamp(known ? start_.x[at] : 0.0, p_.x_lower[j], p_.x_upper[j]);
  }
  for (Index j = 0; init_z && j < n; ++j) {
    const double d = start_.x_dual[static_cast<std::size_t>(j)];
    z_L[j] = std::max(d, 0.0);
    z_U[j] = std::max(-d, 0.0);
  }
  if (!init_lambda) return true;
  ForEachConstraint([&](Index k, double, double, std::size_t i, bool is_row) {
    lambda[k] = -(is_row ? start_.row_dual : start_.nlp_dual)[i];
  });
  return true;
}

bool Program::eval_f(Index, const Number* x, bool, Number& value) {
  value = Objective(p_, x);
  return functions_.AddObjective(x, value);
}

bool Program::eval_grad_f(Index n, const Number* x, bool, Number* gradient) {
  std::copy(p_.q, p_.q + n, gradient);
  if (p_.P != nullptr) SymmetricMultiplyAdd(*p_.P, 1, x, gradient);
  return functions_.AddGradient(x, gradient);
}

bool Program::eval_g(Index, const Number* x, bool, Index, Number* g) {
  const double* c = shape_.constraints.empty() ? nullptr : functions_.Constraints(x);
  if (c == nullptr && !shape_.constraints.empty()) return false;
  std::fill(activity_.begin(), activity_.end(), 0.0);
  if (!shape_.rows.empty()) MultiplyAdd(*p_.A, 1, x, activity_.data());
  ForEachConstraint([&](Index k, double, double, std::size_t i, bool is_row) {
    g[k] = is_row ? activity_[i] : c[i];
  });
  return true;
}

bool Program::eval_jac_g(Index, const Number* x, bool, Index, Index, Index* row, Index* col,
                         Number* values) {
  if (values == nullptr) {
    Give(shape_.jacobian, row, col);
    return true;
  }
  Number* to = std::copy(shape_.row_values.begin(), shape_.row_values.end(), values);
  if (shape_.constraints.empty()) return true;
  const double* jacobian = functions_.Jacobian(x);
  if (jacobian == nullptr) return false;
  for (const std::int32_t k : shape_.entries) *to++ = jacobian[k];
  return true;
}

bool Program::eval_h(Index, const Number* x, bool, Number factor, Index, const Number* lambda, bool,
                     Index, Index* row, Index* col, Number* values) {
  if (values == nullptr) {
    Give(shape_.hessian, row, col);
    return true;
  }
  const std::int32_t entries = p_.P != nullptr ? p_.P->start[p_.num_vars] : 0;
  for (std::int32_t k = 0; k < entries; ++k) values[k] = factor * p_.P->value[k];
  if (!HasFunctions(p_)) return true;
  ForEachConstraint([&](Index k, double, double, std::size_t i, bool is_row) {
    if (!is_row) multipliers_[i] = lambda[k];
  });
  return functions_.Hessian(x, factor, multipliers_.data(), values + entries);
}

// The restoration phase minimizes something else than the objective, with other residuals.
bool Program::intermediate_callback(Ipopt::AlgorithmMode mode, Index iteration, Number objective,
                                    Number primal, Number dual, Number, Number, Number, Number,
                                    Number, Index, const Ipopt::IpoptData*,
                                    Ipopt::IpoptCalculatedQuantities*) {
  found_.began = true;
  found_.iterations = iteration;
  const bool regular = mode == Ipopt::RegularMode;
  const auto told = [regular](double value) { return regular ? value : linear::kNaN; };
  watch_.TellResiduals(setting_.before + iteration, told(objective), told(primal), told(dual));
  return !functions_.ended() && !watch_.Stopped(setting_.before + iteration);
}

// Ipopt widens bounds a little on its way. A multiplier against a side that is infinite is a
// rounding error.
void Program::finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number*,
                                const Number*, Index m, const Number*, const Number* lambda, Number,
                                const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) {
  const auto finite = [](double v) { return std::isfinite(v); };
  found_.has_point = std::all_of(x, x + n, finite) && std::all_of(lambda, lambda + m, finite);
  if (!found_.has_point) return;
  Point& point = found_.point;
  point.x.assign(x, x + n);
  for (Index j = 0; j < n; ++j) {
    point.x[static_cast<std::size_t>(j)] = std::clamp(x[j], p_.x_lower[j], p_.x_upper[j]);
  }
  point.row_dual.assign(activity_.size(), 0.0);
  point.nlp_dual.assign(multipliers_.size(), 0.0);
  ForEachConstraint([&](Index k, double lower, double upper, std::size_t i, bool is_row) {
    const double y = -lambda[k];
    const bool against_nothing = std::isinf(y > 0 ? lower : upper);
    (is_row ? point.row_dual : point.nlp_dual)[i] = against_nothing ? 0 : y;
  });
}

}  // namespace switchyard::ipopt
