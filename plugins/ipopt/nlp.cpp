#include "nlp.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "host_journal.hpp"
#include "linear/answer.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard::ipopt {
namespace {

// Half the width of an equation where Ipopt would refuse it as one too many.
constexpr double kLoose = 1e-9;

bool IsFixed(const sy_problem& p, std::int32_t j) { return p.x_lower[j] == p.x_upper[j]; }

std::vector<std::int32_t> RowsThatSpeak(const sy_problem& p) {
  std::vector<std::uint8_t> speaks(static_cast<std::size_t>(p.num_rows), 0);
  for (std::int32_t j = 0; p.A != nullptr && j < p.num_vars; ++j) {
    if (IsFixed(p, j)) continue;
    for (std::int32_t k = p.A->start[j]; k < p.A->start[j + 1]; ++k) {
      if (p.A->value[k] != 0) speaks[static_cast<std::size_t>(p.A->row[k])] = 1;
    }
  }
  std::vector<std::int32_t> rows;
  for (std::int32_t i = 0; i < p.num_rows; ++i) {
    const bool bounded = std::isfinite(p.row_lower[i]) || std::isfinite(p.row_upper[i]);
    if (bounded && speaks[static_cast<std::size_t>(i)] != 0) rows.push_back(i);
  }
  return rows;
}

bool Known(const std::vector<double>& values, std::int32_t count) {
  return values.size() == static_cast<std::size_t>(count) &&
         std::none_of(values.begin(), values.end(), [](double v) { return std::isnan(v); });
}

}  // namespace

bool Point::Complete(std::int32_t num_vars, std::int32_t num_rows) const {
  return Known(x, num_vars) && Known(x_dual, num_vars) && Known(row_dual, num_rows);
}

Program::Program(const sy_problem& problem, const Point& start, linear::Watch& watch,
                 std::int64_t before)
    : p_(problem),
      start_(start),
      watch_(watch),
      before_(before),
      kept_(RowsThatSpeak(problem)),
      place_(static_cast<std::size_t>(problem.num_rows), -1),
      activity_(static_cast<std::size_t>(problem.num_rows)) {
  std::int32_t equations = 0;
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const std::int32_t i = kept_[k];
    place_[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(k);
    if (p_.row_lower[i] == p_.row_upper[i]) ++equations;
  }
  std::int32_t unfixed = 0;
  for (std::int32_t j = 0; j < p_.num_vars; ++j) unfixed += IsFixed(p_, j) ? 0 : 1;
  loosens_equations_ = equations > unfixed;
  for (std::int32_t j = 0; !kept_.empty() && j < p_.num_vars; ++j) {
    for (std::int32_t k = p_.A->start[j]; k < p_.A->start[j + 1]; ++k) {
      const std::int32_t to = place_[static_cast<std::size_t>(p_.A->row[k])];
      if (to < 0) continue;
      entry_row_.push_back(to);
      entry_col_.push_back(j);
      entry_value_.push_back(p_.A->value[k]);
    }
  }
}

bool Program::get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian,
                           IndexStyleEnum& style) {
  n = p_.num_vars;
  m = static_cast<Index>(kept_.size());
  jacobian = static_cast<Index>(entry_row_.size());
  hessian = p_.P != nullptr ? p_.P->start[p_.num_vars] : 0;
  style = C_STYLE;
  return true;
}

bool Program::get_bounds_info(Index n, Number* x_l, Number* x_u, Index m, Number* g_l,
                              Number* g_u) {
  std::copy(p_.x_lower, p_.x_lower + n, x_l);
  std::copy(p_.x_upper, p_.x_upper + n, x_u);
  for (Index k = 0; k < m; ++k) {
    const std::int32_t i = kept_[static_cast<std::size_t>(k)];
    g_l[k] = p_.row_lower[i];
    g_u[k] = p_.row_upper[i];
    if (!loosens_equations_ || g_l[k] != g_u[k]) continue;
    const double width = kLoose * std::max(1.0, std::abs(g_l[k]));
    g_l[k] -= width;
    g_u[k] += width;
  }
  return true;
}

bool Program::get_starting_point(Index n, bool init_x, Number* x, bool init_z, Number* z_L,
                                 Number* z_U, Index m, bool init_lambda, Number* lambda) {
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
  for (Index k = 0; init_lambda && k < m; ++k) {
    lambda[k] = -start_.row_dual[static_cast<std::size_t>(kept_[static_cast<std::size_t>(k)])];
  }
  return true;
}

bool Program::eval_f(Index, const Number* x, bool, Number& value) {
  value = Objective(p_, x);
  return true;
}

bool Program::eval_grad_f(Index n, const Number* x, bool, Number* gradient) {
  std::copy(p_.q, p_.q + n, gradient);
  if (p_.P != nullptr) SymmetricMultiplyAdd(*p_.P, 1, x, gradient);
  return true;
}

bool Program::eval_g(Index, const Number* x, bool, Index m, Number* g) {
  if (m == 0) return true;
  std::fill(activity_.begin(), activity_.end(), 0.0);
  MultiplyAdd(*p_.A, 1, x, activity_.data());
  for (Index k = 0; k < m; ++k) {
    g[k] = activity_[static_cast<std::size_t>(kept_[static_cast<std::size_t>(k)])];
  }
  return true;
}

bool Program::eval_jac_g(Index, const Number*, bool, Index, Index, Index* row, Index* col,
                         Number* values) {
  if (values != nullptr) {
    std::copy(entry_value_.begin(), entry_value_.end(), values);
    return true;
  }
  std::copy(entry_row_.begin(), entry_row_.end(), row);
  std::copy(entry_col_.begin(), entry_col_.end(), col);
  return true;
}

// P is an upper triangle by columns; Ipopt wants a lower one.
bool Program::eval_h(Index n, const Number*, bool, Number factor, Index, const Number*, bool,
                     Index entries, Index* row, Index* col, Number* values) {
  if (entries == 0) return true;
  if (values != nullptr) {
    std::transform(p_.P->value, p_.P->value + entries, values,
                   [factor](double v) { return factor * v; });
    return true;
  }
  std::copy(p_.P->row, p_.P->row + entries, col);
  for (Index j = 0; j < n; ++j) std::fill(row + p_.P->start[j], row + p_.P->start[j + 1], j);
  return true;
}

// The restoration phase minimizes something else than the objective.
bool Program::intermediate_callback(Ipopt::AlgorithmMode mode, Index iteration, Number objective,
                                    Number, Number, Number, Number, Number, Number, Number, Index,
                                    const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) {
  found_.iterations = iteration;
  watch_.Tell(before_ + iteration, mode == Ipopt::RegularMode ? objective : linear::kNaN,
              -kInfinity);
  return !watch_.Stopped(before_ + iteration);
}

// Ipopt widens bounds a little on its way. A multiplier against a side that is infinite is a
// rounding error.
void Program::finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number*,
                                const Number*, Index m, const Number*, const Number* lambda, Number,
                                const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) {
  const auto finite = [](double v) { return std::isfinite(v); };
  found_.has_point = std::all_of(x, x + n, finite) && std::all_of(lambda, lambda + m, finite);
  if (!found_.has_point) return;
  found_.point.x.assign(x, x + n);
  for (Index j = 0; j < n; ++j) {
    found_.point.x[static_cast<std::size_t>(j)] = std::clamp(x[j], p_.x_lower[j], p_.x_upper[j]);
  }
  found_.point.row_dual.assign(static_cast<std::size_t>(p_.num_rows), 0.0);
  for (Index k = 0; k < m; ++k) {
    const std::int32_t i = kept_[static_cast<std::size_t>(k)];
    const double y = -lambda[k];
    const bool against_nothing = std::isinf(y > 0 ? p_.row_lower[i] : p_.row_upper[i]);
    found_.point.row_dual[static_cast<std::size_t>(i)] = against_nothing ? 0 : y;
  }
}

namespace {

Found RunOnce(const sy_problem& problem, const Point& start, const Options& options, Way way,
              const sy_host& host, linear::Watch& watch, std::int64_t before) {
  constexpr bool kConsole = false;
  Ipopt::SmartPtr<Ipopt::IpoptApplication> solver = new Ipopt::IpoptApplication(kConsole);
  Ipopt::SmartPtr<Ipopt::Journal> journal = new HostJournal(host);
  solver->Jnlst()->AddJournal(journal);
  options.Give(watch.control(), way, *solver->Options());
  std::istringstream no_file;  // else Ipopt reads the ipopt.opt of the folder it is run in
  Found found;
  found.status = solver->Initialize(no_file);
  if (found.status == Ipopt::Solve_Succeeded) {
    Ipopt::SmartPtr<Program> program = new Program(problem, start, watch, before);
    const auto status = solver->OptimizeTNLP(Ipopt::GetRawPtr(program));
    found = program->found();
    found.status = status;
  }
  if (found.status == Ipopt::Invalid_Option) {
    throw plugin::Failure(SY_E_ARGUMENT,
                          "Ipopt refuses these options together; its log says which");
  }
  constexpr Ipopt::ApplicationReturnStatus kBroken[] = {
      Ipopt::Invalid_Problem_Definition, Ipopt::Unrecoverable_Exception,
      Ipopt::NonIpopt_Exception_Thrown, Ipopt::Internal_Error};
  if (std::find(std::begin(kBroken), std::end(kBroken), found.status) != std::end(kBroken)) {
    throw plugin::Failure(SY_E_INTERNAL,
                          "Ipopt broke down with its status " + std::to_string(found.status));
  }
  return found;
}

}  // namespace

Found Run(const sy_problem& problem, const Point& start, const Options& options,
          const sy_host& host, linear::Watch& watch, std::int64_t before) {
  const bool convex = problem.P == nullptr || (problem.flags & SY_PROBLEM_CONVEX) != 0;
  const bool warm = start.Complete(problem.num_vars, problem.num_rows);
  Found first;
  if (convex && !warm && !options.ChoosesItsWay()) {
    first = RunOnce(problem, start, options, Way::kFullSteps, host, watch, before);
    if (first.status == Ipopt::Solve_Succeeded || watch.reason() != SY_NOT_SOLVED) return first;
  }
  Found found = RunOnce(problem, start, options, warm ? Way::kWarm : Way::kLineSearch, host, watch,
                        before + first.iterations);
  found.iterations += first.iterations;
  return found;
}

}  // namespace switchyard::ipopt
