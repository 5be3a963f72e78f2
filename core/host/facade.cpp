#include "core/host/facade.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

#include "core/host/problem_check.hpp"
#include "core/host/turn.hpp"
#include "core/host/watch.hpp"
#include "core/problem/difference.hpp"
#include "switchyard/error.hpp"
#include "switchyard/problem_update.hpp"

namespace switchyard {
namespace {

using plugin::Failure;

/// A BackendError as the failure of the facade's own call.
template <class Body>
auto Forwarding(Body&& body) {
  try {
    return body();
  } catch (const BackendError& e) {
    throw Failure(e.code(), e.reason());
  } catch (const std::invalid_argument& e) {
    throw Failure(SY_E_ARGUMENT, e.what());
  }
}

std::uint64_t KindsOf(const sy_update& update) {
  std::uint64_t kinds = update.whole;
  if (update.num_x > 0 || update.num_rows > 0) kinds |= SY_UPDATES_BOUNDS;
  if (update.num_cones > 0) kinds |= SY_UPDATES_SWITCH;
  if (update.num_gone_rows > 0 || update.num_gone_cones > 0) kinds |= SY_UPDATES_REMOVE;
  if (update.more != nullptr) kinds |= SY_UPDATES_APPEND;
  return kinds;
}

bool IsSinglesAlone(const sy_update& update) {
  return update.whole == 0 && update.num_gone_rows == 0 && update.num_gone_cones == 0 &&
         update.more == nullptr;
}

bool IsVectorsAlone(const sy_update& update) {
  constexpr std::uint64_t kVectors = SY_UPDATES_BOUNDS | SY_UPDATES_VECTORS;
  return (update.whole & ~kVectors) == 0 && update.num_gone_rows == 0 &&
         update.num_gone_cones == 0 && update.more == nullptr;
}

bool IsVariableBoundsAlone(const sy_update& update) {
  return IsSinglesAlone(update) && update.num_rows == 0 && update.num_cones == 0;
}

// What stood in the record before is no answer of a backend that writes nothing.
void ForgetAnswer(sy_result& result) {
  result.termination = SY_NOT_SOLVED;
  result.primal = result.dual = SY_NO_POINT;
  result.objective = result.relaxed = std::nan("");
  result.bound = -kInfinity;
}

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

template <class P>  // sy_problem or ProblemData
std::int32_t NumFunctions(const P& d) {
  return d.nlp != nullptr ? d.nlp->num_constraints : 0;
}

void CopyOut(const std::vector<double>& from, double* to, std::int32_t count) {
  if (to == nullptr) return;
  std::fill(to, to + count, 0.0);
  std::copy_n(from.begin(), std::min(from.size(), static_cast<std::size_t>(count)), to);
}

}  // namespace

namespace {

// Functions without derivatives are for solvers that need none.
void CheckDerivatives(const sy_problem& problem, const Backend& backend) {
  if (problem.nlp == nullptr) return;
  const std::uint32_t provides = problem.nlp->provides;
  const auto lacks = [&](std::uint64_t trait, std::uint32_t bits) {
    return (backend.facts.traits & trait) != 0 && (provides & bits) != bits;
  };
  if (lacks(SY_NEEDS_GRADIENT, SY_GRADIENT | SY_JACOBIAN)) {
    throw BackendError(SY_E_UNSUPPORTED, backend.id,
                       "needs derivatives, and a function of the problem has none");
  }
  if (lacks(SY_NEEDS_HESSIAN, SY_HESSIAN)) {
    throw BackendError(SY_E_UNSUPPORTED, backend.id,
                       "needs second derivatives, and a function of the problem has none");
  }
}

}  // namespace

BridgePlan PlanFor(const sy_problem& problem, const Backend& backend) {
  CheckDerivatives(problem, backend);
  const bool integer = problem.integer != nullptr;
  const Features features = FeaturesOf(problem);
  Planned planned = PlanBridges(features, AbilitiesOf(backend.facts, integer));
  if (planned.found) return std::move(planned.plan);
  const Features continuous = AbilitiesOf(backend.facts, false);
  Features missing = planned.missing;
  if (integer && backend.facts.integer_accepts == 0) {  // then the rest is not the obstacle
    missing = SY_ACCEPTS_INTEGER | PlanBridges(features & ~SY_ACCEPTS_INTEGER, continuous).missing;
  }
  const bool only_together = (missing & ~continuous) == 0;
  throw BackendError(SY_E_UNSUPPORTED, backend.id,
                     "does not take " + DescribeFeatures(missing) +
                         (only_together ? " together with integer variables" : ""));
}

Facade::Facade(const sy_solver& self, const sy_host& host)
    : context_(static_cast<const FacadeContext*>(self.context)) {
  Forwarding([&] {
    const Turn turn(context_->turn);
    instance_ = std::make_unique<Instance>(facts(), host, context_->backend->table);
    context_->configure(*instance_);
  });
}

Facade::~Facade() {
  const Turn turn(context_->turn, Turn::Use::kEnd);
  instance_.reset();
}

void Facade::SetOption(std::string_view name, const sy_value& value) {
  Forwarding([&] {
    const Turn turn(context_->turn);
    FindOption(facts(), std::string(name));
    instance_->SetOption(std::string(name), value);
  });
}

void Facade::Load(const sy_problem& problem, std::uint64_t updates) {
  Forwarding([&] {
    const Turn turn(context_->turn);
    CheckProblem(problem);
    spare_.reset();
    declared_ = updates;
    if (updates == 0 && PlanFor(problem, *context_->backend).empty()) {
      Borrow(problem);
    } else {
      problem_ = std::make_shared<Problem>(problem);
      Reload();
    }
    in_step_ = true;
  });
}

// The caller keeps in place what the record points to until the next load or update; what no update
// is announced for seldom gets one. The record may be gone after this call.
void Facade::Borrow(const sy_problem& problem) {
  borrowed_ = problem;
  InBackend([&] { instance_->Load(borrowed_, 0); });
  problem_.reset();
  sent_.reset();
  held_.reset();
  plan_ = {};
  chain_ = std::make_unique<BridgeChain>();
  passed_bounds_ = false;
  ++loads_;
}

template <class C>
void Facade::InBackend(C&& call) {
  struct Clock {
    double& seconds;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    ~Clock() {
      seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
  } const clock{backend_seconds_};
  call();
}

void Facade::Reload() {
  plan_ = PlanFor(problem_->view(), *context_->backend);
  auto chain = std::make_unique<BridgeChain>(*problem_, plan_);
  const sy_problem& given = chain->empty() ? problem_->view() : chain->image().view();
  InBackend([&] { instance_->Load(given, declared_ & facts().updates); });
  chain_ = std::move(chain);
  sent_ = chain_->empty() ? problem_ : nullptr;
  held_.reset();
  passed_bounds_ = false;
  ++loads_;
}

void Facade::Send(const sy_update& update) {
  InBackend([&] { instance_->Update(update); });
  ++updates_;
}

void Facade::NeedInStep() const {
  if (in_step_) return;
  throw Failure(SY_E_STATE, "an update failed, so what " + context_->backend->id +
                                " holds is not known: load it again");
}

// The problem that an update makes: written over the loaded one only where that is not what the
// backend holds. Where no matrix changes, the one before the loaded one has the same and takes the
// vectors alone.
std::shared_ptr<Problem> Facade::Next(const sy_update& update) {
  std::shared_ptr<Problem> next = std::move(spare_);
  if (IsSinglesAlone(update) && sent_ != problem_) {
    next = problem_;
  } else if (next != nullptr && IsVectorsAlone(update)) {
    next->Change([&](ProblemData& d) { CopyVectors(problem_->data(), d); });
  } else {
    next = std::make_shared<Problem>(*problem_);
  }
  next->Apply(update);
  if (!IsVectorsAlone(update)) {
    CheckProblem(next->view());
  } else if (!IsSinglesAlone(update)) {
    CheckVectors(next->view());
  }
  return next;
}

// A mistake is found before anything changes. What the backend was given stays as it is until it
// gets the next.
void Facade::Update(const sy_update& update) {
  Forwarding([&] {
    const Turn turn(context_->turn);
    NeedInStep();
    CheckSingleBounds(update);
    if (problem_ == nullptr) problem_ = std::make_shared<Problem>(borrowed_);
    std::shared_ptr<Problem> next = Next(update);
    in_step_ = next != problem_;
    const BridgePlan plan = PlanFor(next->view(), *context_->backend);
    in_step_ = false;
    std::swap(problem_, next);
    if (!PassStraight(update, plan)) SendDifference(update, plan);
    if (IsVectorsAlone(update) && next != problem_) spare_ = std::move(next);
    in_step_ = true;
  });
}

// An update that needs no bridge to run again: none stands between, or only bounds of variables
// changed and stay bounds.
bool Facade::PassStraight(const sy_update& update, const BridgePlan& plan) {
  if ((KindsOf(update) & ~(facts().updates & declared_)) != 0 || plan != plan_) return false;
  if (chain_->empty()) {
    sy_update ours = update;
    if (update.problem != nullptr) ours.problem = &problem_->view();
    Send(ours);
    if (update.problem != nullptr) sent_ = problem_;
    return true;
  }
  const bool bounds_stay = std::none_of(plan_.begin(), plan_.end(), [](const BridgeKind* kind) {
    return (kind->removes & SY_ACCEPTS_BOUNDS) != 0;
  });
  if (!bounds_stay || !IsVariableBoundsAlone(update)) return false;
  Send(update);
  passed_bounds_ = true;
  return true;
}

void Facade::SendDifference(const sy_update& update, const BridgePlan& plan) {
  auto fresh = std::make_unique<BridgeChain>(*problem_, plan);
  if (plan != plan_ || fresh->empty() || chain_->empty()) return Reload();
  std::uint64_t kinds = ProblemDifference(chain_->image().data(), fresh->image().data());
  if (passed_bounds_) kinds |= SY_UPDATES_BOUNDS;
  kinds |= update.whole & SY_UPDATES_NLP;  // functions are not compared
  if ((kinds & ~(facts().updates & declared_)) != 0) return Reload();
  if (kinds == 0) {
    if (held_ == nullptr) held_ = std::move(chain_);
  } else {
    sy_update difference{};
    difference.size = sizeof difference;
    difference.whole = static_cast<std::uint32_t>(kinds);
    difference.problem = &fresh->image().view();
    Send(difference);
    held_.reset();
    passed_bounds_ = false;
  }
  chain_ = std::move(fresh);
}

void Facade::WarmStart(const sy_start& start) {
  Forwarding([&] {
    if (facts().warm_start == nullptr) return;  // a start is a wish
    const Turn turn(context_->turn);
    NeedInStep();
    if (chain_->empty()) return InBackend([&] { instance_->WarmStart(start); });
    const sy_problem& d = view();
    const auto copy = [](const double* from, std::int32_t count) {
      return from == nullptr ? std::vector<double>() : std::vector<double>(from, from + count);
    };
    Vectors v{copy(start.x, d.num_vars), copy(start.x_dual, d.num_vars),
              copy(start.row_dual, d.num_rows), copy(start.cone_dual, d.num_cone_rows),
              copy(start.nlp_dual, NumFunctions(d))};
    chain_->Forward(v);
    const auto data = [](const std::vector<double>& from) {
      return from.empty() ? nullptr : from.data();
    };
    sy_start mapped = start;
    mapped.x = data(v.x);
    mapped.x_dual = data(v.x_dual);
    mapped.row_dual = data(v.row_dual);
    mapped.cone_dual = data(v.cone_dual);
    mapped.nlp_dual = data(v.nlp_dual);
    mapped.x_basis = nullptr;  // a basis speaks of rows, which have moved
    mapped.row_basis = nullptr;
    InBackend([&] { instance_->WarmStart(mapped); });
  });
}

void Facade::Solve(const sy_control& control, sy_result& result) {
  Forwarding([&] {
    const Turn turn(context_->turn);
    NeedInStep();
    Watch watch(control, facts(), context_->turn);
    const sy_control given = watch.control();
    ForgetAnswer(result);
    sy_result found = result;
    Vectors v;
    if (!chain_->empty()) {
      const ProblemData& image = chain_->image().data();
      const auto buffer = [](std::vector<double>& values, std::int32_t count, double fill) {
        values.assign(static_cast<std::size_t>(count), fill);
        return values.data();
      };
      found.x = buffer(v.x, image.num_vars, std::nan(""));
      found.x_dual = buffer(v.x_dual, image.num_vars, 0);
      found.row_dual = buffer(v.row_dual, image.num_rows(), 0);
      found.cone_dual = buffer(v.cone_dual, image.num_cone_rows(), 0);
      found.nlp_dual = buffer(v.nlp_dual, NumFunctions(image), 0);
      found.x_basis = found.row_basis = nullptr;
      found.relaxed_x = nullptr;
    }
    InBackend([&] { instance_->Solve(given, found); });
    if (watch.stopped_by() != SY_NOT_SOLVED && found.termination == SY_CANCELLED) {
      found.termination = watch.stopped_by();
    }
    Recover(found, v, result);
    CheckAnswer(result);
  });
}

void Facade::Recover(sy_result& found, const Vectors& mapped, sy_result& result) const {
  const sy_result wanted = result;
  result = found;
  if (chain_->empty()) return;
  Vectors v = mapped;
  chain_->Back(v);
  const sy_problem& d = view();
  CopyOut(v.x, wanted.x, d.num_vars);
  CopyOut(v.x_dual, wanted.x_dual, d.num_vars);
  CopyOut(v.row_dual, wanted.row_dual, d.num_rows);
  CopyOut(v.cone_dual, wanted.cone_dual, d.num_cone_rows);
  CopyOut(v.nlp_dual, wanted.nlp_dual, NumFunctions(d));
  if (wanted.x_basis != nullptr) std::memset(wanted.x_basis, SY_BASIS_UNKNOWN, At(d.num_vars));
  if (wanted.row_basis != nullptr) {
    std::memset(wanted.row_basis, SY_BASIS_UNKNOWN, At(d.num_rows));
  }
  result.x = wanted.x;
  result.x_dual = wanted.x_dual;
  result.row_dual = wanted.row_dual;
  result.cone_dual = wanted.cone_dual;
  result.nlp_dual = wanted.nlp_dual;
  result.x_basis = wanted.x_basis;
  result.row_basis = wanted.row_basis;
  result.relaxed_x = wanted.relaxed_x;
  if (result.relaxed_x != nullptr) result.relaxed = std::nan("");
  // An epigraph's variable is near the function that it stands for, not at it.
  const bool is_point = found.primal == SY_FEASIBLE || found.primal == SY_NEARLY_FEASIBLE;
  if (is_point && d.nlp == nullptr) result.objective = Objective(d, v.x.data());
}

// What a backend says is not taken on trust: numbers that are none, and words of a newer version.
void Facade::CheckAnswer(sy_result& result) const {
  if (result.termination < SY_NOT_SOLVED || result.termination > SY_RESTRICTIONS_FAILED) {
    result.termination = SY_NOT_SOLVED;
  }
  const auto known = [](sy_point_kind kind) {
    return kind >= SY_NO_POINT && kind <= SY_CERTIFICATE ? kind : SY_NO_POINT;
  };
  result.primal = known(result.primal);
  result.dual = known(result.dual);
  const sy_problem& d = view();
  const auto check = [&](const char* name, const double* values, std::int32_t count) {
    for (std::int32_t i = 0; values != nullptr && i < count; ++i) {
      if (std::isfinite(values[i])) continue;
      throw Failure(SY_E_INTERNAL, Text("it returned ", values[i], " in ", name, "[", i, "]"));
    }
  };
  if (result.primal != SY_NO_POINT) check("x", result.x, d.num_vars);
  if (result.dual != SY_NO_POINT) {
    check("x_dual", result.x_dual, d.num_vars);
    check("row_dual", result.row_dual, d.num_rows);
    check("cone_dual", result.cone_dual, d.num_cone_rows);
    check("nlp_dual", result.nlp_dual, NumFunctions(d));
  }
}

const sy_pool* Facade::BackendsPool() const {
  if (facts().extension == nullptr) return nullptr;
  return static_cast<const sy_pool*>(facts().extension(context_->backend->table, "sy.pool/1"));
}

std::int32_t Facade::PoolSize() const {
  const sy_pool* pool = BackendsPool();
  return pool != nullptr ? std::max(0, pool->count(instance_->get())) : 0;
}

void Facade::PoolSolution(std::int32_t i, sy_result& result) const {
  Forwarding([&] {
    const sy_pool* pool = BackendsPool();
    if (pool == nullptr) throw Failure(SY_E_UNSUPPORTED, "it keeps no pool");
    ForgetAnswer(result);
    sy_result found = result;
    Vectors v;
    const sy_problem& image = chain_->empty() ? view() : chain_->image().view();
    v.x.assign(At(image.num_vars), std::nan(""));
    found.x = v.x.data();
    Call(instance_->solver(), "sy.pool/1", pool->get, instance_->get(), i, &found);
    if (!chain_->empty()) chain_->Back(v);
    result.primal = found.primal;
    result.objective = view().nlp == nullptr ? Objective(view(), v.x.data()) : found.objective;
    CopyOut(v.x, result.x, view().num_vars);
    CheckAnswer(result);
  });
}

const void* Facade::Extension(const char* id) {
  static constexpr sy_facade kFacade = {
      sizeof(sy_facade), 0,
      [](sy_instance* p) noexcept {
        return static_cast<std::int32_t>(plugin::As<Facade>(p).solver->loads());
      },
      [](sy_instance* p) noexcept {
        return static_cast<std::int32_t>(plugin::As<Facade>(p).solver->updates());
      },
      [](sy_instance* p) noexcept { return plugin::As<Facade>(p).solver->backend_seconds(); }};
  static constexpr sy_pool kPool = {
      sizeof(sy_pool), 0,
      [](sy_instance* p) noexcept { return plugin::As<Facade>(p).solver->PoolSize(); },
      [](sy_instance* p, std::int32_t i, sy_result* result, sy_error* error) noexcept {
        return plugin::Guarded(error,
                               [&] { plugin::As<Facade>(p).solver->PoolSolution(i, *result); });
      }};
  if (std::strcmp(id, "sy.pool/1") == 0) return &kPool;
  return std::strcmp(id, "sy.facade/1") == 0 ? &kFacade : nullptr;
}

sy_solver Facade::Table(const FacadeContext& context) {
  sy_solver table = context.backend->facts;
  const auto reachable = [&](Features abilities) {
    Features all = abilities;
    for (const BridgeKind& kind : BridgeKinds()) {
      for (Features bit = 1; bit != 0; bit <<= 1) {
        if ((kind.removes & bit) != 0 && PlanBridges(bit, abilities).found) all |= bit;
      }
    }
    return all;
  };
  constexpr Features kSections = 0xffffffff;
  const Features continuous = reachable(AbilitiesOf(table, false));
  table.accepts = continuous & kSections;
  table.cones = continuous >> 32;
  if (table.integer_accepts != 0) {
    const Features integer = reachable(AbilitiesOf(table, true));
    table.integer_accepts = integer & kSections;
    table.integer_cones = integer >> 32;
  }
  if ((table.honors & SY_HONORS_CANCELLED) != 0) table.honors |= SY_HONORS_SECONDS;
  plugin::WriteFunctions<Facade>(table);
  table.clone = nullptr;
  table.context = &context;
  table.ready = nullptr;
  table.supports = [](const sy_solver* self, const sy_host* host, const sy_problem* problem,
                      sy_error* error) noexcept {
    return plugin::Guarded(error, [&] {
      const auto& at = *static_cast<const FacadeContext*>(self->context);
      Forwarding([&] {
        const sy_solver& backend = at.backend->facts;
        const sy_problem given = plugin::Whole(*problem);
        const BridgePlan plan = PlanFor(given, *at.backend);
        const auto ask = [&](const sy_problem& image) {
          if (backend.supports == nullptr) return;
          Call(backend, "supports", backend.supports, at.backend->table, host, &image);
        };
        const bool may_throw = std::any_of(plan.begin(), plan.end(),
                                           [](const BridgeKind* kind) { return kind->may_throw; });
        if (plan.empty()) return ask(given);
        if (backend.supports == nullptr && !may_throw) return;  // no need of the image
        ask(BridgeChain(Problem(given), plan).image().view());
      });
    });
  };
  return table;
}

}  // namespace switchyard
