#include "highs.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "linear/answer.hpp"
#include "linear/settings.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard::highs {

using linear::Clear;
using linear::Duals;
using linear::Put;
using linear::Say;
using linear::Watch;
using plugin::Failure;

void Must(HighsStatus status, const char* what) {
  if (status == HighsStatus::kError) {
    throw Failure(SY_E_INTERNAL, std::string("HiGHS refused ") + what);
  }
}

void Attach(Highs& solver, Watch& watch, const sy_host& host) {
  const auto hear = [&](int kind, const std::string& text, const HighsCallbackOutput* out,
                        HighsCallbackInput* in, void*) {
    if (kind == kCallbackLogging) {
      if (host.log != nullptr) host.log(host.context, SY_LOG_INFO, text.c_str());
    } else if (kind == kCallbackMipImprovingSolution) {
      watch.Tell(out->mip_total_lp_iterations, out->objective_function_value, out->mip_dual_bound,
                 out->mip_node_count, 0, out->mip_solution.data());
    } else if (kind == kCallbackMipInterrupt) {
      watch.Tell(out->mip_total_lp_iterations, out->mip_primal_bound, out->mip_dual_bound,
                 out->mip_node_count);
      if (out->mip_dual_bound >= watch.control().cutoff) watch.Stop(SY_CUTOFF);
      in->user_interrupt = watch.Stopped(out->mip_total_lp_iterations);
    } else {
      const auto iterations = std::max(out->simplex_iteration_count, out->ipm_iteration_count);
      watch.Tell(iterations, out->objective_function_value, -kInfinity);
      in->user_interrupt = watch.Stopped();
    }
  };
  solver.setCallback(hear);
  for (const auto kind : {kCallbackLogging, kCallbackSimplexInterrupt, kCallbackIpmInterrupt,
                          kCallbackMipInterrupt, kCallbackMipImprovingSolution}) {
    solver.startCallback(kind);
  }
}

Solver::Solver(const sy_host& host) : host_(host) {
  worker_.Run([this] {
    highs_ = std::make_unique<Highs>();
    highs_->setOptionValue("output_flag", false);
    highs_->setOptionValue("log_to_console", false);
  });
}

Solver::~Solver() {
  worker_.Run([this] {
    highs_.reset();
    Highs::resetGlobalScheduler(true);
  });
}

// The words of an option are those of every build of HiGHS; this one may lack what a word names.
void Solver::SetOption(std::string_view name, const sy_value& value) {
  Options changed = options_;
  changed.Set(name, value);
  worker_.Run([&] {
    HighsOptions tried = changed.own();
    tried.output_flag = tried.log_to_console = false;
    if (highs_->passOptions(tried) == HighsStatus::kError) {
      throw Failure(SY_E_ARGUMENT, "this build of HiGHS refuses the value of option " +
                                       std::string(name) + ": " + linear::Said(value));
    }
  });
  options_ = changed;
}

void Solver::WarmStart(const sy_start& start) {
  start_ = linear::Start(start, highs_->getNumCol(), highs_->getNumRow());
  start_is_new_ = true;
}

void Solver::Solve(const sy_control& control, sy_result& result) {
  Watch watch(control);
  Clear(result);
  worker_.Run(
      [&] {
        HighsOptions options = options_.For(control);
        if (options.threads != threads_) Highs::resetGlobalScheduler(true);
        threads_ = options.threads;
        options.time_limit = std::min(options.time_limit, highs_->getRunTime() + watch.Left());
        Must(highs_->passOptions(options), "its options");
        Begin((control.flags & SY_CONTINUE) != 0);
        Attach(*highs_, watch, host_);
        Run(watch, result);
        highs_->setCallback(HighsCallbackFunctionType());
      },
      [&] {
        if (watch.Stopped()) EndTime();
      });
  result.seconds = watch.Seconds();
}

// Branch and bound and presolve ask for interrupts too seldom, but often whether time is up.
void Solver::EndTime() {
  double& limit = const_cast<HighsOptions&>(highs_->getOptions()).time_limit;
  std::atomic_ref<double>(limit).store(0, std::memory_order_relaxed);
}

// A start given since the last solve replaces what that solve left.
void Solver::Begin(bool proceed) {
  if (proceed && !start_is_new_) return;
  start_is_new_ = false;
  Must(highs_->clearSolver(), "a fresh start");
  if (start_.has_basis()) {
    constexpr HighsBasisStatus kMeaning[] = {HighsBasisStatus::kNonbasic, HighsBasisStatus::kBasic,
                                             HighsBasisStatus::kLower, HighsBasisStatus::kUpper,
                                             HighsBasisStatus::kZero};
    HighsBasis basis;
    for (const auto b : start_.x_basis) basis.col_status.push_back(kMeaning[std::min<int>(b, 4)]);
    for (const auto b : start_.row_basis) basis.row_status.push_back(kMeaning[std::min<int>(b, 4)]);
    Must(highs_->setBasis(basis, "switchyard"), "the starting basis");
  }
  if (start_.x.empty() || !has_integers()) return;
  std::vector<HighsInt> known;
  std::vector<double> values;
  for (std::size_t j = 0; j < start_.x.size(); ++j) {
    if (std::isnan(start_.x[j])) continue;
    known.push_back(static_cast<HighsInt>(j));
    values.push_back(start_.x[j]);
  }
  if (known.empty()) return;
  Must(highs_->setSolution(static_cast<HighsInt>(known.size()), known.data(), values.data()),
       "the starting point");
}

void Solver::Run(Watch& watch, sy_result& result) {
  if (highs_->getNumCol() == 0) {
    const ModelView view(highs_->getModel());
    const double tolerance = highs_->getOptions().primal_feasibility_tolerance;
    return linear::AnswerWithoutVariables(view.problem, tolerance, result);
  }
  if (watch.Stopped()) {
    result.termination = watch.reason();
    return;
  }
  const bool failed = highs_->run() == HighsStatus::kError;
  if (failed && highs_->getHessianNumNz() > 0 &&
      highs_->getModelStatus() == HighsModelStatus::kSolveError) {
    throw Failure(SY_E_UNSUPPORTED,
                  "HiGHS ended in its solve error on this quadratic objective, as it does where it "
                  "finds one not convex");
  }
  Report(watch, result);
}

sy_termination Solver::Reason(const Watch& watch) const {
  switch (highs_->getModelStatus()) {
    case HighsModelStatus::kOptimal:
      return SY_OPTIMAL;
    case HighsModelStatus::kInfeasible:
      // Branch and bound prunes by the cutoff too, and then says that nothing is left.
      return has_integers() && watch.control().cutoff < kInfinity ? SY_CUTOFF : SY_INFEASIBLE;
    case HighsModelStatus::kUnbounded:
      return SY_UNBOUNDED;
    case HighsModelStatus::kUnboundedOrInfeasible:
      return SY_INFEASIBLE_OR_UNBOUNDED;
    case HighsModelStatus::kObjectiveBound:
      return SY_CUTOFF;
    case HighsModelStatus::kObjectiveTarget:
      return SY_TARGET;
    case HighsModelStatus::kTimeLimit:
      return watch.reason() != SY_NOT_SOLVED ? watch.reason() : SY_TIME_LIMIT;
    case HighsModelStatus::kIterationLimit:
      return SY_ITERATION_LIMIT;
    case HighsModelStatus::kSolutionLimit:
      return SY_NODE_LIMIT;
    case HighsModelStatus::kMemoryLimit:
      return SY_MEMORY_LIMIT;
    case HighsModelStatus::kInterrupt:
    case HighsModelStatus::kHighsInterrupt:
      return watch.reason();
    default:
      return SY_NUMERICAL_TROUBLE;
  }
}

void Solver::Report(Watch& watch, sy_result& result) {
  const HighsInfo& info = highs_->getInfo();
  const HighsSolution& solution = highs_->getSolution();
  const HighsModelStatus status = highs_->getModelStatus();
  result.termination = Reason(watch);
  Say(result, highs_->modelStatusToString(status));
  for (const auto count :
       {info.simplex_iteration_count, info.ipm_iteration_count, info.crossover_iteration_count,
        info.pdlp_iteration_count, info.qp_iteration_count}) {
    result.iterations += std::max<HighsInt>(count, 0);
  }
  result.nodes = std::max<std::int64_t>(info.mip_node_count, 0);
  if (solution.value_valid && info.primal_solution_status != kSolutionStatusNone) {
    const bool feasible = info.primal_solution_status == kSolutionStatusFeasible;
    result.primal = feasible ? SY_FEASIBLE : SY_INFEASIBLE_POINT;
    result.objective = info.objective_function_value;
    Put(result.x, solution.col_value);
  }
  const ModelView view(highs_->getModel());
  if (has_integers()) {
    if (!std::isnan(info.mip_dual_bound)) result.bound = info.mip_dual_bound;
  } else {
    ReportBasis(result);
    ReportDuals(view, result);
  }
  ReportCertificate(view, watch, result);
}

void Solver::ReportDuals(const ModelView& view, sy_result& result) {
  const HighsSolution& solution = highs_->getSolution();
  const bool optimal = result.termination == SY_OPTIMAL;
  if (optimal) result.bound = result.objective;
  const HighsInt kind = highs_->getInfo().dual_solution_status;
  if (!solution.dual_valid || !solution.value_valid || kind == kSolutionStatusNone) return;
  const Duals duals = linear::Complete(view.problem, solution.col_value.data(), solution.row_dual);
  Put(result, duals, kind == kSolutionStatusFeasible ? SY_FEASIBLE : SY_INFEASIBLE_POINT);
  if (optimal || result.termination == SY_INFEASIBLE || result.termination == SY_UNBOUNDED) return;
  result.bound = DualObjective(view.problem, solution.col_value.data(), duals, linear::kRayNoise);
}

// Presolve proves without a ray; the solves that find one have what is left of the time.
void Solver::ReportCertificate(const ModelView& view, Watch& watch, sy_result& result) {
  if (has_integers()) return;
  if (result.termination == SY_INFEASIBLE &&
      (result.x_dual != nullptr || result.row_dual != nullptr)) {
    std::vector<double> ray(static_cast<std::size_t>(view.problem.num_rows));
    std::optional<Duals> duals;
    bool has_ray = false;
    if (view.problem.P == nullptr &&
        highs_->getDualRay(has_ray, ray.data()) != HighsStatus::kError && has_ray) {
      duals = linear::Farkas(view.problem, ray);
    }
    if (!duals) duals = FindFarkas(highs_->getModel(), highs_->getOptions(), host_, watch);
    if (duals) Put(result, *duals, SY_CERTIFICATE);
  } else if (result.termination == SY_UNBOUNDED && result.x != nullptr) {
    const auto ray = FindRay(highs_->getModel(), highs_->getOptions(), host_, watch);
    if (!ray) return;
    result.primal = SY_CERTIFICATE;
    Put(result.x, *ray);
  }
  if (result.termination == SY_UNBOUNDED) result.objective = -kInfinity;
}

void Solver::ReportBasis(sy_result& result) const {
  const HighsBasis& basis = highs_->getBasis();
  if (!basis.valid) return;
  constexpr std::uint8_t kMeaning[] = {SY_BASIS_LOWER, SY_BASIS_BASIC, SY_BASIS_UPPER,
                                       SY_BASIS_FREE, SY_BASIS_UNKNOWN};
  const auto put = [&](const std::vector<HighsBasisStatus>& from, std::uint8_t* to) {
    if (to == nullptr) return;
    for (std::size_t k = 0; k < from.size(); ++k) to[k] = kMeaning[static_cast<int>(from[k])];
  };
  put(basis.col_status, result.x_basis);
  put(basis.row_status, result.row_basis);
}

sy_solver Solver::Describe() {
  sy_solver t = {};
  t.id = "org.highs.highs";
  t.name = "highs";
  t.version = highsVersion();
  t.license = "MIT";
  t.accepts =
      SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS | SY_ACCEPTS_QUADRATIC_OBJECTIVE | SY_ACCEPTS_INTEGER;
  t.integer_accepts = SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS | SY_ACCEPTS_INTEGER;
  t.traits =
      SY_PROVES_GLOBAL | SY_GIVES_DUALS | SY_GIVES_CERTIFICATES | SY_GIVES_BASIS | SY_GIVES_BOUND;
  t.honors = SY_HONORS_THREADS | SY_HONORS_SECONDS | SY_HONORS_ITERATIONS | SY_HONORS_NODES |
             SY_HONORS_CUTOFF | SY_HONORS_TARGET | SY_HONORS_FEASIBILITY | SY_HONORS_OPTIMALITY |
             SY_HONORS_INTEGRALITY | SY_HONORS_ABSOLUTE_GAP | SY_HONORS_RELATIVE_GAP |
             SY_HONORS_SEED | SY_HONORS_VERBOSITY | SY_HONORS_CANCELLED;
  t.updates = SY_UPDATES_BOUNDS | SY_UPDATES_VECTORS | SY_UPDATES_VALUES | SY_UPDATES_APPEND |
              SY_UPDATES_REMOVE;
  t.options = OptionTable();
  return t;
}

}  // namespace switchyard::highs

SY_PLUGIN("highs", "1.0", switchyard::highs::Solver)
