#include "solvers/conic/conic.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "solvers/conic/product_cone.hpp"
#include "solvers/conic/run.hpp"
#include "solvers/conic/warm_start.hpp"
#include "switchyard/plugin.hpp"
#include "switchyard/problem_update.hpp"

namespace switchyard::conic {

sy_solver Conic::Describe() {
  sy_solver t = {};
  t.id = "org.switchyard.conic";
  t.name = "conic";
  t.version = "1.0";
  t.license = "BSD-3-Clause";
  t.accepts = SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS | SY_ACCEPTS_QUADRATIC_OBJECTIVE;
  t.cones = (std::uint64_t{1} << (SY_CONE_ROTATED + 1)) - 1;
  t.traits = SY_GIVES_DUALS | SY_GIVES_CERTIFICATES | SY_PROVES_GLOBAL;
  t.honors = SY_HONORS_THREADS | SY_HONORS_SECONDS | SY_HONORS_ITERATIONS | SY_HONORS_CUTOFF |
             SY_HONORS_FEASIBILITY | SY_HONORS_OPTIMALITY | SY_HONORS_VERBOSITY |
             SY_HONORS_CANCELLED;
  t.updates = SY_UPDATES_BOUNDS | SY_UPDATES_VECTORS | SY_UPDATES_VALUES | SY_UPDATES_SWITCH |
              SY_UPDATES_APPEND | SY_UPDATES_REMOVE | SY_UPDATES_HINTS;
  t.options = OptionTable();
  return t;
}

void Conic::Supports(const sy_host&, const sy_problem& problem) {
  if (problem.nlp != nullptr) {
    throw plugin::Failure(SY_E_UNSUPPORTED, "needs a problem without nonlinear functions");
  }
  for (std::int32_t j = 0; problem.integer != nullptr && j < problem.num_vars; ++j) {
    if (problem.integer[j] == 0) continue;
    throw plugin::Failure(SY_E_UNSUPPORTED,
                          "needs continuous variables; x[" + std::to_string(j) + "] is integer");
  }
  if (problem.P != nullptr && (problem.flags & SY_PROBLEM_CONVEX) == 0) {
    throw plugin::Failure(SY_E_UNSUPPORTED,
                          "needs a quadratic objective that is known to be convex "
                          "(SY_PROBLEM_CONVEX); this one is not");
  }
}

void Conic::SetOption(std::string_view name, const sy_value& value) {
  options_.Set(name, value);
  stale_ = true;
}

void Conic::Load(const sy_problem& problem, std::uint64_t updates) {
  Supports(host_, problem);
  updates_ = updates;
  problem_ = Problem(problem);
  hinted_vars_ = problem.num_vars;
  given_.reset();
  prepared_.reset();
  Prepare();
}

void Conic::Prepare() {
  std::unique_ptr<Prepared> before = std::move(prepared_);
  prepared_ =
      std::make_unique<Prepared>(problem_.data(), hinted_vars_, options_, updates_, before.get());
  if (last_ && prepared_->shares_symbolic_phase()) {
    last_ = Carried(*last_, before->form(), prepared_->form());
  } else {
    last_.reset();
  }
  stale_ = false;
}

void Conic::Update(const sy_update& update) {
  if (update.problem != nullptr && (update.whole & SY_UPDATES_VALUES) != 0) {
    Supports(host_, *update.problem);
  }
  problem_.Apply(update);
  if ((update.whole & SY_UPDATES_HINTS) != 0) hinted_vars_ = update.problem->num_vars;
  if (stale_) prepared_.reset();
  if (update.num_gone_rows > 0 || update.num_gone_cones > 0 || update.more != nullptr)
    given_.reset();
  Prepare();
}

void Conic::WarmStart(const sy_start& start) {
  const ProblemData& d = problem_.data();
  const auto taken = [](const double* from, std::int32_t count) {
    std::vector<double> values;
    if (from != nullptr) values.assign(from, from + count);
    return std::ranges::all_of(values, [](double v) { return std::isfinite(v); })
               ? values
               : std::vector<double>();
  };
  presolve::Answer given;
  given.x = taken(start.x, d.num_vars);
  given.row_dual = taken(start.row_dual, d.num_rows());
  given.cone_dual = taken(start.cone_dual, d.num_cone_rows());
  given_.reset();
  if (static_cast<std::int32_t>(given.x.size()) == d.num_vars &&
      static_cast<std::int32_t>(given.row_dual.size()) == d.num_rows() &&
      static_cast<std::int32_t>(given.cone_dual.size()) == d.num_cone_rows()) {
    given_ = std::move(given);
  }
}

/// What warm_start gave, as an iterate.
std::optional<Iterate> Conic::Given() const {
  if (!given_) return std::nullopt;
  if (!ProductCone(prepared_->form()).symmetric()) return std::nullopt;
  return AsIterate(prepared_->presolve().Forth(*given_), prepared_->form());
}

void Conic::Solve(const sy_control& control, sy_result& result) {
  if (stale_) prepared_.reset();
  if (prepared_ == nullptr) Prepare();
  Run run(problem_, *prepared_, options_, host_, control);
  const bool may_continue = (control.flags & SY_CONTINUE) != 0 && last_;
  const std::optional<Iterate> from = may_continue ? last_ : Given();
  run.Solve(from ? &*from : nullptr);
  run.Write(result);
  if (run.optimum()) last_ = run.optimum();
}

std::unique_ptr<Conic> Conic::Clone() const {
  auto copy = std::make_unique<Conic>(host_);
  copy->options_ = options_;
  copy->updates_ = updates_;
  copy->problem_ = problem_;
  copy->hinted_vars_ = hinted_vars_;
  copy->stale_ = stale_;
  if (prepared_ != nullptr) {
    copy->prepared_ = std::make_unique<Prepared>(copy->problem_.data(), hinted_vars_, options_,
                                                 updates_, prepared_.get());
  }
  return copy;
}

}  // namespace switchyard::conic
