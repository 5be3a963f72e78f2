#include "clp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "ClpConfig.h"
#include "ClpSolve.hpp"
#include "coin/proofs.hpp"
#include "linear/answer.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard::clp {
namespace {

using coin::ClpSession;
using coin::ClpWatch;
using coin::ModelView;
using linear::Duals;
using linear::Watch;

constexpr const char* kSolveTypes[] = {"automatic", "useDual", "usePrimal", "usePrimalorSprint",
                                       nullptr};
constexpr const char* kOnOff[] = {"on", "off", nullptr};
constexpr const char* kScalings[] = {"automatic", "off", "equilibrium", "geometric", nullptr};

// Named as CLP's own command line and ClpSolve name them.
constexpr std::array kOptions = {
    linear::WordOption("solveType", kSolveTypes, "The algorithm of a solve without a basis"),
    linear::WordOption("presolve", kOnOff, "Presolve where no update is to follow"),
    linear::IntegerOption("passPresolve", 5, 0, 100, "Passes of presolve"),
    linear::WordOption("scaling", kScalings, "How rows and columns are scaled"),
    linear::WordOption("perturbation", kOnOff, "Perturb the problem where it stalls"),
    linear::RealOption("primalTolerance", 1e-7, 1e-20, 1e12, "Feasibility of rows and bounds"),
    linear::RealOption("dualTolerance", 1e-7, 1e-20, 1e12, "Feasibility of reduced costs"),
    linear::RealOption("dualBound", 1e10, 1e-20, 1e12, "Bound put on variables by the dual"),
    linear::RealOption("primalWeight", 1e10, 1e-20, 1e20, "Cost of infeasibility in the primal"),
};

constexpr auto kOptionList = [] {
  std::array<const sy_option*, kOptions.size() + 1> list{};
  for (std::size_t k = 0; k < kOptions.size(); ++k) list[k] = &kOptions[k];
  return list;
}();

ClpSolve::SolveType TypeNamed(const std::string& name) {
  if (name == "useDual") return ClpSolve::useDual;
  if (name == "usePrimal") return ClpSolve::usePrimal;
  if (name == "usePrimalorSprint") return ClpSolve::usePrimalorSprint;
  return ClpSolve::automatic;
}

int ScalingNamed(const std::string& name) {
  constexpr int kAutomatic = 3;
  if (name == "off") return 0;
  if (name == "equilibrium") return 1;
  if (name == "geometric") return 2;
  return kAutomatic;
}

}  // namespace

Solver::Solver(const sy_host& host)
    : host_(host), log_(host_), settings_(kOptionList.data(), "CLP") {
  model_.passInMessageHandler(&log_);
}

void Solver::WarmStart(const sy_start& start) {
  start_ = linear::Start(start, model_.numberColumns(), model_.numberRows());
  start_is_new_ = true;
}

void Solver::Configure(const sy_control& control) {
  constexpr int kDefaultSeed = 1234567;  // CLP's
  constexpr int kNoPerturbation = 100;
  constexpr int kPerturbWhereItStalls = 50;
  const auto tolerance = [this](const char* name, double asked) {
    return settings_.Has(name) || std::isnan(asked) ? settings_.Real(name) : asked;
  };
  log_.SetVerbosity(control.verbosity);
  model_.setRandomSeed(control.seed == 0 ? kDefaultSeed
                                         : static_cast<int>(control.seed % 0x7fffffff));
  model_.setPrimalTolerance(tolerance("primalTolerance", control.feasibility));
  model_.setDualTolerance(tolerance("dualTolerance", control.optimality));
  model_.setDualBound(settings_.Real("dualBound"));
  model_.setInfeasibilityCost(settings_.Real("primalWeight"));
  model_.scaling(ScalingNamed(settings_.Text("scaling")));
  model_.setPerturbation(settings_.Text("perturbation") == "off" ? kNoPerturbation
                                                                 : kPerturbWhereItStalls);
}

// A start given since the last solve replaces what that solve left.
Solver::Way Solver::Begin(bool proceed) {
  if (proceed && solved_ && !start_is_new_) return Way::kDual;
  start_is_new_ = false;
  coin::ForgetBasis(model_);
  if (!start_.has_basis()) {
    return may_presolve_ && settings_.Text("presolve") == "on" ? Way::kPresolved : Way::kPlain;
  }
  constexpr ClpSimplex::Status kMeaning[] = {ClpSimplex::atLowerBound, ClpSimplex::basic,
                                             ClpSimplex::atLowerBound, ClpSimplex::atUpperBound,
                                             ClpSimplex::isFree};
  for (int j = 0; j < model_.numberColumns(); ++j) {
    model_.setColumnStatus(j,
                           kMeaning[std::min<int>(start_.x_basis[static_cast<std::size_t>(j)], 4)]);
  }
  for (int i = 0; i < model_.numberRows(); ++i) {
    model_.setRowStatus(i,
                        kMeaning[std::min<int>(start_.row_basis[static_cast<std::size_t>(i)], 4)]);
  }
  return Way::kDual;
}

void Solver::Solve(const sy_control& control, sy_result& result) {
  Watch watch(control);
  linear::Clear(result);
  if (model_.numberColumns() == 0) {
    linear::AnswerWithoutVariables(ModelView(model_).problem, model_.primalTolerance(), result);
    result.seconds = watch.Seconds();
    return;
  }
  met_cutoff_ = false;
  ClpSession session{watch, true};
  const ClpWatch stop(session);
  model_.passInEventHandler(&stop);
  Configure(control);
  const Way way = Begin((control.flags & SY_CONTINUE) != 0);
  if (control.cutoff < kInfinity) {
    RunToCutoff(way, session, control.cutoff);
  } else {
    Run(way, session);
  }
  if (!met_cutoff_ && !coin::ProvesItsVerdict(model_)) coin::SeekProof(model_, watch);
  const ClpEventHandler none;
  model_.passInEventHandler(&none);
  solved_ = true;
  Report(watch, result);
  result.iterations = session.iterations;
  result.seconds = watch.Seconds();
}

void Solver::Run(Way way, ClpSession& session) {
  if (session.watch.Stopped(session.iterations)) {
    model_.setProblemStatus(5);
    return;
  }
  if (way == Way::kDual) {
    model_.dual();
  } else {
    constexpr int kInterrupts = 2;
    constexpr int kNotMine = 1;
    ClpSolve how;
    how.setSolveType(TypeNamed(settings_.Text("solveType")));
    how.setPresolveType(way == Way::kPresolved ? ClpSolve::presolveNumber : ClpSolve::presolveOff,
                        settings_.Integer("passPresolve"));
    how.setSpecialOption(kInterrupts, kNotMine);
    model_.initialSolve(how);
  }
  // Optimal as scaled, a little infeasible as given.
  if (model_.problemStatus() == 0 && model_.secondaryStatus() >= 2 &&
      model_.secondaryStatus() <= 4) {
    model_.scaling(0);
    model_.primal(1);
  }
}

// CLP stops its dual where its objective, perturbed perhaps, passes the limit: only a dual
// objective of ours makes that a proof.
void Solver::RunToCutoff(Way way, ClpSession& session, double cutoff) {
  constexpr double kNoLimit = 1e50;
  model_.setDualObjectiveLimit(cutoff);
  Run(way == Way::kPresolved ? Way::kDual : way, session);
  model_.setDualObjectiveLimit(kNoLimit);
  const bool stopped_there = model_.problemStatus() == 1 && model_.secondaryStatus() == 1;
  met_cutoff_ = stopped_there && Bound() >= cutoff;
  if (stopped_there && !met_cutoff_) Run(Way::kDual, session);
}

double Solver::Bound() {
  const ModelView view(model_);
  const sy_problem& p = view.problem;
  const double* y = model_.dualRowSolution();
  return linear::DualObjective(
      p, model_.primalColumnSolution(),
      linear::Complete(p, model_.primalColumnSolution(), {y, y + model_.numberRows()}),
      linear::kRayNoise);
}

sy_termination Solver::Reason(const Watch& watch) const {
  if (met_cutoff_) return SY_CUTOFF;
  switch (model_.problemStatus()) {
    case 0:
      return SY_OPTIMAL;
    case 1:
      return SY_INFEASIBLE;
    case 2:
      return SY_UNBOUNDED;
    case 3:
      return SY_ITERATION_LIMIT;
    case 5:
      return watch.reason();
    default:
      return SY_NUMERICAL_TROUBLE;
  }
}

void Solver::Report(const Watch& watch, sy_result& result) {
  constexpr const char* kWords[] = {"optimal",           "primal infeasible",
                                    "dual infeasible",   "stopped on iterations or time",
                                    "stopped by errors", "stopped by event handler"};
  const int status = model_.problemStatus();
  result.termination = Reason(watch);
  linear::Say(result, status >= 0 && status <= 5 ? kWords[status] : "status unknown");
  ReportBasis(result);
  const ModelView view(model_);
  const sy_problem& p = view.problem;
  const std::vector<double> x(model_.primalColumnSolution(),
                              model_.primalColumnSolution() + p.num_vars);
  const double* y = model_.dualRowSolution();
  const Duals duals = linear::Complete(p, x.data(), {y, y + p.num_rows});
  const bool optimal = result.termination == SY_OPTIMAL;
  if (result.termination == SY_INFEASIBLE) {
    if (const auto proof = coin::Farkas(model_)) linear::Put(result, *proof, SY_CERTIFICATE);
    return;
  }
  if (result.termination == SY_UNBOUNDED) {
    result.objective = -kInfinity;
    const auto ray = coin::Ray(model_);
    if (!ray) return;
    result.primal = SY_CERTIFICATE;
    linear::Put(result.x, *ray);
    return;
  }
  result.primal = optimal || model_.primalFeasible() ? SY_FEASIBLE : SY_INFEASIBLE_POINT;
  result.objective = Objective(p, x.data());
  linear::Put(result.x, x);
  linear::Put(result, duals, optimal || model_.dualFeasible() ? SY_FEASIBLE : SY_INFEASIBLE_POINT);
  result.bound =
      optimal ? result.objective : linear::DualObjective(p, x.data(), duals, linear::kRayNoise);
}

void Solver::ReportBasis(sy_result& result) const {
  constexpr std::uint8_t kMeaning[] = {SY_BASIS_FREE,  SY_BASIS_BASIC, SY_BASIS_UPPER,
                                       SY_BASIS_LOWER, SY_BASIS_FREE,  SY_BASIS_LOWER};
  for (int j = 0; result.x_basis != nullptr && j < model_.numberColumns(); ++j) {
    result.x_basis[j] = kMeaning[model_.getColumnStatus(j)];
  }
  for (int i = 0; result.row_basis != nullptr && i < model_.numberRows(); ++i) {
    result.row_basis[i] = kMeaning[model_.getRowStatus(i)];
  }
}

sy_solver Solver::Describe() {
  sy_solver t = {};
  t.id = "org.coin-or.clp";
  t.name = "clp";
  t.version = CLP_VERSION;
  t.license = "EPL-2.0";
  t.accepts = SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS;
  t.traits =
      SY_PROVES_GLOBAL | SY_GIVES_DUALS | SY_GIVES_CERTIFICATES | SY_GIVES_BASIS | SY_GIVES_BOUND;
  t.honors = SY_HONORS_THREADS | SY_HONORS_SECONDS | SY_HONORS_ITERATIONS | SY_HONORS_CUTOFF |
             SY_HONORS_FEASIBILITY | SY_HONORS_OPTIMALITY | SY_HONORS_SEED | SY_HONORS_VERBOSITY |
             SY_HONORS_CANCELLED;
  t.updates = SY_UPDATES_BOUNDS | SY_UPDATES_VECTORS | SY_UPDATES_VALUES | SY_UPDATES_APPEND |
              SY_UPDATES_REMOVE;
  t.options = kOptionList.data();
  return t;
}

}  // namespace switchyard::clp

SY_PLUGIN("clp", "1.0", switchyard::clp::Solver)
