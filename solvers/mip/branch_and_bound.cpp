#include "solvers/mip/branch_and_bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "solvers/mip/run.hpp"
#include "solvers/mip/strengthening.hpp"
#include "solvers/rounding/general.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard::mip {

sy_solver BranchAndBound::Describe() {
  constexpr std::uint64_t kAllCones = (std::uint64_t{1} << (SY_CONE_ROTATED + 1)) - 1;
  sy_solver t = {};
  t.id = "org.switchyard.branch-and-bound";
  t.name = "branch-and-bound";
  t.version = "1.0";
  t.license = "BSD-3-Clause";
  t.accepts = SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS | SY_ACCEPTS_INTEGER;
  t.cones = kAllCones;
  t.integer_accepts = t.accepts;
  t.integer_cones = t.cones;
  t.traits = SY_STRATEGY | SY_GIVES_BOUND | SY_PROVES_GLOBAL;
  t.honors = SY_HONORS_THREADS | SY_HONORS_SECONDS | SY_HONORS_NODES | SY_HONORS_CUTOFF |
             SY_HONORS_TARGET | SY_HONORS_FEASIBILITY | SY_HONORS_OPTIMALITY |
             SY_HONORS_ABSOLUTE_GAP | SY_HONORS_RELATIVE_GAP | SY_HONORS_SEED |
             SY_HONORS_VERBOSITY | SY_HONORS_CANCELLED;
  t.options = OptionTable();
  return t;
}

void BranchAndBound::Supports(const sy_host&, const sy_problem& problem) {
  if (problem.nlp != nullptr) {
    throw plugin::Failure(SY_E_UNSUPPORTED, "branch-and-bound takes no nonlinear functions");
  }
}

void BranchAndBound::Load(const sy_problem& problem, std::uint64_t) {
  Supports(host_, problem);
  if (problem.P != nullptr) {
    throw plugin::Failure(SY_E_UNSUPPORTED, "branch-and-bound takes linear objectives");
  }
  paths_.reset();
  whole_.reset();
  start_.clear();
  pool_.clear();
  whole_.emplace(problem);
  if (rounding::IsPathProblem(problem)) paths_.emplace(problem);
}

void BranchAndBound::WarmStart(const sy_start& start) {
  start_.clear();
  if (start.x != nullptr) start_.assign(start.x, start.x + whole_->problem().num_vars);
}

void BranchAndBound::Solve(const sy_control& control, sy_result& result) {
  pool_.clear();
  if (whole_->integers().empty()) {
    rounding::Options options;
    options.solver = options_.solver;
    return rounding::SolveGeneral(*whole_, options, host_, control, result);
  }
  rounding::Budget budget(control);
  std::optional<Strengthened> strong;
  if (options_.strengthening != 0 && !paths_) strong = Strengthen(*whole_, options_, host_, budget);
  std::optional<rounding::IntegerProblem> other;
  if (strong) other.emplace(strong->problem.view());
  sy_control rest = control;
  rest.seconds = std::max(0.0, control.seconds - budget.Seconds());
  Run run(other ? *other : *whole_, paths_ ? &*paths_ : nullptr, options_, host_, rest, start_);
  run.Solve();
  run.Write(result);
  result.seconds = budget.Seconds();
  pool_ = run.Pool();
  if (!pool_.empty()) pool_.erase(pool_.begin());  // the answer
}

const void* BranchAndBound::Extension(const char* id) {
  static const sy_pool pool = {
      sizeof(sy_pool), 0,
      [](sy_instance* p) noexcept {
        return static_cast<std::int32_t>(plugin::As<BranchAndBound>(p).solver->pool().size());
      },
      [](sy_instance* p, std::int32_t i, sy_result* result, sy_error* error) noexcept {
        return plugin::Guarded(error, [&] {
          const auto& all = plugin::As<BranchAndBound>(p).solver->pool();
          if (i < 0 || static_cast<std::size_t>(i) >= all.size()) {
            throw plugin::Failure(SY_E_ARGUMENT, "the pool has " + std::to_string(all.size()) +
                                                     " solutions, and number " + std::to_string(i) +
                                                     " is asked for");
          }
          const Solution& one = all[static_cast<std::size_t>(i)];
          result->primal = SY_FEASIBLE;
          result->objective = one.objective;
          if (result->x != nullptr) std::copy(one.x.begin(), one.x.end(), result->x);
        });
      }};
  return id != nullptr && std::string_view(id) == "sy.pool/1" ? &pool : nullptr;
}

}  // namespace switchyard::mip
