#include "core/solve/session.hpp"

#include <algorithm>
#include <cmath>

#include "core/host/facade.hpp"
#include "core/problem/difference.hpp"
#include "core/solve/dump.hpp"
#include "switchyard/error.hpp"

namespace switchyard {
namespace {

/// Adds the time until its end to `seconds`.
class Timer {
 public:
  explicit Timer(double& seconds) : seconds_(seconds) {}
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;
  ~Timer() {
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  double& seconds_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

bool Answers(Termination t) {
  return t == Termination::kOptimal || t == Termination::kLocallyOptimal ||
         t == Termination::kInfeasible || t == Termination::kUnbounded;
}

double BackendSeconds(const Instance* instance) {
  return instance == nullptr ? 0 : ServiceOf(*instance).backend_seconds(instance->get());
}

struct Setting {
  std::uint64_t bit;
  const char* name;
  bool set;
};

/// What was asked for of a backend that does not keep it, a sentence each.
std::vector<std::string> Unkept(const SolverOptions& o, const sy_solver& facade) {
  const Setting settings[] = {
      {SY_HONORS_THREADS, "the number of threads", o.threads > 0},
      {SY_HONORS_SECONDS, "the time limit", std::isfinite(o.time_limit)},
      {SY_HONORS_ITERATIONS, "the iteration limit",
       o.iteration_limit != std::numeric_limits<std::int64_t>::max()},
      {SY_HONORS_NODES, "the node limit", o.node_limit != std::numeric_limits<std::int64_t>::max()},
      {SY_HONORS_CUTOFF, "the cutoff", !std::isnan(o.cutoff)},
      {SY_HONORS_TARGET, "the target", !std::isnan(o.target)},
      {SY_HONORS_FEASIBILITY, "the feasibility tolerance", !std::isnan(o.feasibility_tolerance)},
      {SY_HONORS_OPTIMALITY, "the optimality tolerance", !std::isnan(o.optimality_tolerance)},
      {SY_HONORS_INTEGRALITY, "the integrality tolerance", !std::isnan(o.integrality_tolerance)},
      {SY_HONORS_SEED, "the seed", o.seed != 0},
      {SY_HONORS_CANCELLED, "cancelling", o.cancelled != nullptr},
  };
  constexpr std::uint64_t kWatched =
      SY_HONORS_ITERATIONS | SY_HONORS_NODES | SY_HONORS_CUTOFF | SY_HONORS_TARGET;
  std::vector<std::string> notes;
  for (const Setting& s : settings) {
    if (!s.set || (facade.honors & s.bit) != 0) continue;
    const bool watched = (kWatched & s.bit) != 0;
    notes.push_back(Text(facade.id, " does not keep ", s.name,
                         watched ? " itself: it is kept as far as it reports its progress" : ""));
  }
  return notes;
}

}  // namespace

double SolverSession::State::Spent() const {
  return std::chrono::duration<double>(Clock::now() - began_).count();
}

MathematicalProgramResult SolverSession::State::Solve(const std::optional<Eigen::VectorXd>& guess) {
  began_ = Clock::now();
  TakeOptions();
  MathematicalProgramResult result;
  {
    const Timer timer(result.seconds.lower);
    unsent_ |= Lower();
  }
  if (!options.problem_file.empty()) WriteProblem(lowering->problem().view(), options.problem_file);
  control_.emplace(options, lowering->maximize());
  if (lowering->crossed_variable() >= 0) {
    result.termination = Termination::kInfeasible;
    result.message = "the bounds of " + program.VariableName(lowering->crossed_variable()) +
                     " exclude each other";
  } else {
    try {
      if (HandOver(guess, result)) Run(result);
    } catch (const BackendError& e) {
      result.termination = Termination::kBackendFailed;
      result.message = lowering->WithNames(program, e.what());
    }
    if (backend != nullptr) Describe(result);
    if (result.termination == Termination::kBackendFailed) {
      instance.reset();  // what it holds now is not known
    }
  }
  result.considered = considered;
  result.seconds.total = Spent();
  if (lowering->nonlinear() != nullptr) lowering->nonlinear()->RethrowWhatWasThrown();
  control_->RethrowWhatWasThrown();
  return result;
}

void SolverSession::State::TakeOptions() {
  options = given;
  options.Merge(program.solver_options());
  if (log == nullptr) log = std::make_unique<SolveLog>(host, options);
}

std::uint64_t SolverSession::State::Lower() {
  if (lowering.has_value()) return lowering->Refresh(program);
  lowering.emplace(program);
  return 0;
}

// The problem reaches a backend, whole or as an update. The backend's own part of that time is
// counted as presolve, the rest as lowering. False: no backend took it.
bool SolverSession::State::HandOver(const std::optional<Eigen::VectorXd>& guess,
                                    MathematicalProgramResult& result) {
  const double before = BackendSeconds(instance.get());
  double spent = 0;
  bool taken = true;
  {
    const Timer timer(spent);
    const bool fresh = instance == nullptr || (unsent_ & kStructureChanged) != 0;
    if (fresh) {
      taken = Choose(result);
    } else {
      SendChanges();
    }
    unsent_ = 0;
    lowering->ForgetReplaced();
    if (taken) Start(guess);
  }
  const bool same_instance = BackendSeconds(instance.get()) >= before;
  const double inside = BackendSeconds(instance.get()) - (same_instance ? before : 0);
  result.seconds.presolve += inside;
  result.seconds.lower += std::max(0.0, spent - inside);
  return taken;
}

// A backend that takes functions and no cones gets convex quadratic constraints as what they are,
// rather than as cones that a bridge makes functions of more variables.
void SolverSession::State::ChooseForm() {
  if (!lowering->has_quadratic_cones()) return;
  for (const Candidate& candidate : host.Rank(lowering->problem().view(), names)) {
    if (!candidate.suitable) continue;
    const sy_solver& facts = candidate.backend->facts;
    const bool functions = (facts.accepts & SY_ACCEPTS_NLP) != 0 && facts.cones == 0;
    if (functions) lowering.emplace(program, Lowering::Quadratics::kAsFunctions);
    return;
  }
}

bool SolverSession::State::Choose(MathematicalProgramResult& result) {
  constexpr std::uint64_t kNumbers =
      SY_UPDATES_BOUNDS | SY_UPDATES_VECTORS | SY_UPDATES_VALUES | SY_UPDATES_NLP;
  instance.reset();
  ChooseForm();
  BackendChoice choice = ChooseBackend(
      host, lowering->problem().view(),
      {names, &options, &log->table(), keeps ? kNumbers : 0,
       [this](const std::string& text) { return lowering->WithNames(program, text); }});
  backend = choice.backend;
  instance = std::move(choice.instance);
  considered = std::move(choice.considered);
  if (backend != nullptr) return true;
  result.termination = Termination::kNoBackend;
  result.message = std::move(choice.why_none);
  return false;
}

void SolverSession::State::SendChanges() {
  if (unsent_ == 0) return;
  sy_update update{};
  update.size = sizeof update;
  update.whole = static_cast<std::uint32_t>(unsent_);
  update.problem = &lowering->problem().view();
  instance->Update(update);
}

void SolverSession::State::Start(const std::optional<Eigen::VectorXd>& guess) {
  const Eigen::VectorXd x = guess.value_or(program.initial_guess());
  Require(x.size() == program.num_vars(), "the initial guess needs ", program.num_vars(),
          " entries, got ", x.size());
  if (x.array().isNaN().all()) return;
  const std::vector<double> all = lowering->Extend(program, x);
  sy_start start{};
  start.size = sizeof start;
  start.x = all.data();
  instance->WarmStart(start);
}

sy_control SolverSession::State::Control() {
  return control_->Record(options.time_limit - Spent(), keeps);
}

// An answer that the check does not support is asked for once more, at a hundredth of the usual
// tolerances, where the user set none and the backend keeps them.
void SolverSession::State::Run(MathematicalProgramResult& result) {
  constexpr std::uint64_t kTolerances = SY_HONORS_FEASIBILITY | SY_HONORS_OPTIMALITY;
  constexpr double kTight = 1e-10;
  sy_control control = Control();
  const MathematicalProgramResult before = result;
  const bool supported = RunOnce(control, result);
  const bool may_tighten = std::isnan(control.feasibility) && std::isnan(control.optimality) &&
                           (backend->facts.honors & kTolerances) == kTolerances;
  if (supported || !may_tighten || Spent() >= options.time_limit) return;
  control = Control();
  control.feasibility = control.optimality = kTight;
  MathematicalProgramResult again = before;
  again.seconds = result.seconds;
  const bool better = RunOnce(control, again) && Answers(again.termination);
  result.seconds = again.seconds;
  if (!better) return;
  again.notes.push_back(Text("solved again at tolerances of ", kTight,
                             ", since the first answer was not supported to 1e-6"));
  result = std::move(again);
}

bool SolverSession::State::RunOnce(const sy_control& control, MathematicalProgramResult& result) {
  AnswerBuffers answer(lowering->problem().data());
  const double before = BackendSeconds(instance.get());
  double spent = 0;
  Recovery recovery(program, *lowering, backend->facts, result);
  {
    const Timer timer(spent);
    if (NonlinearPart* functions = lowering->nonlinear()) functions->ClearCounts();
    instance->Solve(control, answer.raw);
    if (const NonlinearPart* functions = lowering->nonlinear()) {
      result.evaluations = functions->counts();
    }
    recovery.Write(answer);
    ReadPool(recovery);
  }
  const double inside = BackendSeconds(instance.get()) - before;
  result.seconds.solve += inside;
  result.seconds.recover += spent - inside;
  return !recovery.doubted();
}

void SolverSession::State::ReadPool(Recovery& recovery) {
  const sy_solver& facade = instance->solver();
  const auto& pool = *static_cast<const sy_pool*>(facade.extension(&facade, "sy.pool/1"));
  const std::int32_t size = pool.count(instance->get());
  for (std::int32_t i = 0; i < size; ++i) {
    AnswerBuffers answer(lowering->problem().data());
    Call(facade, "sy.pool/1", pool.get, instance->get(), i, &answer.raw);
    recovery.AddSuboptimal(answer.vectors.x);
  }
}

void SolverSession::State::Describe(MathematicalProgramResult& result) const {
  result.solver = backend->id;
  result.solver_version = host.Ready(*backend).version;
  try {
    for (const BridgeKind* kind : PlanFor(lowering->problem().view(), *backend)) {
      result.bridges.emplace_back(kind->name);
    }
  } catch (const BackendError&) {  // no plan any more: what happened is in the message
  }
  const auto unkept = Unkept(options, *host.Facade(*backend));
  result.notes.insert(result.notes.end(), unkept.begin(), unkept.end());
}

}  // namespace switchyard
